"""Find lines that are no walls: dashed openings from wall to wall, and axes that run through a building."""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Polyline
from pilotage.interpretation.paint import Seen, shapes_of
from pilotage.interpretation.sheet import Pen, Role, Sheet

MOSTLY = 0.5
"""Of a drawing of which a greater share is dashed, dashed lines are its walls."""

LONGEST = 0.3
"""Length of the widest opening, as a share of the drawing's diagonal; an axis is longer."""

NEAR = 0.005
"""Ends that come this near to another line lie on it, as a share of the drawing's diagonal."""

GRID = 3
"""So many lines of one pen at least are a grid."""

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
    """Find the marks that draw axes and sections: straight, dashed, and beyond all that they cross.

    So are the lines of a grid, which need no dashes.
    """
    dashed = dashed_among(sheet, seen)
    others = [mark for mark in seen if mark.number not in dashed]
    tree = shapely.STRtree(shapes_of(others).ravel())
    lines = straight_among(sheet, dashed)
    axes = {number for number, line in lines.items() if is_axis(line, tree, diagonal)}
    return axes | find_grid(sheet, others, diagonal)


def find_grid(sheet: Sheet, seen: Sequence[Seen], diagonal: float) -> set[int]:
    """Find straight lines in a pen of their own that all end outside of all else, with axes among them."""
    pens: dict[Pen | None, list[int]] = defaultdict(list)
    for mark in seen:
        pens[sheet.marks[mark.number].pen].append(mark.number)
    found: set[int] = set()
    for numbers in pens.values():
        lines = straight_among(sheet, numbers)
        if not GRID <= len(lines) == len(numbers):
            continue
        others = shapes_of([mark for mark in seen if mark.number not in lines]).ravel()
        tree = shapely.STRtree(others)
        axes = sum(is_axis(line, tree, diagonal) for line in lines.values())
        if axes >= GRID and are_outside(lines.values(), others, diagonal):
            found.update(numbers)
    return found


def straight_among(sheet: Sheet, numbers: Iterable[int]) -> dict[int, shapely.LineString]:
    """Return the marks that are one line between two points, each as it was drawn."""
    return {
        number: shapely.LineString(outlines[0].vertices)
        for number in numbers
        if len(outlines := sheet.marks[number].outlines) == 1 and len(outlines[0]) == 2
    }


def are_outside(lines: Iterable[shapely.LineString], others: NDArray[np.object_], diagonal: float) -> bool:
    """Tell whether all lines end outside of the box around all else."""
    box = shapely.buffer(shapely.box(*shapely.total_bounds(others)), NEAR * diagonal)
    return bool(shapely.disjoint(box, shapely.multipoints(shapely.get_coordinates(list(lines)))))


def is_axis(line: shapely.LineString, through: shapely.STRtree, diagonal: float) -> bool:
    """Tell whether a straight line is long, and goes beyond all that it crosses."""
    crossed = through.geometries[through.query(line, predicate="intersects")]
    if line.length <= LONGEST * diagonal or len(crossed) < 2:
        return False
    points = shapely.points(shapely.get_coordinates(shapely.intersection(line, crossed)))
    along = shapely.line_locate_point(line, points)
    beyond = min(along.min(), line.length - along.max())
    return bool(beyond > NEAR * diagonal and np.ptp(along) > MOSTLY * line.length)


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
