"""Where one goes from room to room on a plan, and what a person forgets, moves or draws shut there."""

from dataclasses import dataclass
from itertools import combinations

import shapely

from pilotage.evaluation.rooms import Rooms

LINE = int(shapely.GeometryType.LINESTRING)
BESIDE = 0.5
"""Distance [m] within which rooms are neighbors."""
ON_STROKE = 0.15
"""Distance [m] of a stroke within which a border is walled."""
NARROWEST = 0.4
"""Least width [m] of an opening."""
WIDEST_DOOR = 1.8
"""Greatest width [m] of a door; a wider opening is a passage."""


@dataclass(frozen=True, eq=False)
class Opening:
    """Where two rooms meet without a stroke between them."""

    rooms: tuple[int, int]
    line: shapely.LineString

    @property
    def is_door(self) -> bool:
        """Whether it is as narrow as a door."""
        return bool(self.line.length <= WIDEST_DOOR)

    @property
    def barrier(self) -> shapely.LineString:
        """The stroke that shuts it."""
        first, last = self.line.coords[0], self.line.coords[-1]
        return shapely.LineString([first, last]) if first != last else self.line


def border_of(rooms: Rooms, a: int, b: int) -> shapely.Geometry:
    """Return the part of the first room's outline that lies along the second."""
    return shapely.intersection(rooms.polygons[a].exterior, shapely.buffer(rooms.polygons[b], BESIDE))


def lines_in(geometry: shapely.Geometry) -> list[shapely.LineString]:
    """List the lines of a geometry, joined where they meet."""
    parts = shapely.get_parts(shapely.line_merge(shapely.MultiLineString(all_lines(geometry))))
    return list(parts)


def all_lines(geometry: shapely.Geometry) -> list[shapely.LineString]:
    """List the lines of a geometry as they are."""
    parts = shapely.get_parts(shapely.get_parts(geometry))
    return [part for part in parts if shapely.get_type_id(part) == LINE and part.length > 0.0]


def neighbors(rooms: Rooms) -> list[tuple[int, int]]:
    """List the pairs of rooms that lie side by side."""
    return [
        (a, b)
        for a, b in combinations(range(len(rooms.names)), 2)
        if shapely.dwithin(rooms.polygons[a], rooms.polygons[b], BESIDE)
    ]


def find_openings(rooms: Rooms, strokes: shapely.MultiLineString) -> list[Opening]:
    """Find all openings between rooms."""
    walled = shapely.buffer(strokes, ON_STROKE)
    return [
        Opening((a, b), line)
        for a, b in neighbors(rooms)
        for line in lines_in(shapely.difference(border_of(rooms, a, b), walled))
        if line.length >= NARROWEST
    ]


def walls_between(rooms: Rooms, strokes: shapely.MultiLineString, a: int, b: int) -> list[shapely.LineString]:
    """Find where a door could stand between two rooms: their walled border."""
    walled = shapely.buffer(strokes, 2.0 * ON_STROKE)
    return [
        line for line in lines_in(shapely.intersection(border_of(rooms, a, b), walled)) if line.length >= 2.0
    ]


def gap_at(line: shapely.LineString, share: float, width: float) -> shapely.Polygon:
    """Return what is cut out of all strokes for a door at a share of the way along a border."""
    middle = shapely.line_interpolate_point(line, 0.2 + 0.6 * share, normalized=True)
    return shapely.buffer(middle, width / 2.0)
