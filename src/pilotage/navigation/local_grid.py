"""An occupancy grid of the few metres around the robot, and the set of places that it can reach there.

The grid is in the frame of odometry and moves along with the robot. It is no map of the building: what the
robot leaves behind is forgotten.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array, Pose2
from pilotage.perception import LaserScan

SIZE = 16.0
"""Side [m] of the square that is kept: a room, and more than the robot plans ahead."""

CELL = 0.05
"""Size of a grid cell [m]: a quarter of a robot's radius."""

CLEARANCE = 0.03
"""Least distance of the footprint from obstacles [m]."""

EASY = 0.35
"""Distance of the footprint from obstacles [m] from which on driving costs no more than in the open."""

BLOCK = 4
"""Cells to the side of a block that is closed or not as one: 20 cm."""

USUAL_RADIUS = 0.6
"""Clearances are measured as far as a robot of this radius [m] needs, or a larger one."""

NO_RETURN = 3.0
"""Length of a beam [m] that counts as free if neither it nor its neighbors return."""

INTERPOLATED = 3
"""Number of beams interpolated between neighbors: without them stripes stay unknown."""


@dataclass(frozen=True, eq=False)
class LocalGrid:
    """Evidence of each grid cell as in kernels/local_grid.py; begin with `LocalGrid.unknown`."""

    evidence: NDArray[np.int8]  # (count, count)
    corner: tuple[int, int]  # cells from the origin of odom to the corner of the square
    odom_from_base: Pose2
    cell: float = CELL  # [m]

    @classmethod
    def unknown(cls, size: float = SIZE, cell: float = CELL) -> "LocalGrid":
        """Begin with nothing seen; `size` [m] is the side of the square."""
        count = round(size / cell)
        return cls(
            np.zeros((count, count), dtype=np.int8), (-(count // 2), -(count // 2)), Pose2.identity(), cell
        )

    def seen(self, scan: LaserScan, odom_from_base: Pose2) -> "LocalGrid":
        """Move the grid along with the robot and enter a scan."""
        evidence, corner = self._recentered(odom_from_base)
        cell = self.cell
        odom_from_laser = odom_from_base @ scan.base_from_laser
        returned = scan.returned
        ranges = np.where(returned, scan.ranges, 0.0)
        nothing = scan.ranges == np.inf  # a single beam without return is glass or black paint
        is_ring = math.tau - scan.view < abs(scan.angle_increment)  # the last beam is beside the first
        beside = np.pad(nothing, 1, mode="wrap" if is_ring else "edge")
        nothing &= beside[:-2] & beside[2:]
        ranges[nothing] = min(NO_RETURN, scan.range_max)
        origin = (odom_from_laser.x / cell - corner[0], odom_from_laser.y / cell - corner[1])
        beams = densified(odom_from_laser.theta + scan.directions, ranges / cell, returned)
        kernels.local_grid.mark(evidence, origin, *beams)
        return LocalGrid(evidence, corner, odom_from_base, cell)

    def _recentered(self, odom_from_base: Pose2) -> tuple[NDArray[np.int8], tuple[int, int]]:
        """Copy the evidence; shift it once the robot has left the middle by a sixteenth of the square."""
        count, cell = len(self.evidence), self.cell
        middle = tuple(
            math.floor(value / cell) - count // 2 for value in (odom_from_base.x, odom_from_base.y)
        )
        shift = middle[0] - self.corner[0], middle[1] - self.corner[1]
        if max(abs(shift[0]), abs(shift[1])) < count / 16.0:
            return self.evidence.copy(), self.corner
        evidence = np.zeros_like(self.evidence)
        kept = [(max(0, one), min(count, count + one)) for one in shift]
        if all(first < last for first, last in kept):
            (a, b), (c, d) = kept
            evidence[a - shift[0] : b - shift[0], c - shift[1] : d - shift[1]] = self.evidence[a:b, c:d]
        return evidence, (middle[0], middle[1])

    def cells_at(self, points: Array) -> NDArray[np.int64]:
        """Find the grid cell of each point (n, 2) in odom [m], (n, 2); it may lie outside the square."""
        return np.floor(points / self.cell).astype(np.int64) - self.corner

    def middles(self, cells: NDArray[np.int64]) -> Array:
        """Return the middles of cells (n, 2) in odom, (n, 2) [m]."""
        return np.asarray((cells + self.corner + 0.5) * self.cell)

    def without(self, are_closed: Callable[[Array], NDArray[np.bool_]]) -> "LocalGrid":
        """Enter as obstacles what a test of points (n, 2) in odom [m] closes; it is asked once a `BLOCK`."""
        count = -(-len(self.evidence) // BLOCK)
        blocks = np.stack(np.meshgrid(np.arange(count), np.arange(count), indexing="ij"), axis=-1)
        middles = self.middles(BLOCK * blocks.reshape(-1, 2) + BLOCK // 2)
        closed = are_closed(middles).reshape(count, count).repeat(BLOCK, axis=0).repeat(BLOCK, axis=1)
        closed = closed[: len(self.evidence), : len(self.evidence)]
        return replace(self, evidence=np.where(closed, np.int8(1), self.evidence))

    @cached_property
    def obstacles(self) -> Array:
        """The middles of the occupied cells in odom, (n, 2) [m]."""
        return self.middles(np.argwhere(self.evidence > 0))

    def reachable_set(self, radius: float) -> "ReachableSet":
        """Find where a disc of this radius [m] can go over space that was seen free."""
        farthest = math.ceil((EASY + max(radius, USUAL_RADIUS)) / self.cell)
        start = self.cells_at(self.odom_from_base.position[np.newaxis])[0]
        tight, easy = (radius + CLEARANCE) / self.cell, (radius + EASY) / self.cell
        # a cell's clearance is measured from middle to middle: half a cell of either may be nearer
        costs, before = kernels.local_grid.flood(
            self.evidence,
            kernels.local_grid.clearances(self.evidence, farthest),
            (int(start[0]), int(start[1])),
            tight + 0.5,
            easy + 0.5,
            2.0 * radius / self.cell,
        )
        return ReachableSet(self, costs, before)


@dataclass(frozen=True, eq=False)
class ReachableSet:
    """Where the robot can go, and by which path."""

    local_grid: LocalGrid
    costs: NDArray[np.int32]  # (count, count), as in kernels/local_grid.py
    before: NDArray[np.int32]  # (count, count)

    @cached_property
    def cells(self) -> NDArray[np.int64]:
        """The reachable grid cells, (n, 2)."""
        return np.argwhere(self.costs < kernels.local_grid.UNREACHED)

    @cached_property
    def points(self) -> Array:
        """Their middles in odom, (n, 2) [m]."""
        return self.local_grid.middles(self.cells)

    @cached_property
    def lengths(self) -> Array:
        """The cost of the path to each, (n,) [m at full clearance]."""
        costs = self.costs[self.cells[:, 0], self.cells[:, 1]]
        return np.asarray(costs * (self.local_grid.cell / kernels.local_grid.STRAIGHT))

    def nearest(self, point: Array, *, path_cost: float, extra: Array) -> int:
        """Choose of `points` the one nearest to a point (2,) in odom.

        Each metre of the path to it adds `path_cost` [m], and the place itself `extra` (n,) [m].
        """
        gaps = np.hypot(*(self.points - point).T)
        return int((gaps + path_cost * self.lengths + extra).argmin())

    def path_to(self, index: int) -> Array:
        """Return the path from the robot to one of `points`, (k, 2) in odom [m]."""
        height = self.before.shape[1]
        flat = [int(self.cells[index, 0]) * height + int(self.cells[index, 1])]
        while (previous := int(self.before[flat[-1] // height, flat[-1] % height])) >= 0:
            flat.append(previous)
        cells = np.array(flat[::-1], dtype=np.int64)
        return self.local_grid.middles(np.column_stack([cells // height, cells % height]))


def densified(
    directions: Array, ranges: Array, returned: NDArray[np.bool_]
) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Interpolate beams between neighbors, each as long as the shorter of the two."""
    steps, shorter = np.diff(directions), np.minimum(ranges[:-1], ranges[1:])
    gap = math.tau - abs(directions[-1] - directions[0])
    if len(steps) and 0.0 < gap < 1.5 * abs(steps[0]):  # all around: the last beam is beside the first
        steps = np.append(steps, math.copysign(gap, steps[0]))
        shorter = np.append(shorter, min(ranges[-1], ranges[0]))
    shares = np.arange(1, INTERPOLATED + 1)[:, np.newaxis] / (INTERPOLATED + 1)
    between = directions[: len(steps)] + shares * steps
    return (
        np.concatenate([directions, between.ravel()]),
        np.concatenate([ranges, np.broadcast_to(shorter, between.shape).ravel()]),
        np.concatenate([returned, np.zeros(between.size, dtype=np.bool_)]),
    )
