"""How far the walls of a drawing are from the true ones, wall by wall, in metres."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.spatial import cKDTree

from pilotage.evaluation.warp import Warp
from pilotage.geometry import Array, fit_similarity
from pilotage.maps import SchematicMap

STEP = 0.25
"""Distance [m] between points along walls."""
SEEN = 0.5
"""A wall was seen where its true place is within this distance [m] of what the laser hit."""


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

    def hits_beside(self, corrected: Array) -> Array:
        """Carry the hits to the frame of corrected points (n, 2), by the best rigid motion, (m, 2) [m]."""
        return fit_similarity(corrected, self.in_world, rigid=True).inverse() @ self.hits

    def _error(self, points: Array, *, rigid: bool) -> float:
        moved = fit_similarity(points, self.in_world, rigid=rigid) @ points
        return float(np.hypot(*(moved - self.in_world).T).mean())

    def _gap(self, points: Array, *, rigid: bool) -> float:
        moved = fit_similarity(points, self.in_world, rigid=rigid) @ points
        return float(cKDTree(self.hits).query(moved)[0].mean())
