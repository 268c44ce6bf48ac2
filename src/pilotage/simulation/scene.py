"""What is true at one moment of a simulation: what a spectator would see, and the robot never does."""

from dataclasses import dataclass

from pilotage.geometry import Array, Pose2, frozen_array
from pilotage.perception import LaserScan


@dataclass(frozen=True, eq=False)
class Scene:
    """The robot, what its laser meets, and all that moves; in the frame of the world [m], y up."""

    world_from_base: Pose2
    scan: LaserScan
    people: Array  # (k, 2) where people stand
    closed_doors: Array  # (m, 4) as x1, y1, x2, y2
    collisions: int = 0  # contacts so far, each counted once

    def __post_init__(self) -> None:
        """Copy and freeze the arrays; refuse other shapes."""
        for name, width in (("people", 2), ("closed_doors", 4)):
            rows = frozen_array(getattr(self, name))
            if rows.ndim != 2 or rows.shape[1] != width:
                raise ValueError(f"{name} must have shape (n, {width}), got {rows.shape}")
            object.__setattr__(self, name, rows)

    @property
    def stamp(self) -> float:
        """The time of the scan [s]."""
        return self.scan.stamp
