"""Tell by the pen which lines draw walls, and which rather furniture, thresholds or windows."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
import shapely

from pilotage.interpretation.names import guessed_role, is_room
from pilotage.interpretation.paint import Seen, parts_of
from pilotage.interpretation.paper import ROUNDING, bounds_of, holds
from pilotage.interpretation.sheet import Bounds, Mark, Pen, Role, Sheet, Text
from pilotage.interpretation.words import is_measure, role_of_words

COLORFUL = 0.45
"""A line is in a color if its channels differ by this much; ink in a photo is paler. It tells nothing where
most ink is in a color."""

THIN = (0.5, 1.0 / 3.0)
"""A line is thin if its pen is narrower than this share of the one that draws the middle of all ink.

Furniture is drawn so; also in a pen just this wide, if filled things have it. Inner walls may be drawn so,
too: where those in a thicker pen enclose too little, the second share tells. A hairline is not thin: files
have it where no width was chosen.
"""

SEVERAL = 3
"""So many filled things at least are furniture if their pen is narrower than usual, at all."""

MOST = 0.75
"""And if they are so many of all that it draws, as a share: over a bed may stand the name of its room."""

BESIDE = 0.005
"""A wall is drawn along the outline of a room if it comes this near, as a share of the drawing's diagonal."""

WALLED = 0.5
"""Where rooms have walls of their own, these run along more than this share of the outline of most rooms."""


def by_style(
    seen: Sequence[Seen],
    sheet: Sheet,
    named: Mapping[int, Role],
    solid: shapely.Geometry,
    diagonal: float,
    *,
    share: float,
) -> tuple[shapely.Geometry, shapely.Geometry, shapely.Geometry]:
    """Part lines in black or gray from dashed ones, and from those in a color or thin.

    What is named a wall or a window is neither in a color nor thin: it closes rooms. The third are outlines
    of things: such lines around a fill in which no place is named, and lines that are both dashed and thin.
    `share`, one of THIN, tells what is thin. The outline of what is named a room is its wall, where none is
    drawn beside it, not even a `solid` one.
    """
    usual = usual_pen(seen, sheet)
    thin = share * usual.width
    is_black = not is_colored(usual)
    places = [(*text.position, *text.position) for text in sheet.texts if names_place(text)]
    fine = fine_pens([sheet.marks[mark.number] for mark in seen], places, usual.width, thin)
    main: list[shapely.Geometry] = []
    marginal: list[shapely.Geometry] = []
    things: list[shapely.Geometry] = []
    rooms: list[shapely.Geometry] = []
    for mark in seen:
        pen = sheet.marks[mark.number].pen
        if pen is not None and not mark.line.is_empty:
            is_thin = 0.0 < pen.width < thin or pen in fine
            is_other = is_thin or (is_black and is_colored(pen))
            is_named = named.get(mark.number) in (Role.WALL, Role.WINDOW)
            is_marginal = pen.dashed or (is_other and not is_named)
            if not is_marginal:
                main.append(mark.line)
            elif is_room(sheet.marks[mark.number].names[-1:]):
                rooms.append(mark.line)
            elif (pen.dashed and is_thin and not is_named) or is_thing(sheet.marks[mark.number], places):
                things.append(mark.line)
            else:
                marginal.append(mark.line)
    (marginal if are_walled(rooms, [*main, solid], BESIDE * diagonal) else main).extend(rooms)
    black, other, around = (
        shapely.multilinestrings(parts_of(np.array(lines, dtype=object)))
        for lines in (main, marginal, things)
    )
    return black, other, around


def fine_pens(marks: Sequence[Mark], places: Sequence[Bounds], usual: float, thin: float) -> set[Pen | None]:
    """Find the pens of furniture: just thin, or narrower than usual and mostly of things."""
    things = Counter(mark.pen for mark in marks if is_thing(mark, places))
    drawn = Counter(mark.pen for mark in marks)
    return {
        pen
        for pen, count in things.items()
        if is_just(pen, thin)
        or (pen is not None and 0.0 < pen.width < usual and count >= max(SEVERAL, MOST * drawn[pen]))
    }


def is_just(pen: Pen | None, width: float) -> bool:
    """Tell whether a pen is just so wide; a hairline has no width."""
    return pen is not None and pen.width > 0.0 and math.isclose(pen.width, width, rel_tol=ROUNDING)


def is_thing(mark: Mark, places: Sequence[Bounds]) -> bool:
    """Tell whether a mark is painted, has a line all around it, and holds the name of none of the places.

    A dashed line goes around a part of a room, or a balcony.
    """
    is_around = mark.pen is not None and not mark.pen.dashed and all(line.closed for line in mark.outlines)
    if mark.fill is None or not is_around:
        return False
    bounds = bounds_of(mark)
    return not any(holds(bounds, place) for place in places)


def names_place(text: Text) -> bool:
    """Tell whether words name neither furniture nor a door, and are no length."""
    role = guessed_role([text.text])
    is_furniture = role is not None and role[0] is Role.FURNITURE
    return role_of_words(text.text)[0] is Role.LABEL and not (is_furniture or is_measure(text.text))


def are_walled(rooms: list[shapely.Geometry], walls: list[shapely.Geometry], reach: float) -> bool:
    """Tell whether walls run along the outlines of most rooms."""
    if not rooms:
        return False
    beside = shapely.union_all(shapely.buffer(parts_of(np.array(walls, dtype=object)), reach, quad_segs=2))
    shares = shapely.length(shapely.intersection(rooms, beside)) / shapely.length(rooms)
    return float(np.median(shares)) > WALLED


def is_colored(pen: Pen) -> bool:
    """Tell whether a pen draws in a color, neither black nor gray."""
    return max(pen.color) - min(pen.color) >= COLORFUL


def usual_pen(seen: Sequence[Seen], sheet: Sheet) -> Pen:
    """Find the pen that draws the middle of all ink, from the narrowest pen to the widest."""
    pens = [(pen, mark.line.length) for mark in seen if (pen := sheet.marks[mark.number].pen)]
    if not pens:
        return Pen()
    pens.sort(key=lambda drawn: drawn[0].width)
    ink = np.cumsum([pen.width * length for pen, length in pens])
    return pens[int(np.searchsorted(ink, ink[-1] / 2.0))][0]
