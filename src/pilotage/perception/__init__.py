"""From the laser to shapes, and the local map of what was seen (Wolter 2001, sections 2.1 and 3.3).

perceive(scan, PerceptionSettings()) -> tuple[PartialShape, ...]
    Partial shapes of one scan in the base frame, slightly simplified.
PerceptionMap().merged(registration) -> PerceptionMap
    The local map in the `odom` frame with what a scan shows, once `localization.registration` registered it.
"""

from pilotage.perception.correspondence import Correspondence, Registration
from pilotage.perception.odometry_noise import OdometryNoise
from pilotage.perception.perceive import PerceptionSettings, perceive
from pilotage.perception.perception_map import PerceptionMap, PerceptionMapSettings
from pilotage.perception.scan import LaserScan, Odometry, Reading
from pilotage.perception.segmentation import SegmentationSettings

__all__ = [
    "Correspondence",
    "LaserScan",
    "Odometry",
    "OdometryNoise",
    "PerceptionMap",
    "PerceptionMapSettings",
    "PerceptionSettings",
    "Reading",
    "Registration",
    "SegmentationSettings",
    "perceive",
]
