"""What the robot reads: scans of its laser and its own reckoning of how it moved."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Pose2, frozen_array


@dataclass(frozen=True, eq=False)
class LaserScan:
    """One sweep of a 2-D laser; field names as in ROS sensor_msgs/LaserScan, special ranges as in REP-117.

    Beam i points at `angle_min + i * angle_increment` in the laser's frame (x forward, y left). A range of
    -inf means too close, +inf no return, nan invalid; a range beyond [range_min, range_max] counts as the
    first two of these.
    """

    stamp: float  # [s]
    angle_min: float  # [rad] direction of the first beam
    angle_increment: float  # [rad] from beam to beam; negative when the laser turns clockwise
    ranges: Array  # (n,) [m]
    range_min: float = 0.0  # [m]
    range_max: float = math.inf  # [m]
    base_from_laser: Pose2 = field(default_factory=Pose2.identity)

    def __post_init__(self) -> None:
        """Copy the ranges, refuse what no laser can mean, and spell out the limits."""
        ranges = np.array(self.ranges, dtype=np.float64)
        if ranges.ndim != 1 or len(ranges) == 0:
            raise ValueError(f"ranges must have shape (n,) with n >= 1, got {ranges.shape}")
        for name in ("stamp", "angle_min", "angle_increment", "range_min"):
            if not math.isfinite(getattr(self, name)):
                raise ValueError(f"{name} must be finite, got {getattr(self, name)}")
        if len(ranges) > 1 and self.angle_increment == 0.0:
            raise ValueError("angle_increment must not be 0")
        if not self.range_max > self.range_min >= 0.0:
            raise ValueError(
                f"ranges need 0 <= range_min < range_max, got {self.range_min}, {self.range_max}"
            )
        ranges[ranges >= self.range_max] = np.inf
        ranges[ranges < self.range_min] = -np.inf
        object.__setattr__(self, "ranges", frozen_array(ranges))

    def __len__(self) -> int:
        """Count the beams."""
        return len(self.ranges)

    @property
    def directions(self) -> Array:
        """Direction of each beam in the laser's frame, (n,) [rad]."""
        return self.angle_min + self.angle_increment * np.arange(len(self.ranges), dtype=np.float64)

    @property
    def returned(self) -> NDArray[np.bool_]:
        """Which beams came back with a range, (n,)."""
        return np.isfinite(self.ranges)

    @property
    def points_in_base(self) -> Array:
        """The returns in order of beams, (k, 2) [m]."""
        hit = self.returned
        ranges, directions = self.ranges[hit], self.directions[hit]
        return self.base_from_laser @ np.column_stack(
            [ranges * np.cos(directions), ranges * np.sin(directions)]
        )


@dataclass(frozen=True, slots=True)
class Odometry:
    """The robot's own reckoning; believed only from one reading to the next."""

    stamp: float  # [s]
    odom_from_base: Pose2  # [m, rad]


@dataclass(frozen=True, slots=True)
class Reading:
    """A scan and the odometry at its moment."""

    scan: LaserScan
    odometry: Odometry
