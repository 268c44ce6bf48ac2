"""The corrected drawing as a value."""

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.correction.spline import ElasticMap
from pilotage.correction.walls import Pieces
from pilotage.geometry import Array, Polyline, frozen_array
from pilotage.maps import SchematicMap

DETAIL = 0.02
"""[m] by which a line may be off that leaves out a vertex."""


class PassageState(Enum):
    """What was seen of a gateway."""

    OPEN = "open"  # beams or the robot went through
    CLOSED = "closed"  # a surface fills it
    UNSEEN = "unseen"


@dataclass(frozen=True, eq=False)
class Passage:
    """A gateway of the drawing, in metres."""

    gateway_id: str
    segment: Array  # (2, 2) from wall to wall [m]
    state: PassageState

    def __post_init__(self) -> None:
        """Freeze the segment."""
        object.__setattr__(self, "segment", frozen_array(self.segment))


@dataclass(frozen=True, eq=False)
class CorrectedDrawing:
    """A drawing as the robot found it, in metres, y up; it lies as on its sheet, the lower left at 0, 0."""

    sketch: SchematicMap  # the same strokes in the same order, and all marks [m]
    seen: tuple[Polyline, ...]  # stretches of strokes that the robot saw [m]
    unseen: tuple[Polyline, ...]  # the other stretches: they follow their neighbors
    passages: tuple[Passage, ...]  # the gateways of the drawing
    floor: tuple[shapely.Geometry, ...]  # its cells [m]; one that was bent through itself has several parts
    path: Array  # (n, 3) poses of the robot [m, m, rad]
    metres_from_sketch: ElasticMap
    wall_thickness: float  # [m] found for walls drawn as one stroke

    @property
    def scale(self) -> float:
        """Drawing units in a metre, on average."""
        return self.metres_from_sketch.scale

    @property
    def seen_share(self) -> float:
        """Share of the length of all strokes that was seen, 0 to 1."""
        seen, unseen = (sum(line.length for line in lines) for lines in (self.seen, self.unseen))
        return seen / max(seen + unseen, 1e-9)


def carried_sketch(sketch: SchematicMap, elastic: ElasticMap) -> SchematicMap:
    """Carry a drawing to metres with all that is marked on it."""

    def point(place: tuple[float, float]) -> tuple[float, float]:
        x, y = (elastic @ np.array([place]))[0].tolist()
        return x, y

    carried = sketch.carried(lambda line: carried_line(line, elastic), point)
    return replace(carried, metres_per_unit=1.0, y_down=False, photo_from_sketch=None)


def carried_line(line: Polyline, elastic: ElasticMap) -> Polyline:
    """Carry a polyline, bent where the map bends it."""
    pieces = pieces_of(line, elastic)
    vertices = elastic.from_roughly(pieces.starts if line.closed else vertices_of(pieces, 0, len(pieces)))
    return Polyline(simplified(vertices), line.closed)


def carried_polygon(polygon: shapely.Polygon, elastic: ElasticMap) -> shapely.Geometry:
    """Carry a polygon with its holes."""
    shell, *holes = (
        carried_line(Polyline(shapely.get_coordinates(ring)[:-1], closed=True), elastic).ring
        for ring in (polygon.exterior, *polygon.interiors)
    )
    return shapely.make_valid(shapely.Polygon(shell, holes))


def split_by_sight(
    line: Polyline, seen: NDArray[np.bool_], elastic: ElasticMap
) -> tuple[list[Polyline], list[Polyline]]:
    """Split a polyline into the stretches that were seen and the others, given that of each piece."""
    pieces = pieces_of(line, elastic)
    ends = [*(np.flatnonzero(np.diff(seen)) + 1).tolist(), len(pieces)]
    seen_lines: list[Polyline] = []
    unseen_lines: list[Polyline] = []
    for first, last in zip([0, *ends[:-1]], ends, strict=True):
        vertices = elastic.from_roughly(vertices_of(pieces, first, last))
        (seen_lines if seen[first] else unseen_lines).append(Polyline(simplified(vertices)))
    return seen_lines, unseen_lines


def pieces_of(line: Polyline, elastic: ElasticMap) -> Pieces:
    """Cut a polyline of the drawing into short pieces."""
    ring = elastic.roughly(line.ring)
    return Pieces.of(np.hstack([ring[:-1], ring[1:]]))


def vertices_of(pieces: Pieces, first: int, last: int) -> Array:
    """Return the vertices along pieces first .. last - 1 of one polyline."""
    return np.vstack([pieces.starts[first:last], pieces.ends[last - 1 : last]])


def simplified(vertices: Array) -> Array:
    """Leave out vertices (n, 2) on nearly straight lines; the first and the last stay."""
    if len(vertices) < 4:
        return vertices
    return np.asarray(shapely.get_coordinates(shapely.simplify(shapely.linestrings(vertices), DETAIL)))
