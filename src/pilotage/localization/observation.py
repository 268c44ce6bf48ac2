"""What the robot saw at a keyframe, and how it moved to it; knows no drawing."""

from dataclasses import dataclass

from pilotage.geometry import Pose2
from pilotage.localization.sensor_model import SparseScan, thin_scan
from pilotage.perception import LaserScan
from pilotage.shape import PartialShape, Simplification, simplify_all
from pilotage.shape.corners import Corners, find_corners

SURFACES = Simplification(min_relevance=0.08)
"""[rad m] Simplification of what is seen: a right angle between sides of 10 cm has 0.08, and is kept."""


@dataclass(frozen=True, slots=True, eq=False)
class Observation:
    """A scan thinned for comparison with a drawing, its corners, and the motion before it."""

    scan: SparseScan
    corners: Corners  # in the frame of the robot [m]
    motion: Pose2  # since the last keyframe
    stamp: float  # [s]


def observe(scan: LaserScan, shapes: tuple[PartialShape, ...], motion: Pose2) -> Observation:
    """Take what a drawing can be compared with from a scan and what is perceived in it (base frame)."""
    surfaces = simplify_all([shape.polyline for shape in shapes], SURFACES)
    return Observation(thin_scan(scan), find_corners(surfaces), motion, scan.stamp)
