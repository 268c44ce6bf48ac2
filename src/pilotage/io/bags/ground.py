"""What a map of occupancy shows: floor and walls in metres of the frame `map`."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.correction import CorrectedDrawing
from pilotage.geometry import Array, Pose2
from pilotage.io.bags.belief import MapFrame
from pilotage.maps import CellGraph

GAP = 0.05
"""[m] Floors are grown by this, so that nothing unknown is left between them."""


@dataclass(frozen=True, eq=False)
class Ground:
    """Floor and walls."""

    floor: tuple[tuple[Array, tuple[Array, ...]], ...]  # outlines (n, 2) and their holes [m]
    walls: Array  # (n, 4) segments [m]
    thickness: float  # [m] of the walls; 0 is as thin as can be drawn
    bounds: tuple[float, float, float, float]  # left, bottom, right, top of the walls [m]

    @classmethod
    def drawn(cls, frame: MapFrame, graph: CellGraph | None) -> "Ground":
        """Take a drawing as it is drawn."""
        floor = tuple(
            (frame.from_sketch(cell.outline), tuple(frame.from_sketch(hole) for hole in cell.holes))
            for cell in (graph.cells if graph else ())
        )
        walls = frame.from_sketch(frame.sketch.segments.reshape(-1, 2)).reshape(-1, 4)
        left, bottom, right, top = (value / frame.scale for value in frame.sketch.bounds)
        return cls(floor, walls, 0.0, (left, bottom, right, top))

    @classmethod
    def corrected(cls, drawing: CorrectedDrawing, map_from_metres: Pose2) -> "Ground":
        """Take a corrected drawing."""
        grown = shapely.union_all([cell.buffer(GAP) for cell in drawing.floor])
        floor = tuple(
            (ring(part.exterior, map_from_metres), tuple(rings(part.interiors, map_from_metres)))
            for part in shapely.get_parts(grown)
        )
        walls = (map_from_metres @ drawing.sketch.segments.reshape(-1, 2)).reshape(-1, 4)
        ends = walls.reshape(-1, 2)
        (left, bottom), (right, top) = ends.min(axis=0).tolist(), ends.max(axis=0).tolist()
        return cls(floor, walls, drawing.wall_thickness, (left, bottom, right, top))


def ring(line: shapely.LinearRing, map_from_metres: Pose2) -> Array:
    """Carry a ring."""
    return np.asarray(map_from_metres @ shapely.get_coordinates(line))


def rings(lines: Iterable[shapely.LinearRing], map_from_metres: Pose2) -> list[Array]:
    """Carry rings."""
    return [ring(line, map_from_metres) for line in lines]
