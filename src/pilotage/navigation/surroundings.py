"""What is free and what stands around the robot now: the only map that motion needs.

A few metres, in the frame of odometry, that move along with the robot and forget: no map of the building.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Pose2
from pilotage.perception import LaserScan


@dataclass(frozen=True, slots=True)
class SurroundingsSettings:
    """How much is kept around the robot, and how it keeps off what stands there."""

    size: float = 16.0  # [m] of the square that is kept
    cell: float = 0.05  # [m]
    margin: float = 0.03  # [m] that the footprint stays off things, at least
    ease: float = 0.35  # [m] from the footprint to the nearest thing from which on moving is easy
    no_return: float = 3.0  # [m] that are free along a beam which, as its neighbors, does not come back

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("size", "cell", "ease"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0 m, got {getattr(self, name)}")
        for name in ("margin", "no_return"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0 m, got {getattr(self, name)}")

        if not self.ease > self.margin:
            raise ValueError(f"ease must be > margin, got {self.ease} and {self.margin}")

    @property
    def count(self) -> int:
        """How many cells the square is wide."""
        return round(self.size / self.cell)


@dataclass(frozen=True, eq=False)
class Surroundings:
    """Evidence of each cell of a square as in kernels/local_grid.py; begin with `Surroundings.unseen`."""

    evidence: NDArray[np.int8]  # (count, count)
    corner: tuple[int, int]  # cells from the origin of odom to the corner of the square
    odom_from_base: Pose2
    settings: SurroundingsSettings

    @classmethod
    def unseen(cls, settings: SurroundingsSettings) -> "Surroundings":
        """Begin with nothing seen, the robot in the middle."""
        half = settings.count // 2
        evidence = np.zeros((settings.count, settings.count), dtype=np.int8)
        return cls(evidence, (-half, -half), Pose2.identity(), settings)

    def seen(self, scan: LaserScan, odom_from_base: Pose2) -> "Surroundings":
        """Move along with the robot, and enter a scan."""
        from pilotage.kernels.local_grid import mark

        evidence, corner = self._recentered(odom_from_base)
        cell = self.settings.cell
        odom_from_laser = odom_from_base @ scan.base_from_laser
        returned = scan.returned
        ranges = np.where(returned, scan.ranges, 0.0)
        nothing = scan.ranges == np.inf  # lone beams that do not return mean nothing: glass, black paint
        nothing &= np.roll(nothing, 1) & np.roll(nothing, -1)
        ranges[nothing] = min(self.settings.no_return, scan.range_max)
        origin = (odom_from_laser.x / cell - corner[0], odom_from_laser.y / cell - corner[1])
        mark(evidence, origin, *densified(odom_from_laser.theta + scan.directions, ranges / cell, returned))
        return Surroundings(evidence, corner, odom_from_base, self.settings)

    def _recentered(self, odom_from_base: Pose2) -> tuple[NDArray[np.int8], tuple[int, int]]:
        """Copy the evidence, shifted so that the robot is in the middle again if it left it by far."""
        count, cell = self.settings.count, self.settings.cell
        middle = tuple(
            math.floor(value / cell) - count // 2 for value in (odom_from_base.x, odom_from_base.y)
        )
        shift = middle[0] - self.corner[0], middle[1] - self.corner[1]
        if max(abs(shift[0]), abs(shift[1])) * cell < self.settings.size / 16.0:
            return self.evidence.copy(), self.corner
        evidence = np.zeros_like(self.evidence)
        kept = [(max(0, one), min(count, count + one)) for one in shift]
        if all(first < last for first, last in kept):
            (a, b), (c, d) = kept
            evidence[a - shift[0] : b - shift[0], c - shift[1] : d - shift[1]] = self.evidence[a:b, c:d]
        return evidence, (middle[0], middle[1])

    def cells_at(self, points: Array) -> NDArray[np.int64]:
        """Find the cell of each point (n, 2) in odom [m], (n, 2); it may lie off the square."""
        return np.floor(points / self.settings.cell).astype(np.int64) - self.corner

    def middles(self, cells: NDArray[np.int64]) -> Array:
        """Return the middles of cells (n, 2) in odom, (n, 2) [m]."""
        return np.asarray((cells + self.corner + 0.5) * self.settings.cell)

    @cached_property
    def clearances(self) -> NDArray[np.float32]:
        """From each cell to the nearest thing [cells], as far as it matters."""
        from pilotage.kernels.local_grid import clearances

        return clearances(self.evidence, math.ceil((self.settings.ease + 0.6) / self.settings.cell))

    @cached_property
    def things(self) -> Array:
        """The middles of the occupied cells in odom, (n, 2) [m]."""
        return self.middles(np.argwhere(self.evidence > 0))

    def reach(self, radius: float) -> "Reach":
        """Find where a disc of this radius [m] can go over what was seen free."""
        from pilotage.kernels.local_grid import flood

        settings = self.settings
        start = self.cells_at(self.odom_from_base.position[np.newaxis])[0]
        tight, easy = (radius + settings.margin) / settings.cell, (radius + settings.ease) / settings.cell
        # a cell's clearance is measured from middle to middle: half a cell of either may be nearer
        costs, before = flood(
            self.evidence,
            self.clearances,
            (int(start[0]), int(start[1])),
            tight + 0.5,
            easy + 0.5,
            2.0 * radius / settings.cell,
        )
        return Reach(self, costs, before, tight + 0.5)


@dataclass(frozen=True, eq=False)
class Reach:
    """Where the robot can go, and how."""

    surroundings: Surroundings
    costs: NDArray[np.int32]  # (count, count), as in kernels/local_grid.py
    before: NDArray[np.int32]  # (count, count)
    tight: float  # [cells]

    @cached_property
    def cells(self) -> NDArray[np.int64]:
        """The cells that can be gone to, (n, 2)."""
        from pilotage.kernels.local_grid import UNREACHED

        return np.argwhere(self.costs < UNREACHED)

    @cached_property
    def points(self) -> Array:
        """Their middles in odom, (n, 2) [m]."""
        return self.surroundings.middles(self.cells)

    @cached_property
    def lengths(self) -> Array:
        """What the way to each costs, (n,) [m at full clearance]."""
        from pilotage.kernels.local_grid import STRAIGHT

        costs = self.costs[self.cells[:, 0], self.cells[:, 1]]
        return np.asarray(costs * (self.surroundings.settings.cell / STRAIGHT))

    @cached_property
    def at_rim(self) -> NDArray[np.bool_]:
        """Which of them border on what was not seen, (n,)."""
        unseen = self.surroundings.evidence == 0
        beside = np.zeros_like(unseen)
        beside[1:] |= unseen[:-1]
        beside[:-1] |= unseen[1:]
        beside[:, 1:] |= unseen[:, :-1]
        beside[:, :-1] |= unseen[:, 1:]
        return np.asarray(beside[self.cells[:, 0], self.cells[:, 1]])

    def nearest(self, point: Array, *, way: float, extra: Array) -> int:
        """Choose of `points` the one nearest to a point (2,) in odom.

        Each metre of the way to it counts for `way` more [m], and the place itself for `extra` (n,) [m].
        """
        gaps = np.hypot(*(self.points - point).T)
        return int((gaps + way * self.lengths + extra).argmin())

    def way_to(self, index: int) -> Array:
        """Return the way to one of `points`, from the robot on, (k, 2) in odom [m]."""
        height = self.before.shape[1]
        flat = [int(self.cells[index, 0]) * height + int(self.cells[index, 1])]
        while (previous := int(self.before[flat[-1] // height, flat[-1] % height])) >= 0:
            flat.append(previous)
        cells = np.array(flat[::-1], dtype=np.int64)
        return self.surroundings.middles(np.column_stack([cells // height, cells % height]))


BETWEEN = 3
"""Beams that are thought between two neighboring ones: as free as both, so that no stripes stay unseen."""


def densified(
    directions: Array, ranges: Array, returned: NDArray[np.bool_]
) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Think beams between neighboring ones, each as long as the shorter of the two."""
    steps, shorter = np.diff(directions), np.minimum(ranges[:-1], ranges[1:])
    gap = math.tau - abs(directions[-1] - directions[0])
    if len(steps) and 0.0 < gap < 1.5 * abs(steps[0]):  # all around: the last beam is beside the first
        steps = np.append(steps, math.copysign(gap, steps[0]))
        shorter = np.append(shorter, min(ranges[-1], ranges[0]))
    shares = np.arange(1, BETWEEN + 1)[:, np.newaxis] / (BETWEEN + 1)
    between = directions[: len(steps)] + shares * steps
    return (
        np.concatenate([directions, between.ravel()]),
        np.concatenate([ranges, np.broadcast_to(shorter, between.shape).ravel()]),
        np.concatenate([returned, np.zeros(between.size, dtype=np.bool_)]),
    )
