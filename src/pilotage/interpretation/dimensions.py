"""Find dimension lines: a number stands along them, and a sign at each of their ends."""

import math
import re
from collections.abc import Container, Sequence

import numpy as np
import shapely

from pilotage.geometry import Array
from pilotage.interpretation.leaves import is_straight
from pilotage.interpretation.paint import Seen
from pilotage.interpretation.paper import bounds_of
from pilotage.interpretation.sheet import Mark, Sheet, Text
from pilotage.interpretation.words import is_measure

SIGN = 0.03
"""Ticks and arrowheads are no larger than this share of the drawing's diagonal."""

SHORT = 0.25
"""Nor than this share of their line."""

AT = 0.002
"""They come as near to its end as this share of the drawing's diagonal."""

BESIDE = 2.0
"""A number stands no farther from its line than so many of its heights."""

HEIGHT = 0.01
"""Height of a number, if the file does not tell, as a share of the drawing's diagonal."""

TURNED = math.sin(math.radians(5.0))
"""It reads along the line, within this angle."""

NUMBER = re.compile(r"\d+(?:[.,]\d+)?")


def find_dimensions(sheet: Sheet, seen: Sequence[Seen], named: Container[int], diagonal: float) -> set[int]:
    """Find the marks without a name, by number, that are dimension lines, and the signs at their ends."""
    texts = [text for text in sheet.texts if NUMBER.fullmatch(text.text.strip()) or is_measure(text.text)]
    if not texts:
        return set()
    unnamed = [mark for mark in seen if mark.number not in named]
    signs = [
        (mark.number, extent, tip)
        for mark in unnamed
        if (extent := extent_of(sheet.marks[mark.number])) <= SIGN * diagonal
        for tip in tips_of(sheet.marks[mark.number])
    ]
    lines = measured_lines(sheet, unnamed, texts, diagonal)
    if not signs or not lines:
        return set()
    tree = shapely.STRtree(shapely.points([tip for *_, tip in signs]))
    found: set[int] = set()
    for number, ends in lines:
        most = SHORT * float(np.hypot(*(ends[1] - ends[0])))
        near = tree.query(shapely.points(ends), predicate="dwithin", distance=AT * diagonal).T.tolist()
        small = [(end, signs[place][0]) for end, place in near if signs[place][1] <= most]
        if {end for end, _ in small} == {0, 1}:
            found |= {number, *(sign for _, sign in small)}
    return found


def measured_lines(
    sheet: Sheet, marks: Sequence[Seen], texts: Sequence[Text], diagonal: float
) -> list[tuple[int, Array]]:
    """List the straight lines along which one of these numbers stands: mark and ends (2, 2) of each."""
    lines = [(mark.number, ends) for mark in marks if (ends := ends_of(sheet.marks[mark.number])) is not None]
    if not lines:
        return []
    written = shapely.STRtree(shapely.points([text.position for text in texts]))
    reach = BESIDE * max(height_of(text, diagonal) for text in texts)
    drawn = shapely.linestrings(np.array([ends for _, ends in lines]))
    beside = written.query(drawn, predicate="dwithin", distance=reach).T.tolist()
    along = {rank for rank, place in beside if stands_along(texts[place], lines[rank][1], diagonal)}
    return [
        lines[rank] for rank in sorted(along) if is_straight(sheet.marks[lines[rank][0]].outlines[0].vertices)
    ]


def extent_of(mark: Mark) -> float:
    """Return the longer side of a mark's bounds."""
    left, bottom, right, top = bounds_of(mark)
    return max(right - left, top - bottom)


def tips_of(mark: Mark) -> list[Array]:
    """List where a small mark can end a dimension line: the middle of a tick, the corners of an arrowhead.

    The jamb of a door begins where the face of its wall ends, and a column has four corners.
    """
    if len(mark.outlines) != 1:
        return []
    points = mark.outlines[0].vertices
    if len(points) > 3 and not (points[0] != points[-1]).any():
        points = points[:-1]
    if len(points) == 2:
        return [points.mean(axis=0)]
    return list(points) if len(points) == 3 else []


def ends_of(mark: Mark) -> Array | None:
    """Return the ends of a mark that is one open line, (2, 2); None if it is none."""
    if mark.pen is None or len(mark.outlines) != 1 or mark.outlines[0].closed:
        return None
    points = mark.outlines[0].vertices
    return points[[0, -1]] if (points[0] != points[-1]).any() else None


def stands_along(text: Text, ends: Array, diagonal: float) -> bool:
    """Tell whether words stand beside a line (2, 2), between its ends, and read along it."""
    length = float(np.hypot(*(ends[1] - ends[0])))
    along = (ends[1] - ends[0]) / length
    step = np.array(text.position) - ends[0]
    aside = abs(along[0] * step[1] - along[1] * step[0])
    turn = abs(along[0] * math.sin(text.angle) - along[1] * math.cos(text.angle))
    is_near = aside <= BESIDE * height_of(text, diagonal)
    return bool(0.0 < step @ along < length and is_near and turn <= TURNED)


def height_of(text: Text, diagonal: float) -> float:
    """Return the height of words, a usual one if the file does not tell it."""
    return text.height or HEIGHT * diagonal
