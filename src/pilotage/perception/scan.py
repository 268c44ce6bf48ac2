"""What the robot reads: scans of its laser, and odometry."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Pose2, frozen_array

MAX_TRUSTED_RANGE = 100.0
"""[m] A farther return counts as none: 2-D scanners of robots reach 80 m or less, and one wrong range of
1e9 m would make the local map as large."""

MAX_MOUNT_DISTANCE = 10.0
"""[m] A laser farther from the robot's base is a mistake in its description, millimetres taken for metres."""


@dataclass(frozen=True, eq=False)
class LaserScan:
    """One sweep of a 2-D laser; field names as in ROS sensor_msgs/LaserScan, special ranges as in REP-117.

    Beam i points at `angle_min + i * angle_increment` in the laser's frame (x forward, y left). A range of
    -inf means too close, +inf no return, nan invalid; a range beyond [range_min, range_max] counts as the
    first two of these, and so does a range beyond `MAX_TRUSTED_RANGE`.
    """

    stamp: float  # [s]
    angle_min: float  # [rad] direction of the first beam
    angle_increment: float  # [rad] from beam to beam; negative when the laser turns clockwise
    ranges: Array  # (n,) [m]
    range_min: float = 0.0  # [m]
    range_max: float = math.inf  # [m]
    base_from_laser: Pose2 = field(default_factory=Pose2.identity)

    def __post_init__(self) -> None:
        """Copy the ranges, reject impossible values, and replace ranges beyond the limits."""
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
        mount = math.hypot(self.base_from_laser.x, self.base_from_laser.y)
        if mount > MAX_MOUNT_DISTANCE:
            raise ValueError(
                f"base_from_laser must be within {MAX_MOUNT_DISTANCE:g} m of the base, got {mount:g} m"
            )
        ranges[ranges >= min(self.range_max, MAX_TRUSTED_RANGE)] = np.inf
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
    def view(self) -> float:
        """Angle that the scan covers, at most a full turn [rad]."""
        return min(len(self.ranges) * abs(self.angle_increment), math.tau)

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
    """The pose that the robot's odometry reports; used only from one reading to the next."""

    stamp: float  # [s]
    odom_from_base: Pose2  # [m, rad]
    is_known: bool = True  # False if the robot has no odometry: then the pose means nothing

    def __post_init__(self) -> None:
        """Reject a stamp that is not a number."""
        if not math.isfinite(self.stamp):
            raise ValueError(f"stamp must be finite, got {self.stamp}")


@dataclass(frozen=True, slots=True)
class Reading:
    """A scan and the odometry at its moment."""

    scan: LaserScan
    odometry: Odometry
