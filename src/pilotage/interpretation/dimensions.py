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
    unnamed = [mark for mark in seen if mark.number not in named]
    signs = [
        (mark.number, extent, tip)
        for mark in unnamed
        if (extent := extent_of(sheet.marks[mark.number])) <= SIGN * diagonal
        for tip in tips_of(sheet.marks[mark.number])
    ]
    if not texts or not signs:
        return set()
    tree = shapely.STRtree(shapely.points([tip for *_, tip in signs]))
    written = shapely.STRtree(shapely.points([text.position for text in texts]))
    reach = BESIDE * max(height_of(text, diagonal) for text in texts)
    lines = [
        (mark.number, ends) for mark in unnamed if (ends := line_of(sheet.marks[mark.number])) is not None
    ]
    tips = shapely.points(np.array([ends for _, ends in lines]).reshape(-1, 2))
    near: dict[int, list[int]] = {}
    for tip, place in tree.query(tips, predicate="dwithin", distance=AT * diagonal).T.tolist():
        near.setdefault(tip, []).append(place)
    found: set[int] = set()
    for rank, (number, ends) in enumerate(lines):
        most = SHORT * float(np.hypot(*(ends[1] - ends[0])))
        marked = [
            [signs[place][0] for place in near.get(tip, []) if signs[place][1] <= most]
            for tip in (2 * rank, 2 * rank + 1)
        ]
        if not all(marked):
            continue
        beside = written.query(shapely.LineString(ends), predicate="dwithin", distance=reach)
        if any(stands_along(texts[place], ends, diagonal) for place in beside.tolist()):
            found |= {number, *marked[0], *marked[1]}
    return found


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


def line_of(mark: Mark) -> Array | None:
    """Return the ends of a mark that is one straight line, (2, 2); None if it is none."""
    if mark.pen is None or len(mark.outlines) != 1 or mark.outlines[0].closed:
        return None
    points = mark.outlines[0].vertices
    if len(points) < 2 or not (points[0] != points[-1]).any() or not is_straight(points):
        return None
    return np.asarray(points[[0, -1]])


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
