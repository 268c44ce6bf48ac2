"""Other proportions for a drawing: each axis is stretched here and squeezed there."""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np

from pilotage.geometry import Array, Pose2, frozen_array

PARTS = 6
"""Parts of an axis, each with a scale of its own."""
BEYOND = 0.5
"""The outermost scales hold this far beyond the drawing, as a share of its size."""
SPREAD = 0.45
"""Standard deviation of the logarithm of a part's scale at severity 1."""
ASPECT = 0.25
"""Standard deviation of the logarithm of the scale of a whole axis at severity 1."""
MOST_LOG = 1.0
"""Largest logarithm of a part's scale: a room is drawn up to 2.7 times too long or too short."""
NEAR = 1e-3
"""Distance [m] over which a heading is carried."""


@dataclass(frozen=True, eq=False)
class Proportions:
    """A map from drawing to world: increasing and piecewise linear along each axis, so walls stay upright.

    Rows are x and y; columns are knots.
    """

    in_sketch: Array  # (2, k) [drawing units]
    in_world: Array  # (2, k) [m]

    def __post_init__(self) -> None:
        """Copy and freeze the knots."""
        for name in ("in_sketch", "in_world"):
            object.__setattr__(self, name, frozen_array(getattr(self, name)))

    @classmethod
    def at_random(
        cls,
        bounds: tuple[float, float, float, float],
        metres_per_unit: float,
        severity: float,
        rng: np.random.Generator,
    ) -> Self:
        """Draw proportions for a drawing of these bounds; at severity 0 they are those of the drawing."""
        left, bottom, right, top = bounds
        rows = []
        for low, high in ((left, right), (bottom, top)):
            size = max(high - low, 1e-9)
            knots = np.array([low - BEYOND * size, *np.linspace(low, high, PARTS + 1), high + BEYOND * size])
            logs = severity * (SPREAD * rng.normal(size=PARTS + 2) + ASPECT * rng.normal())
            steps = np.diff(knots) * np.exp(np.clip(logs, -MOST_LOG, MOST_LOG)) * metres_per_unit
            rows.append((knots, np.concatenate([[0.0], np.cumsum(steps)])))
        return cls(np.array([row[0] for row in rows]), np.array([row[1] for row in rows]))

    def scaled(self, factor: float) -> Self:
        """Make the whole world larger."""
        return type(self)(self.in_sketch, self.in_world * factor)

    def world_from_sketch(self, points: Array) -> Array:
        """Carry points (n, 2) of the drawing to the world [m]."""
        return carried(points, self.in_sketch, self.in_world)

    def sketch_from_world(self, points: Array) -> Array:
        """Carry points (n, 2) of the world [m] to the drawing."""
        return carried(points, self.in_world, self.in_sketch)

    def sketch_pose(self, world_from_base: Pose2) -> tuple[float, float, float]:
        """Carry a pose of the world to the drawing: x, y and heading [rad]."""
        here = world_from_base.position
        ahead = here + NEAR * world_from_base.rotation[:, 0]
        (x, y), (to_x, to_y) = self.sketch_from_world(np.array([here, ahead])).tolist()
        return x, y, math.atan2(to_y - y, to_x - x)

    def bent(self, segments: Array) -> Array:
        """Carry segments (n, 4) of the drawing to the world, cut where they cross a knot, (m, 4) [m]."""
        pieces = [
            np.column_stack([ends[:-1], ends[1:]])
            for ends in (self.world_from_sketch(points) for points in map(self._cut, segments))
        ]
        return np.vstack(pieces) if pieces else np.empty((0, 4))

    def _cut(self, segment: Array) -> Array:
        """Return the ends of a segment (4,), and between them where it crosses knots, (k, 2)."""
        start, along = segment[:2], segment[2:] - segment[:2]
        shares = [(self.in_sketch[axis] - start[axis]) / along[axis] for axis in (0, 1) if along[axis] != 0.0]
        inner = np.concatenate([*shares, []])
        inner = np.unique(inner[(inner > 0.0) & (inner < 1.0)])
        return np.asarray(start + np.concatenate([[0.0], inner, [1.0]])[:, np.newaxis] * along)


def carried(points: Array, before: Array, after: Array) -> Array:
    """Carry points (n, 2) by two piecewise linear functions, one a row of knots (2, k)."""
    return np.column_stack([np.interp(points[:, axis], before[axis], after[axis]) for axis in (0, 1)])
