"""Find rooms that are told by their paint alone: pale fills without a line, where no walls are drawn."""

from dataclasses import replace

import numpy as np
import shapely

from pilotage.interpretation.floors import is_floor
from pilotage.interpretation.paint import Seen, shapes_of
from pilotage.interpretation.sheet import BLACK, Pen, Role, Sheet
from pilotage.interpretation.view import View

FEW = 3
"""Fewer fills with words are signs or furniture."""

MOST = 0.5
"""More than this share of all words stand in them; else they are a legend beside the plan."""

COVERING = 0.3
"""They fill at least this share of their hull; words on desks and cupboards are farther apart."""

WALLED = 0.5
"""Where walls are drawn, they run along more than this share of the outline of most floors."""

BESIDE = 0.01
"""A wall is drawn along an outline if it comes this near, as a share of the drawing's diagonal."""


def find_painted_rooms(view: View) -> list[int]:
    """List the fills that are rooms and floors of a drawing without walls; none if it has walls.

    They are if nothing else is drawn, or if most words stand in them and no walls run along these.
    """
    fills = [mark for mark in view.visible if is_pale_fill(view, mark)]
    own = {mark.number for mark in fills}
    others = [mark for mark in view.visible if mark.number not in own]
    if not others:
        return sorted(own)
    written = [*view.sheet.texts, *view.lettering]
    if len(fills) < FEW or not written:
        return []
    words = shapely.points([text.position for text in written])
    areas = np.array([mark.area for mark in fills], dtype=object)
    inside, around = shapely.STRtree(areas).query(words, predicate="within")
    named = areas[np.unique(around)]
    if len(named) < FEW or len(np.unique(inside)) <= MOST * len(words):
        return []
    if shapely.area(named).sum() < COVERING * shapely.convex_hull(shapely.union_all(named)).area:
        return []
    beside = shapely.buffer(shapes_of(others).ravel(), BESIDE * view.diagonal, quad_segs=2)
    walls = shapely.union_all(beside)  # a buffer of the union would take far longer
    outlines = shapely.boundary(named)
    walled = shapely.length(shapely.intersection(outlines, walls)) / shapely.length(outlines)
    return sorted(own) if float(np.median(walled)) < WALLED else []


def is_pale_fill(view: View, mark: Seen) -> bool:
    """Tell whether a mark is a fill in the color of floors, without a line and without a role."""
    drawn = view.sheet.marks[mark.number]
    return (
        drawn.fill is not None
        and not mark.area.is_empty
        and mark.line.is_empty
        and is_floor(drawn.fill, view.paper.ground)
        and view.role(mark) is Role.WALL
    )


def outlined(sheet: Sheet, numbers: list[int]) -> Sheet:
    """Draw a line around some marks of a sheet."""
    chosen = set(numbers)
    marks = (
        replace(mark, pen=Pen(BLACK)) if number in chosen else mark for number, mark in enumerate(sheet.marks)
    )
    return replace(sheet, marks=tuple(marks))
