"""The shortest way of a robot's body from place to place in the true building."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array, frozen_array

if TYPE_CHECKING:
    from pilotage.kernels.segment_grid import SegmentGrid

STEP = 0.05
"""Spacing [m] of the grid over which ways are sought."""

MOST_POINTS = 4_000_000
"""Points of that grid, at most; it is coarser in a building of more than 100 m by 100 m."""

NEAR = 4
"""Steps of the grid within which the robot goes straight between its points and start or goal."""


@dataclass(frozen=True, eq=False)
class Way:
    """Straight from point to point."""

    points: Array  # (n, 2) [m], from the start to the goal; (0, 2) if there is no way

    def __post_init__(self) -> None:
        """Copy and freeze the points."""
        object.__setattr__(self, "points", frozen_array(self.points))

    @property
    def length(self) -> float:
        """How long it is [m]; inf if there is none."""
        if len(self.points) == 0:
            return math.inf
        steps = np.diff(self.points, axis=0)
        return float(np.hypot(steps[:, 0], steps[:, 1]).sum())


NO_WAY = Way(np.empty((0, 2)))


@dataclass(frozen=True, eq=False)
class Ways:
    """Where a disc can be: points of a grid, ready for many searches."""

    grid: "SegmentGrid"
    radius: float  # [m] of the disc
    corner: Array  # (2,) where the first point lies [m]
    step: float  # [m]
    is_free: NDArray[np.bool_]  # (columns, rows); far enough off all things for a step to any free neighbor

    @classmethod
    def among(cls, grid: "SegmentGrid", radius: float) -> "Ways":
        """Lay points over all segments of a grid."""
        extent = np.array([grid.columns, grid.rows]) * grid.cell
        step = max(STEP, math.sqrt(float(extent.prod()) / MOST_POINTS))
        columns, rows = np.ceil(extent / step).astype(int)
        corner = np.array([grid.left, grid.bottom])
        points = corner + step * np.argwhere(np.ones((columns, rows), dtype=bool))
        # whatever is nearer than the radius to a step is nearer than this to one of its ends
        reach = math.hypot(radius, kernels.shortest_way.LONGEST_STEP * step / 2.0)
        is_free = kernels.contact.clearances(points, grid, reach) >= reach
        return cls(grid, radius, corner, step, is_free.reshape(columns, rows))

    def shortest(self, start: Array, goal: Array) -> Way:
        """Find the shortest way from one place (2,) [m], where the disc can be, to another."""
        x, y = goal - start
        if kernels.contact.share_before_grid(start[0], start[1], x, y, self.radius, self.grid) == 1.0:
            return Way(np.array([start, goal]))
        backwards = kernels.shortest_way.find_way(self.is_free, self._costs_to(start), self._costs_to(goal))
        if len(backwards) == 0:
            return NO_WAY
        inner = np.column_stack(np.divmod(backwards[::-1], self.is_free.shape[1])) * self.step + self.corner
        points = np.vstack([start, inner, goal])
        return Way(points[kernels.shortest_way.pull_taut(points, self.radius, self.grid)])

    def _costs_to(self, place: Array) -> Array:
        """Return how far it is straight to the points near a place [steps], inf for all others."""
        costs = np.full(self.is_free.shape, np.inf)
        middle = np.rint((place - self.corner) / self.step).astype(int)
        low = np.maximum(middle - NEAR, 0)
        for column, row in np.argwhere(self.is_free[tuple(map(slice, low, middle + NEAR + 1))]) + low:
            x, y = self.corner + self.step * np.array([column, row]) - place
            if kernels.contact.share_before_grid(place[0], place[1], x, y, self.radius, self.grid) == 1.0:
                costs[column, row] = math.hypot(x, y) / self.step
        return costs
