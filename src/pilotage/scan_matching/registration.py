"""What registering a scan into the perception map found out."""

from dataclasses import dataclass

from pilotage.geometry import Array, Pose2
from pilotage.perception.scan import Odometry
from pilotage.scan_matching.odometry_noise import OdometryNoise
from pilotage.shape.partial import PartialShape


@dataclass(frozen=True, slots=True)
class Correspondence:
    """A perceived shape and the known shape it lies on."""

    seen: int  # index into `Registration.shapes`
    known: int  # index into `PerceptionMap.shapes`
    overlap: float  # [m] of the seen shape on the known one
    dissimilarity: float  # [m] root mean square distance along the overlap


@dataclass(frozen=True, eq=False)
class Registration:
    """Where a scan was taken, in the frame of the perception map, and how well that is known.

    The frame is called `odom`: poses in it are continuous and drift; it is the robot's odometry as
    registration corrected it, so not the raw one.
    """

    odometry: Odometry  # the raw reckoning that came with the scan
    odom_from_base: Pose2
    last_from_base: Pose2  # the motion since the last reading, as registered
    shapes: tuple[PartialShape, ...]  # as perceived, in the base frame
    correspondences: tuple[Correspondence, ...]
    unmatched: tuple[int, ...]  # perceived shapes that known ones do not cover: what just came into sight
    support: float  # [0..1] share of the length of all shapes that lies on known ones
    residual: float  # [m] root mean square distance of what does
    covariance: Array  # (3, 3) of x, y, theta of `odom_from_base` [m, m, rad]
    noise: OdometryNoise  # how far odometry errs, as learnt so far
