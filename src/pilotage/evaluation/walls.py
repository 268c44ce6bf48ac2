"""How far the walls of a drawing are from the true ones, wall by wall, in metres."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.spatial import cKDTree

from pilotage.evaluation.warp import Warp
from pilotage.geometry import Array
from pilotage.maps import SchematicMap

STEP = 0.25
"""[m] between points along walls."""
SEEN = 0.5
"""[m] A wall was seen where its true place is no farther from what the laser hit."""


@dataclass(frozen=True, eq=False)
class TrueWalls:
    """Points along the drawn walls that a robot saw, and where each of them truly is."""

    in_sketch: Array  # (n, 2) [drawing units]
    in_world: Array  # (n, 2) [m]
    hits: Array  # (m, 2) what the laser hit, anywhere [m]

    @classmethod
    def of(cls, sketch: SchematicMap, warp: Warp, hits: Array) -> Self:
        """Sample walls evenly, and keep the points whose true place is near a hit."""
        places = []
        for segment in sketch.segments:
            ends = segment.reshape(2, 2)
            length = float(np.hypot(*np.diff(warp.world_from_sketch(ends), axis=0)[0]))
            shares = (np.arange(max(round(length / STEP), 1)) + 0.5) / max(round(length / STEP), 1)
            places.append(ends[0] + shares[:, np.newaxis] * (ends[1] - ends[0]))
        in_sketch = np.vstack(places)
        in_world = warp.world_from_sketch(in_sketch)
        seen = cKDTree(hits).query(in_world)[0] <= SEEN
        return cls(in_sketch[seen], in_world[seen], hits)

    def error_of_drawing(self) -> float:
        """Mean distance of the drawing's walls from their true places, after the best similarity [m]."""
        return self._error(self.in_sketch, rigid=False)

    def error_of(self, corrected: Array) -> float:
        """Mean distance of the same points, corrected (n, 2), after the best rigid motion [m]."""
        return self._error(corrected, rigid=True)

    def gap_of_drawing(self) -> float:
        """Mean distance of the drawing's walls from the nearest hit, after the best similarity [m]."""
        return self._gap(self.in_sketch, rigid=False)

    def gap_of(self, corrected: Array) -> float:
        """Mean distance of the same points, corrected (n, 2), from the nearest hit [m]."""
        return self._gap(corrected, rigid=True)

    def _error(self, points: Array, *, rigid: bool) -> float:
        return float(np.hypot(*(aligned(points, self.in_world, rigid=rigid) - self.in_world).T).mean())

    def _gap(self, points: Array, *, rigid: bool) -> float:
        return float(cKDTree(self.hits).query(aligned(points, self.in_world, rigid=rigid))[0].mean())


def aligned(points: Array, images: Array, *, rigid: bool) -> Array:
    """Move points (n, 2) to their images by the similarity of least squares; a rigid one keeps their scale.

    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> float(np.abs(aligned(square, 2.0 * square + 5.0, rigid=False) - 2.0 * square - 5.0).max().round(9))
    0.0
    """
    a, b = points @ np.array([1.0, 1j]), images @ np.array([1.0, 1j])
    a, middle = a - a.mean(), b.mean()
    factor = (a.conj() @ (b - middle)) / (a.conj() @ a).real
    moved = a * (factor / abs(factor) if rigid else factor) + middle
    return np.column_stack([moved.real, moved.imag])
