"""Find outlines that tell how large rooms are, drawn along walls and across their doors."""

from collections.abc import Mapping

import numpy as np
import shapely

from pilotage.interpretation.names import SPACES, name_words
from pilotage.interpretation.sheet import Role, Sheet

AREAS = SPACES | {
    "area",
    "areas",
    "zone",
    "zones",
    "zonen",
    "space",
    "spaces",
    "fläche",
    "flächen",
    "flaechen",
}
"""Words for layers of rooms and their areas."""

BESIDE = 0.02
"""An outline follows a wall if it is this near to it, as a share of the drawing's diagonal."""

FOLLOWING = 0.8
"""Walls are drawn on their own if so much of all outlines follows one, as a share of their length; else the
outlines are walls."""

STEPS = 200
"""Outlines are looked at in so many steps a diagonal."""


def find_areas(sheet: Sheet, called: Mapping[int, tuple[Role, str] | None], diagonal: float) -> set[int]:
    """Find closed lines on layers of rooms or areas, where walls are drawn on a layer of their own."""
    walls = [number for number, role in called.items() if role is not None and role[0] is Role.WALL]
    areas = [number for number, role in called.items() if role is None and is_area(sheet, number)]
    if not walls or not areas or diagonal == 0.0:
        return set()
    lines = [shapely.LineString(line.vertices) for number in walls for line in sheet.marks[number].outlines]
    rings = [shapely.LinearRing(line.vertices) for number in areas for line in sheet.marks[number].outlines]
    points = shapely.points(shapely.get_coordinates(shapely.segmentize(rings, diagonal / STEPS)))
    near, _ = shapely.STRtree(lines).query(points, predicate="dwithin", distance=BESIDE * diagonal)
    return set(areas) if len(np.unique(near)) >= FOLLOWING * len(points) else set()


def is_area(sheet: Sheet, number: int) -> bool:
    """Tell whether a mark is a closed line with a name for rooms."""
    mark = sheet.marks[number]
    is_closed = all(line.closed and len(line) > 2 for line in mark.outlines)
    return is_closed and any(not AREAS.isdisjoint(name_words(name)) for name in mark.names)
