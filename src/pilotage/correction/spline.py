"""A smooth map of the plane: a tensor product of uniform cubic B-splines over a square grid."""

import math
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix, vstack

from pilotage.geometry import Array, Similarity2

Rows = Any
"""A sparse matrix of scipy, which has no types."""

MARGIN = 2
"""Cells of the grid on each side around what it carries."""


@dataclass(frozen=True, slots=True)
class SplineGrid:
    """Nodes of a grid; node (i, j) is number `i * rows + j`. Coefficients (k, 2) at the nodes make a map.

    With the nodes themselves as coefficients the map is the identity.
    """

    left: float
    bottom: float
    spacing: float
    columns: int
    rows: int

    @classmethod
    def over(cls, points: Array, spacing: float, most: int) -> Self:
        """Lay a grid over points (n, 2), with a wider spacing if it would have more nodes than `most`."""
        low, high = points.min(axis=0), points.max(axis=0)
        extent = np.maximum(high - low, 1e-6)
        wide = max(spacing, math.sqrt(float(extent.prod()) / most), float(extent.max()) / most)
        left, bottom = (low - MARGIN * wide).tolist()
        columns, rows = (np.ceil(extent / wide).astype(int) + 2 * MARGIN + 2).tolist()
        return cls(left, bottom, wide, columns, rows)

    @property
    def nodes(self) -> Array:
        """All nodes, (k, 2)."""
        i, j = np.meshgrid(np.arange(self.columns), np.arange(self.rows), indexing="ij")
        corner = np.array([self.left, self.bottom])
        return np.asarray(np.column_stack([i.ravel(), j.ravel()]) * self.spacing + corner)

    def basis(self, points: Array) -> Rows:
        """Weights of the nodes at points (n, 2), a sparse (n, k); outside the grid those at its border."""
        share = (points - (self.left, self.bottom)) / self.spacing
        share = np.clip(share, 1.0, np.array([self.columns, self.rows]) - 2.0 - 1e-9)
        first = np.floor(share).astype(np.int64)
        t = share - first
        weights = np.stack(
            [(1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3], axis=-1
        )
        steps = np.arange(-1, 3)
        columns = first[:, 0, np.newaxis, np.newaxis] + steps[:, np.newaxis]
        rows = first[:, 1, np.newaxis, np.newaxis] + steps
        values = weights[:, 0, :, np.newaxis] * weights[:, 1, np.newaxis, :] / 36.0
        return csr_matrix(
            (
                values.ravel(),
                (columns * self.rows + rows).ravel(),
                np.arange(0, 16 * len(points) + 1, 16),
            ),
            shape=(len(points), self.columns * self.rows),
        )

    @property
    def bending(self) -> Rows:
        """Rows whose summed squares are the bending energy of a thin plate; 0 for affine maps."""
        number, weight = self._numbers, 1.0 / self.spacing
        return vstack(
            [
                self._differences([number[:-2], number[1:-1], number[2:]], [1.0, -2.0, 1.0], weight),
                self._differences([number[:, :-2], number[:, 1:-1], number[:, 2:]], [1.0, -2.0, 1.0], weight),
                self._differences(
                    [number[:-1, :-1], number[1:, :-1], number[:-1, 1:], number[1:, 1:]],
                    [1.0, -1.0, -1.0, 1.0],
                    math.sqrt(2.0) * weight,
                ),
            ]
        ).tocsr()

    @property
    def gradient(self) -> Rows:
        """Rows whose summed squares are the integral of the squared gradient."""
        number = self._numbers
        return vstack(
            [
                self._differences([number[:-1], number[1:]], [-1.0, 1.0], 1.0),
                self._differences([number[:, :-1], number[:, 1:]], [-1.0, 1.0], 1.0),
            ]
        ).tocsr()

    @property
    def _numbers(self) -> Any:  # noqa: ANN401  # whole numbers (columns, rows)
        return np.arange(self.columns * self.rows).reshape(self.columns, self.rows)

    def _differences(self, numbers: list[Any], factors: list[float], weight: float) -> Rows:
        count = numbers[0].size
        values = np.repeat(np.array(factors) * weight, count)
        places = np.concatenate([number.ravel() for number in numbers])
        return coo_matrix(
            (values, (np.tile(np.arange(count), len(factors)), places)),
            shape=(count, self.columns * self.rows),
        )


@dataclass(frozen=True, eq=False)
class ElasticMap:
    """A similarity, then a smooth change: from the drawing to metres."""

    rough: Similarity2  # from the drawing to roughly metres
    grid: SplineGrid  # over roughly metres
    coefficients: Array  # (k, 2) [m]

    def roughly(self, points: Array) -> Array:
        """Carry points (n, 2) by the similarity alone."""
        return self.rough @ points

    def from_roughly(self, points: Array) -> Array:
        """Carry points (n, 2) that are roughly in metres to where they are."""
        return np.asarray(self.grid.basis(points) @ self.coefficients)

    def __matmul__(self, points: Array) -> Array:
        """Carry points (n, 2) of the drawing to metres."""
        return self.from_roughly(self.roughly(points))

    @property
    def scale(self) -> float:
        """Drawing units in a metre, by the similarity."""
        return 1.0 / self.rough.scale
