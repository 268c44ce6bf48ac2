"""From scans and odometry to the robot's motion and a local map of the last metres (Wolter 2001, 3.3).

This is the robot's side only: no drawing is known here.

    scan_matcher = ScanMatcher()
    for reading in log:
        motion = scan_matcher.update(reading.scan, reading.odometry)
        motion.last_from_base         # since the last reading
        motion.shapes                 # what the scan shows, in the base frame
        scan_matcher.local_map.shapes # what was seen on the last 10 m, in `odom`
"""

from pilotage.scan_matching.local_map import LocalMap
from pilotage.scan_matching.odometry import MotionPrior, OdometryNoise
from pilotage.scan_matching.register import Method, Registration, register
from pilotage.scan_matching.scan_matcher import ScanMatcher, ScanMatchingSettings, ScanMotion

__all__ = [
    "LocalMap",
    "Method",
    "MotionPrior",
    "OdometryNoise",
    "Registration",
    "ScanMatcher",
    "ScanMatchingSettings",
    "ScanMotion",
    "register",
]
