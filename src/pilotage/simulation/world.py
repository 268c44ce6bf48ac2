"""The true building: walls and things as a laser and a robot's body meet them."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pilotage import kernels
from pilotage.geometry import Array, Pose2, frozen_array, frozen_points
from pilotage.maps import SchematicMap
from pilotage.simulation.people import Person
from pilotage.simulation.scene import Door
from pilotage.simulation.ways import NO_WAY, Way, Ways

if TYPE_CHECKING:
    from pilotage.kernels.segment_grid import SegmentGrid

FAR = 1e9
"""Farther than anything stands [m]."""


def no_segments() -> Array:
    """Return an empty list of segments."""
    return np.empty((0, 4))


@dataclass(frozen=True, eq=False)
class World:
    """What stands in the building, rows x1, y1, x2, y2, (n, 4) [m], y up; and what moves in it.

    Free space is where the robot's disc touches nothing. If the segments are contours, they part free space
    from what is solid, and so the inside of a wall is not free, however thick it is.
    """

    segments: Array  # opaque
    glass: Array = field(default_factory=no_segments)  # solid, and seen by few beams
    doors: tuple[Door, ...] = ()
    people: tuple[Person, ...] = ()
    start: Pose2 | None = None  # where a drive begins if nothing else is said
    contours: bool = False

    def __post_init__(self) -> None:
        """Copy and freeze the segments; reject another shape and numbers that are not finite."""
        for name in ("segments", "glass"):
            segments = frozen_array(getattr(self, name))
            if segments.ndim != 2 or segments.shape[1] != 4:
                raise ValueError(f"{name} must have shape (n, 4), got {segments.shape}")
            if not np.isfinite(segments).all():
                raise ValueError(f"{name} must be finite, got some that are not")
            object.__setattr__(self, name, segments)

    @classmethod
    def of(cls, plan: SchematicMap) -> Self:
        """Take every stroke of a plan drawn to scale, its unit the metre, for a wall."""
        return cls(plan.segments)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, bottom, right and top of all that stands [m]."""
        points = self.solid.reshape(-1, 2)
        (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
        return float(left), float(bottom), float(right), float(top)

    @cached_property
    def solid(self) -> Array:
        """All that always stops a robot: walls, glass, doors that never open, (n, 4) [m]."""
        locked = [door.segment for door in self.doors if door.never_opens]
        return np.vstack([self.segments, self.glass, *(segment[np.newaxis] for segment in locked)])

    @cached_property
    def opaque_grid(self) -> "SegmentGrid":
        """What stops beams, ready for look-up."""
        return kernels.segment_grid.build_grid(np.array(self.segments))

    @cached_property
    def solid_grid(self) -> "SegmentGrid":
        """What stops a robot, ready for look-up."""
        return kernels.segment_grid.build_grid(np.array(self.solid))

    def ranges(self, origins: Array, directions: Array) -> Array:
        """Measure from origins (n, 2) [m] along directions (n,) [rad] to a wall, (n,) [m]; inf if none.

        Glass, doors and people are not met.
        """
        return np.asarray(
            kernels.raycast.cast_through(
                np.ascontiguousarray(origins, dtype=np.float64),
                np.ascontiguousarray(directions, dtype=np.float64),
                self.opaque_grid,
            )
        )

    def clearance(self, points: ArrayLike, within: float = FAR) -> Array:
        """Measure from each point (n, 2) [m] to the nearest thing that always stands, (n,) [m].

        The search ends `within` so many metres, and that is the answer if there is nothing.
        """
        where = frozen_points(points, name="points", at_least=0)
        writable = np.array(where, order="C")  # else the kernel is compiled for frozen points, too
        return np.asarray(kernels.contact.clearances(writable, self.solid_grid, within))

    def is_free(self, points: ArrayLike, radius: float) -> NDArray[np.bool_]:
        """Tell at which points (n, 2) [m] a disc of this radius [m] touches nothing that always stands."""
        where = frozen_points(points, name="points", at_least=0)
        is_free = self.clearance(where, radius) >= radius
        if self.contours:
            is_free[is_free] = kernels.enclosure.enclosed(
                where[is_free], self.opaque_grid, self._enclosed_corners
            )
        return is_free

    def shortest_way(self, start: ArrayLike, goal: ArrayLike, radius: float) -> Way:
        """Find the shortest way [m] of a disc of this radius [m] from place to place, (2,) [m] each.

        Doors are open, but for those that never are, and people step aside. Without a way its length is inf.
        """
        ends = frozen_points(np.array([start, goal]), name="start and goal", at_least=2)
        if not self.is_free(ends, radius).all():
            return NO_WAY
        if radius not in self._ways:
            self._ways[radius] = Ways.among(self.solid_grid, radius)
        return self._ways[radius].shortest(ends[0], ends[1])

    @cached_property
    def _enclosed_corners(self) -> NDArray[np.bool_]:
        """Which corners of the grid contours enclose."""
        return np.asarray(kernels.enclosure.enclosed_corners(self.opaque_grid))

    @cached_property
    def _ways(self) -> dict[float, Ways]:
        """Where discs of each radius asked for can be."""
        return {}
