"""Where something was, and when."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from pilotage.geometry.arrays import Array, frozen_array
from pilotage.geometry.pose import Pose2


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Poses in the order they were taken; stamps need neither rise nor differ.

    >>> Trajectory([0.5], [[1.0, 2.0, 0.0]]).pose(0)
    Pose2(x=1.0, y=2.0, theta=0.0)
    """

    stamps: Array  # (n,) [s]
    poses: Array  # (n, 3) x [m], y [m], theta [rad]

    def __post_init__(self) -> None:
        """Copy and freeze; reject arrays that do not belong together or are not finite."""
        stamps, poses = frozen_array(self.stamps), frozen_array(self.poses)
        if stamps.ndim != 1 or poses.shape != (len(stamps), 3):
            raise ValueError(
                f"a trajectory needs stamps (n,) and poses (n, 3), got {stamps.shape}, {poses.shape}"
            )
        if not (np.isfinite(stamps).all() and np.isfinite(poses).all()):
            raise ValueError("stamps and poses must be finite")
        object.__setattr__(self, "stamps", stamps)
        object.__setattr__(self, "poses", poses)

    def __len__(self) -> int:
        """Count the poses."""
        return len(self.stamps)

    def __iter__(self) -> Iterator[Pose2]:
        """Go through the poses in order."""
        return (self.pose(index) for index in range(len(self)))

    def pose(self, index: int) -> Pose2:
        """Return one pose."""
        x, y, theta = self.poses[index].tolist()
        return Pose2(x, y, theta)
