"""From the laser to shapes (Wolter 2001, sections 2.1 and 2.2).

perceive(scan, PerceptionSettings()) -> tuple[PartialShape, ...]
    Partial shapes of one scan in the base frame, slightly simplified.
"""

from pilotage.perception.perceive import PerceptionSettings, perceive
from pilotage.perception.scan import LaserScan, Odometry, Reading

__all__ = ["LaserScan", "Odometry", "PerceptionSettings", "Reading", "perceive"]
