"""Where the robot is on the drawing: the only layer that knows scan and map (Wolter 2001, section 3.4)."""

from pilotage.localization.blocked_way import BlockedWay
from pilotage.localization.estimate import Estimate, PoseHypothesis, Status
from pilotage.localization.explanation import Explanation, Verdict, WallEvidence
from pilotage.localization.localizer import Localizer, LocalizerSettings
from pilotage.localization.observation import Observation, observe
from pilotage.localization.other_buildings import OtherBuildings
from pilotage.localization.prior import Prior
from pilotage.localization.sensor_model import SensorModel, SensorSettings
from pilotage.localization.tracks import Track, Tracks, TrackSettings

__all__ = [
    "BlockedWay",
    "Estimate",
    "Explanation",
    "Localizer",
    "LocalizerSettings",
    "Observation",
    "OtherBuildings",
    "PoseHypothesis",
    "Prior",
    "SensorModel",
    "SensorSettings",
    "Status",
    "Track",
    "TrackSettings",
    "Tracks",
    "Verdict",
    "WallEvidence",
    "observe",
]
