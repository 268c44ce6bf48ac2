"""Find dimension lines: a number stands along them, and a sign at each of their ends.

Outside of a building two ticks are enough.
"""

import math
import re
from collections import Counter, defaultdict
from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.interpretation.leaves import is_straight
from pilotage.interpretation.paint import Seen
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

THIN = 0.5
"""A line without signs at its ends is no wall if its pen has at most this share of the width of the heaviest
and a length with its unit stands before its middle: lengths are also written along walls."""

AMID = 0.03
"""So far from the middle of the line at most, as a share of its length."""

NUMBER = re.compile(r"[≈~]?\d+(?:[.,]\d+)?\*?")


@dataclass(frozen=True, eq=False)
class Outline:
    """An outline of a mark that may be a dimension line, or a sign at its end."""

    mark: int  # number of its mark
    place: int  # among the outlines of its mark
    vertices: Array  # (n, 2)
    pen: float  # width of its line; 0 without one

    @property
    def key(self) -> tuple[int, int]:
        """Tell it from all others."""
        return self.mark, self.place


def find_dimensions(
    sheet: Sheet, seen: Sequence[Seen], named: Container[int], lettering: Sequence[Text], diagonal: float
) -> tuple[set[int], set[int]]:
    """Find the marks without a name that are dimension lines, with the signs at their ends, and their texts.

    Both by number. A mark may hold several: both arrowheads of a line, or the line with its ticks.
    `lettering` is what is written in outlines: it may be a number.
    """
    numbers = [
        number
        for number, text in enumerate(sheet.texts)
        if NUMBER.fullmatch(text.text.strip()) or is_measure(text.text)
    ]
    texts = [*(sheet.texts[number] for number in numbers), *lettering]
    outlines = [
        outline
        for mark in seen
        if mark.number not in named
        for outline in outlines_of(mark.number, sheet.marks[mark.number])
    ]
    found, written = spans_with_number(outlines, texts, diagonal) if texts else (set(), set())
    counts = Counter(number for number, _ in found | spans_outside(outlines, diagonal))
    marks = {number for number, count in counts.items() if count == len(sheet.marks[number].outlines)}
    return marks, {numbers[place] for place in written if place < len(numbers)}


