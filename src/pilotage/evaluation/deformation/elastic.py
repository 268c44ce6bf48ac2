"""Bend the sheet: each room gets proportions of its own, and all stay joined.

On a grid of nodes each edge is wanted as long and turned as its room says. The positions that come
closest, in the least squares, solve a Poisson equation, as when an image is made from edited gradients
(Perez, Gangnet and Blake 2003). What neighbors want differs, so the sheet is sheared between rooms.
"""

import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, map_coordinates
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import factorized

from pilotage.geometry import Array

SPACING = 1.0
"""Distance [m] between nodes."""
MARGIN = 4.0
"""Space [m] around the plan."""
LEAST_AREA = 0.03
"""Least share of its area to which half a square of the grid may shrink; below 0 it is turned over."""
WEAKER, AROUND = 0.8, 3
"""Factor by which wishes are weakened where the sheet would fold, and within how many nodes of there."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """A grid of nodes over a plan [m], and where each is bent to."""

    corner: Array  # (2,) of the first node
    nodes: Array  # (columns, rows, 2) bent positions

    def carry(self, points: Array) -> Array:
        """Carry points (n, 2), linearly between nodes."""
        at = ((points - self.corner) / SPACING).T
        return np.stack(
            [map_coordinates(self.nodes[..., k], at, order=1, mode="nearest") for k in (0, 1)], axis=-1
        )


def node_grid(bounds: tuple[float, float, float, float]) -> tuple[Array, Array]:
    """Lay nodes over a plan: the first one (2,), and all of them (columns, rows, 2) [m]."""
    left, bottom, right, top = bounds
    xs, ys = (
        np.arange(low - MARGIN, high + MARGIN + SPACING, SPACING)
        for low, high in ((left, right), (bottom, top))
    )
    return np.array([xs[0], ys[0]]), np.stack(np.meshgrid(xs, ys, indexing="ij"), axis=-1)


def linear_of(wish: Array) -> Array:
    """Turn log scale, p, q and a turn [rad] (..., 4) into linear maps (..., 2, 2), as for particles."""
    log_scale, p, q, turn = np.moveaxis(wish, -1, 0)
    size = np.hypot(p, q)
    share = np.where(size > 0.0, np.sinh(size) / np.maximum(size, 1e-12), 1.0)
    stretch = np.stack([np.cosh(size) + share * p, share * q, share * q, np.cosh(size) - share * p], axis=-1)
    rotation = np.stack([np.cos(turn), -np.sin(turn), np.sin(turn), np.cos(turn)], axis=-1)
    linear = stretch.reshape(*size.shape, 2, 2) @ rotation.reshape(*size.shape, 2, 2)
    return np.asarray(np.exp(log_scale)[..., None, None] * linear)


def bend(corner: Array, wishes: Array) -> Sheet:
    """Solve for the nodes that come closest to the wishes (columns, rows, 4) of `linear_of`.

    Wishes are weakened where the sheet would fold, until it folds nowhere.
    """
    columns, rows = wishes.shape[:2]
    number = np.arange(columns * rows).reshape(columns, rows)
    starts = np.concatenate([number[:-1].ravel(), number[:, :-1].ravel()])
    ends = np.concatenate([number[1:].ravel(), number[:, 1:].ravel()])
    along = np.repeat([0, 1], [(columns - 1) * rows, columns * (rows - 1)])
    edges = np.arange(len(starts))
    ones = np.ones(len(starts))
    incidence = coo_matrix(
        (np.concatenate([-ones, ones]), (np.tile(edges, 2), np.concatenate([starts, ends])))
    ).tocsc()
    pinned = incidence[:, 1:]
    solve = factorized((pinned.T @ pinned).tocsc())
    strength = np.ones((columns, rows, 1))
    while True:
        linear = linear_of(strength * wishes).reshape(-1, 2, 2)
        wanted = SPACING * (linear[starts] + linear[ends])[edges, :, along] / 2.0
        free = np.stack([solve(pinned.T @ wanted[:, k]) for k in (0, 1)], axis=-1)
        nodes = np.vstack([np.zeros((1, 2)), free]).reshape(columns, rows, 2) + corner
        folded = least_areas(nodes) < LEAST_AREA * SPACING**2
        if not folded.any():
            return Sheet(corner, nodes)
        strength[binary_dilation(np.pad(folded, ((0, 1), (0, 1))), iterations=AROUND)] *= WEAKER


def least_areas(nodes: Array) -> Array:
    """Return for each square of nodes (columns, rows, 2) the smallest area of a half of it, twice."""
    a, b, c, d = nodes[:-1, :-1], nodes[1:, :-1], nodes[1:, 1:], nodes[:-1, 1:]
    halves = [
        u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
        for u, v in ((b - a, d - a), (c - b, a - b), (d - c, b - c), (a - d, c - d))
    ]
    return np.asarray(np.min(halves, axis=0))


def waves(points: Array, rng: np.random.Generator, count: int = 6) -> Array:
    """Draw a smooth random field of unit variance at points (..., 2) [m]: waves 20 to 80 m long."""
    total = np.zeros(points.shape[:-1])
    for _ in range(count):
        length, direction, phase = rng.uniform((20.0, 0.0, 0.0), (80.0, math.tau, math.tau))
        along = points @ np.array([math.cos(direction), math.sin(direction)])
        total += math.sqrt(2.0 / count) * np.sin(math.tau * along / length + phase)
    return total


def nearest_room(points: Array, polygons: tuple[shapely.Polygon, ...]) -> NDArray[np.intp]:
    """Find the room that each point (..., 2) lies in or is nearest to, (...,)."""
    found = shapely.STRtree(polygons).nearest(shapely.points(points.reshape(-1, 2)))
    return np.asarray(found, dtype=np.intp).reshape(points.shape[:-1])
