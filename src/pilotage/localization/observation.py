"""What the robot saw at a keyframe, and how it moved to it; knows no drawing."""

from dataclasses import dataclass

from pilotage.geometry import Pose2
from pilotage.localization.sensor_model import SparseScan, thin_scan
from pilotage.perception import LaserScan
from pilotage.shape import PartialShape, Simplification, simplify_all
from pilotage.shape.corners import Corners, find_corners

CORNERS = Simplification(min_relevance=0.08)
"""[rad m] Simplification before corners are sought: a right angle between sides of 10 cm has 0.08."""


@dataclass(frozen=True, slots=True, eq=False)
class Observation:
    """A scan thinned for comparison with a drawing, its corners, and the motion before it."""

    scan: SparseScan
    corners: Corners  # in the frame of the robot [m]
    motion: Pose2  # since the last keyframe
    stamp: float  # [s]
    view: float  # [rad] that the scan covers, at most a full turn
    was_carried: bool  # since the last keyframe: this scan shows another place
    log_elsewhere: float = 0.0  # [nats] log-likelihood ratio of being in another building than the drawn one


def observe(
    scan: LaserScan, shapes: tuple[PartialShape, ...], motion: Pose2, *, was_carried: bool = False
) -> Observation:
    """Take what is compared with a drawing from a scan and its perceived shapes, in the robot's frame."""
    corners = find_corners(simplify_all([shape.polyline for shape in shapes], CORNERS, compiled=True))
    return Observation(thin_scan(scan), corners, motion, scan.stamp, scan.view, was_carried)
