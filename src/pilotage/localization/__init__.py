"""Where the robot is on the drawing: the only layer that knows scan and map (Wolter 2001, section 3.4)."""

from pilotage.localization.alignment import AlignmentSettings
from pilotage.localization.estimate import EstimateSettings, Hypothesis, Status
from pilotage.localization.localizer import Localizer, LocalizerSettings
from pilotage.localization.pose_hypothesis import Estimate, PoseHypothesis
from pilotage.localization.proposals import Prior
from pilotage.localization.tracking import Drift, TrackingSettings
from pilotage.localization.visibility import VisibilitySettings

__all__ = [
    "AlignmentSettings",
    "Drift",
    "Estimate",
    "EstimateSettings",
    "Hypothesis",
    "Localizer",
    "LocalizerSettings",
    "PoseHypothesis",
    "Prior",
    "Status",
    "TrackingSettings",
    "VisibilitySettings",
]
