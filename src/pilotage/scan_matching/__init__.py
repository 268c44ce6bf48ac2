"""From partial shapes to the robot's motion and a local map of the last metres (Wolter 2001, section 3.3).

It knows the robot's side only: no drawing.
"""

from pilotage.scan_matching.local_map import PerceptionMap, PerceptionMapSettings
from pilotage.scan_matching.odometry_noise import OdometryNoise
from pilotage.scan_matching.register import register
from pilotage.scan_matching.registration import Correspondence, Registration
from pilotage.scan_matching.settings import Method, RegistrationSettings

__all__ = [
    "Correspondence",
    "Method",
    "OdometryNoise",
    "PerceptionMap",
    "PerceptionMapSettings",
    "Registration",
    "RegistrationSettings",
    "register",
]
