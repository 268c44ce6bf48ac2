"""Move drawings of surveys to the origin: far from it, coordinates have too few digits for what touches."""

from dataclasses import replace

import numpy as np

from pilotage.geometry import Array, Polyline
from pilotage.interpretation.sheet import Sheet
from pilotage.maps import SchematicMap

FAR = 100.0
"""A drawing is far from the origin if it is so many times its own size away: pages and sheets never are."""


def origin_of(sheet: Sheet) -> Array:
    """Return the point (2,) that is best taken for the origin: zero, unless the drawing is far from it."""
    outlines = [outline.vertices for mark in sheet.marks for outline in mark.outlines]
    if not outlines or sheet.photo_from_sheet is not None:
        return np.zeros(2)
    points = np.concatenate(outlines)
    corner, size = np.floor(points.min(axis=0)), float(np.hypot(*np.ptp(points, axis=0)))
    return corner if np.abs(corner).max() > FAR * size else np.zeros(2)


def moved_sheet(sheet: Sheet, shift: Array) -> Sheet:
    """Move all that stands on a sheet by a step (2,) [drawing units]."""
    return replace(
        sheet,
        marks=tuple(replace(mark, outlines=moved_lines(mark.outlines, shift)) for mark in sheet.marks),
        texts=tuple(replace(text, position=moved_point(text.position, shift)) for text in sheet.texts),
        page=None if sheet.page is None else tuple((np.array(sheet.page) + np.tile(shift, 2)).tolist()),
        openings=moved_lines(sheet.openings, shift),
        unread=tuple(moved_point(point, shift) for point in sheet.unread),
    )


def moved_sketch(sketch: SchematicMap, shift: Array) -> SchematicMap:
    """Move all that is drawn in a sketch by a step (2,) [drawing units]."""
    return sketch.carried(lambda line: moved_line(line, shift), lambda point: moved_point(point, shift))


def moved_lines(lines: tuple[Polyline, ...], shift: Array) -> tuple[Polyline, ...]:
    """Move lines."""
    return tuple(moved_line(line, shift) for line in lines)


def moved_line(line: Polyline, shift: Array) -> Polyline:
    """Move a line."""
    return Polyline(line.vertices + shift, line.closed)


def moved_point(point: tuple[float, float], shift: Array) -> tuple[float, float]:
    """Move a point."""
    return point[0] + float(shift[0]), point[1] + float(shift[1])
