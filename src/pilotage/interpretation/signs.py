"""Find signs that stand in rooms: discs in a color of their own, and compasses."""

import math
from collections.abc import Sequence
from collections.abc import Set as AbstractSet

import numpy as np

from pilotage.interpretation.paint import Seen
from pilotage.interpretation.paper import SAME, area_of, bounds_of, difference, holds
from pilotage.interpretation.sheet import Bounds, Color, Mark, Sheet

LARGEST = 0.1
"""No sign is wider than this share of the drawing's diagonal: a round hall is."""

ROUND = 0.97
"""Area of a circle as drawn, as a share of that of a true one as long: one of twelve chords has 0.977."""

SHORT = 2
"""What points at something from a disc has at most so many letters or digits."""

MORE = 2
"""So many times as many words name places beside such numbers."""

NORTHS = frozenset(("N", "\N{CYRILLIC CAPITAL LETTER ES}", "北", "북"))
"""How a compass marks the north."""


def find_signs(sheet: Sheet, seen: Sequence[Seen], diagonal: float) -> tuple[set[int], set[int]]:
    """Find the marks that are signs, and the texts in them, by number.

    Lamps, sensors and pins are discs in a color that nothing else has; a compass is a circle around the
    letter of the north, or with it beside, maybe with those of other points.
    """
    small = {mark.number for mark in seen if is_circle(sheet.marks[mark.number], LARGEST * diagonal)}
    others = {
        color for mark in seen if mark.number not in small for color in colors_of(sheet.marks[mark.number])
    }
    discs = {
        number
        for number in small
        if (fill := sheet.marks[number].fill) is not None
        and all(difference(fill, color) >= SAME for color in others)
    }
    norths = [text for text in sheet.texts if text.text.strip() in NORTHS]
    boxes = [around(bounds_of(sheet.marks[number])) for number in sorted(small)]
    compasses = [box for box in boxes if any(holds(box, (*text.position, *text.position)) for text in norths)]
    parts = {
        mark.number
        for mark in seen
        if any(holds(box, bounds_of(sheet.marks[mark.number])) for box in compasses)
    }
    texts = {
        number
        for number, text in enumerate(sheet.texts)
        if len(text.text.strip()) == 1
        and any(holds(box, (*text.position, *text.position)) for box in compasses)
    }
    return discs | parts, texts | numbers_of(sheet, discs)


def numbers_of(sheet: Sheet, discs: AbstractSet[int]) -> set[int]:
    """Find the numbers and letters in discs, where many more words name places: they point at something.

    Where few words are written, such numbers name the rooms.
    """
    boxes = [bounds_of(sheet.marks[number]) for number in sorted(discs)]
    found = {
        number
        for number, text in enumerate(sheet.texts)
        if len(text.text.strip()) <= SHORT and any(holds(box, (*text.position,) * 2) for box in boxes)
    }
    words = [text for text in sheet.texts if sum(map(str.isalpha, text.text)) > SHORT]
    return found if len(words) >= MORE * len(found) else set()


def around(box: Bounds) -> Bounds:
    """Return a box with a margin of half its own width.

    >>> around((0.0, 0.0, 2.0, 2.0))
    (-1.0, -1.0, 3.0, 3.0)
    """
    left, bottom, right, top = box
    margin = (right - left) / 2.0
    return left - margin, bottom - margin, right + margin, top + margin


def is_circle(mark: Mark, largest: float) -> bool:
    """Tell whether a mark is one circle that is no wider than this [drawing units]."""
    if len(mark.outlines) != 1 or not mark.outlines[0].closed:
        return False
    outline = mark.outlines[0]
    width = float(np.ptp(outline.vertices, axis=0).max())
    return bool(0.0 < width <= largest and 4.0 * math.pi * area_of(outline) >= ROUND * outline.length**2)


def colors_of(mark: Mark) -> list[Color]:
    """List the colors of a mark's line and area."""
    return [color for color in (mark.pen.color if mark.pen else None, mark.fill) if color is not None]