def spans_outside(outlines: Sequence[Outline], diagonal: float) -> set[tuple[int, int]]:
    """List the lines with a tick across both ends that lie outside of all else, and the ticks."""
    lines = [line for line in outlines if line.pen > 0.0 and len(line.vertices) == 2]
    if not lines:
        return set()
    ends = np.array([line.vertices for line in lines])
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    tree = shapely.STRtree(shapely.points(ends.mean(axis=1)))
    which, near = tree.query(shapely.points(ends.reshape(-1, 2)), predicate="dwithin", distance=AT * diagonal)
    short = lengths[near] <= np.minimum(SHORT * lengths[which // 2], SIGN * diagonal)
    ticks: defaultdict[int, dict[int, int]] = defaultdict(dict)
    for end, tick in zip(which[short].tolist(), near[short].tolist(), strict=True):
        ticks[end // 2][end % 2] = tick
    spans = {line: [line, *signs.values()] for line, signs in ticks.items() if len(signs) == 2}
    parts = {lines[place].key for span in spans.values() for place in span}
    rest = np.concatenate([line.vertices for line in outlines if line.key not in parts] or [np.empty((0, 2))])
    if not (spans and len(rest)):
        return set()
    low, high = rest.min(axis=0), rest.max(axis=0)
    beyond = ((ends.max(axis=1) < low) | (ends.min(axis=1) > high)).any(axis=1)
    return {lines[place].key for line, span in spans.items() if beyond[line] for place in span}


def spans_with_number(
    outlines: Sequence[Outline], texts: Sequence[Text], diagonal: float
) -> tuple[set[tuple[int, int]], set[int]]:
    """List the lines with a number beside them and a sign at each end, and these signs; then the numbers."""
    lines = measured_lines(outlines, texts, diagonal)
    if not lines:
        return set(), set()
    tips, owners = tips_of(outlines)
    tree = shapely.STRtree(shapely.points(tips))
    heavy = max(outline.pen for outline in outlines)
    found: set[tuple[int, int]] = set()
    written: set[int] = set()
    for line, along in lines:
        text = texts[along[0]]
        ends = line.vertices[[0, -1]]
        most = min(SHORT * float(np.hypot(*(ends[1] - ends[0]))), SIGN * diagonal)
        which, near = tree.query(shapely.points(ends), predicate="dwithin", distance=AT * diagonal)
        signs = [
            (end, outlines[place].key)
            for end, place in zip(which.tolist(), owners[near].tolist(), strict=True)
            if np.ptp(outlines[place].vertices, axis=0).max() <= most
        ]
        if {end for end, _ in signs} == {0, 1}:
            found |= {line.key, *(sign for _, sign in signs)}
            written.update(along)
        elif text.text and line.pen <= THIN * heavy and is_measure(text.text) and stands_amid(text, ends):
            found.add(line.key)
    return found, written


def outlines_of(number: int, mark: Mark) -> Iterator[Outline]:
    """List the outlines of a mark."""
    for place, line in enumerate(mark.outlines):
        yield Outline(number, place, line.vertices, 0.0 if mark.pen is None else mark.pen.width)


def measured_lines(
    outlines: Sequence[Outline], texts: Sequence[Text], diagonal: float
) -> list[tuple[Outline, list[int]]]:
    """List the straight lines along which some of these numbers stand, each with their places."""
    lines = [one for one in outlines if one.pen > 0.0 and (one.vertices[0] != one.vertices[-1]).any()]
    if not lines:
        return []
    written = shapely.STRtree(shapely.points([text.position for text in texts]))
    reach = BESIDE * max(height_of(text, diagonal) for text in texts)
    drawn = shapely.linestrings(np.array([line.vertices[[0, -1]] for line in lines]))
    beside = written.query(drawn, predicate="dwithin", distance=reach).T.tolist()
    along: defaultdict[int, list[int]] = defaultdict(list)
    for rank, place in sorted(beside):
        if stands_along(texts[place], lines[rank].vertices[[0, -1]], diagonal):
            along[rank].append(place)
    return [(lines[rank], places) for rank, places in along.items() if is_straight(lines[rank].vertices)]


def tips_of(outlines: Sequence[Outline]) -> tuple[Array, NDArray[np.int64]]:
    """List where outlines can end a line, (n, 2), and the place of each, (n,).

    It is amid a tick, and at the corners of an arrowhead. The jamb of a door begins where the face of its
    wall ends, and a column has four corners.
    """
    ticks = [place for place, outline in enumerate(outlines) if len(outline.vertices) == 2]
    middles = np.array([outlines[place].vertices for place in ticks]).reshape(-1, 2, 2).mean(axis=1)
    heads = [(place, corners) for place, one in enumerate(outlines) if len(corners := corners_of(one)) == 3]
    corners = np.array([corners for _, corners in heads]).reshape(-1, 2)
    owners = np.array([*ticks, *np.repeat([place for place, _ in heads], 3)], dtype=np.int64)
    return np.concatenate([middles, corners]), owners


def corners_of(outline: Outline) -> Array:
    """Return the vertices of an outline; the first may be written again."""
    points = outline.vertices
    closes = len(points) == 4 and not (points[0] != points[-1]).any()
    return points[:-1] if closes else points


def stands_amid(text: Text, ends: Array) -> bool:
    """Tell whether words stand before the middle of a line (2, 2)."""
    along = ends[1] - ends[0]
    return bool(abs((np.array(text.position) - ends.mean(axis=0)) @ along) <= AMID * (along @ along))


def stands_along(text: Text, ends: Array, diagonal: float) -> bool:
    """Tell whether words stand beside a line (2, 2), between its ends, and may read along it."""
    length = float(np.hypot(*(ends[1] - ends[0])))
    along = (ends[1] - ends[0]) / length
    step = np.array(text.position) - ends[0]
    aside = abs(along[0] * step[1] - along[1] * step[0])
    turn = abs(along[0] * math.sin(text.angle) - along[1] * math.cos(text.angle))
    is_near = aside <= BESIDE * height_of(text, diagonal)
    return bool(0.0 < step @ along < length and is_near and not turn > TURNED)


def height_of(text: Text, diagonal: float) -> float:
    """Return the height of words, a usual one if the file does not tell it."""
    return text.height or HEIGHT * diagonal
