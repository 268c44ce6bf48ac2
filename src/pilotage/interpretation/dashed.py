"""Find dashed lines that are no walls: openings from wall to wall, and axes that run through a building."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import shapely

from pilotage.geometry import Polyline
from pilotage.interpretation.paint import Seen, shapes_of
from pilotage.interpretation.sheet import Role, Sheet

MOSTLY = 0.5
"""Of a drawing of which a greater share is dashed, dashed lines are its walls."""

LONGEST = 0.3
"""Length of the widest opening, as a share of the drawing's diagonal; an axis is longer."""

NEAR = 0.005
"""Ends that come this near to another line lie on it, as a share of the drawing's diagonal."""

MOST_VERTICES = 4
"""An opening turns at a few corners; what has more vertices is a curve."""


def find_dashed(
    sheet: Sheet, seen: Sequence[Seen], guessed: Mapping[int, tuple[Role, str]], diagonal: float
) -> set[int]:
    """Find the marks that draw openings: thresholds, and edges of what is overhead.

    They are none if they are called walls.
    """
    dashed = dashed_among(sheet, seen)
    through = [mark.line for mark in seen if mark.number not in dashed]
    tree = shapely.STRtree(through)
    return {
        mark.number
        for mark in seen
        if mark.number in dashed
        and mark.area.is_empty
        and guessed.get(mark.number, (Role.FURNITURE, ""))[0] is not Role.WALL
        and all(is_opening(line, tree, diagonal) for line in sheet.marks[mark.number].outlines)
    }


def dashed_among(sheet: Sheet, seen: Sequence[Seen]) -> set[int]:
    """List the marks that have a dashed line; none if most lines are dashed."""
    lengths = {mark.number: mark.line.length for mark in seen}
    dashed = {number for number in lengths if (pen := sheet.marks[number].pen) and pen.dashed}
    return dashed if sum(lengths[number] for number in dashed) <= MOSTLY * sum(lengths.values()) else set()


def find_axes(sheet: Sheet, seen: Sequence[Seen], diagonal: float) -> set[int]:
    """Find the marks that draw axes and sections: straight, dashed, and beyond all that they cross."""
    dashed = dashed_among(sheet, seen)
    through = shapes_of([mark for mark in seen if mark.number not in dashed]).ravel()
    tree = shapely.STRtree(through)
    found = set()
    for mark in seen:
        outlines = sheet.marks[mark.number].outlines
        if mark.number not in dashed or len(outlines) != 1 or len(outlines[0]) != 2:
            continue
        line = shapely.LineString(outlines[0].vertices)
        crossed = through[tree.query(line, predicate="intersects")]
        if line.length <= LONGEST * diagonal or len(crossed) < 2:
            continue
        points = shapely.points(shapely.get_coordinates(shapely.intersection(line, crossed)))
        along = shapely.line_locate_point(line, points)
        beyond = min(along.min(), line.length - along.max())
        if beyond > NEAR * diagonal and np.ptp(along) > MOSTLY * line.length:
            found.add(mark.number)
    return found


def is_opening(line: Polyline, tree: shapely.STRtree, diagonal: float) -> bool:
    """Tell whether a line leads from wall to wall."""
    points = line.vertices
    if line.closed or len(points) > MOST_VERTICES:
        return False
    length = np.hypot(*np.diff(points, axis=0).T).sum()
    near = tree.query(shapely.points(points[[0, -1]]), predicate="dwithin", distance=NEAR * diagonal)
    return bool(2.0 * NEAR * diagonal < length <= LONGEST * diagonal and len(set(near[0])) == 2)


def opened_dashed(sheet: Sheet, numbers: Iterable[int]) -> tuple[Polyline, ...]:
    """Return the openings that marks draw, each straight."""
    return tuple(
        Polyline(pair)
        for number in numbers
        for line in sheet.marks[number].outlines
        for pair in np.stack([line.vertices[:-1], line.vertices[1:]], axis=1)
    )
