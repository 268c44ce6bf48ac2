"""What moves in a world, and what is true at one moment: doors, people, and all that a spectator sees."""

import math
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, Pose2, frozen_array
from pilotage.perception import LaserScan


@dataclass(frozen=True, eq=False)
class Door:
    """A leaf that stands in its frame while it is closed, and is absent while it is open."""

    segment: Array  # (4,) x1, y1, x2, y2 [m]
    closed: tuple[tuple[float, float], ...] = ()  # from when until when [s], as often as it closes

    def __post_init__(self) -> None:
        """Copy and freeze the segment; reject a segment of another shape and times that run backwards."""
        segment = frozen_array(self.segment)
        if segment.shape != (4,) or not np.isfinite(segment).all():
            raise ValueError(f"a door's segment must be four finite numbers, got {segment}")
        object.__setattr__(self, "segment", segment)
        for since, until in self.closed:
            if not since < until:
                raise ValueError(f"a door must close before it opens again, got {since} to {until} s")

    @property
    def never_opens(self) -> bool:
        """Whether it is closed at all times."""
        return any(since <= 0.0 and until == math.inf for since, until in self.closed)

    def should_be_closed(self, stamp: float) -> bool:
        """Tell whether its schedule wants it closed at this time [s]."""
        return any(since <= stamp < until for since, until in self.closed)


@dataclass(frozen=True, eq=False)
class Movers:
    """Where people and closed doors are at one moment."""

    people: Array  # (k, 3) x, y, radius [m]
    closed_doors: Array  # (m, 4) x1, y1, x2, y2 [m]

    def __post_init__(self) -> None:
        """Copy and freeze the arrays; reject other shapes."""
        freeze_rows(self, people=3, closed_doors=4)


@dataclass(frozen=True, eq=False)
class Scene:
    """The robot, its scan, and all that moves at one moment; in the frame of the world [m], y up."""

    world_from_base: Pose2
    scan: LaserScan
    people: Array  # (k, 2) where people stand
    closed_doors: Array  # (m, 4) as x1, y1, x2, y2
    collisions: int = 0  # contacts until now, each counted once

    def __post_init__(self) -> None:
        """Copy and freeze the arrays; reject other shapes."""
        freeze_rows(self, people=2, closed_doors=4)

    @property
    def stamp(self) -> float:
        """The time of the scan [s]."""
        return self.scan.stamp


def freeze_rows(owner: Movers | Scene, **widths: int) -> None:
    """Copy and freeze fields that hold rows of numbers; reject rows of another width."""
    for name, width in widths.items():
        rows = frozen_array(getattr(owner, name))
        if rows.ndim != 2 or rows.shape[1] != width:
            raise ValueError(f"{name} must have shape (n, {width}), got {rows.shape}")
        object.__setattr__(owner, name, rows)


NOBODY = Movers(np.empty((0, 3)), np.empty((0, 4)))
"""An empty building with all doors open."""
