"""Find doors that are drawn as a gap in only one of the two lines between two rooms."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.geometry import Array, Polyline
from pilotage.interpretation.bars import LEVEL, NEAR, SIZES, Bar, goes_on
from pilotage.interpretation.paint import Seen, parts_of
from pilotage.interpretation.paper import FAINT, difference
from pilotage.interpretation.segments import Segments, segments_of
from pilotage.interpretation.sheet import Color, Sheet

APART = 0.6
"""The other line is at most so far away, as a share of the gap's width."""

ALIKE = 2
"""So many such gaps at least: one may be a slip of the pen."""


@dataclass(frozen=True, eq=False)
class Half:
    """A gap in one line, and the stretch of the other line behind it."""

    number: int  # of the mark that erases, in its sheet
    ends: Array  # (2, 2), of the gap
    behind: Array  # (2, 2), on the other line


def find_halves(
    sheet: Sheet, drawn: Sequence[int], seen: Sequence[Seen], ground: Color, diagonal: float
) -> list[Half]:
    """Find straight strokes in the color of the ground that erase a piece of a line, but not the one behind.

    Rooms that are drawn as boxes of their own have two lines between them; people erase the one they see.
    """
    erasing = []
    for number in drawn:
        mark = sheet.marks[number]
        if mark.pen is None or difference(mark.pen.color, ground) >= FAINT or len(mark.outlines) != 1:
            continue
        ends = mark.outlines[0].vertices
        length = float(np.hypot(*(ends[-1] - ends[0])))
        if len(ends) == 2 and SIZES[0] * diagonal <= length <= SIZES[1] * diagonal:
            erasing.append((number, Bar(-1, ends, mark.pen.width)))
    if len(erasing) < ALIKE:
        return []
    segments = segments_of(seen)
    gaps = [(number, bar) for number, bar in erasing if goes_on(bar, segments, diagonal)]
    halves = [
        Half(number, bar.ends, behind)
        for number, bar in gaps
        if (behind := line_behind(bar, segments, NEAR * diagonal)) is not None
    ]
    return halves if len(halves) >= ALIKE else []


def line_behind(bar: Bar, segments: Segments, near: float) -> Array | None:
    """Find the stretch of another line behind a gap; None if there is none, or one on both sides."""
    along = (bar.ends[1] - bar.ends[0]) / bar.length
    around = shapely.buffer(shapely.LineString(bar.ends), APART * bar.length, cap_style="flat")
    found = segments.tree.query(around, predicate="intersects")
    ends = segments.ends[found]
    turn = np.abs((ends[:, 1] - ends[:, 0]) @ bar.across)
    places = (ends - bar.ends[0]) @ along
    covers = (places.min(axis=1) <= 0.0) & (places.max(axis=1) >= bar.length)
    offsets = (ends.mean(axis=1) - bar.ends[0]) @ bar.across
    offsets = offsets[covers & (turn <= LEVEL * segments.lengths[found])]
    offsets = offsets[np.abs(offsets) > max(bar.width / 2.0, near)]
    if not len(offsets) or (offsets > 0.0).any() == (offsets < 0.0).any():
        return None
    return np.asarray(bar.ends + offsets[np.argmin(np.abs(offsets))] * bar.across)


def without_halves(seen: Sequence[Seen], halves: Sequence[Half], diagonal: float) -> list[Seen]:
    """Open the line behind each gap, and close the doorway to its sides; the marks of both lines stay."""
    left = list(seen)
    for half in halves:
        stretch = shapely.LineString(half.behind)
        cut = shapely.buffer(stretch, NEAR * diagonal, cap_style="flat")
        for place, mark in enumerate(left):
            if stretch.intersects(mark.line):
                jambs = shapely.linestrings(np.stack([half.ends, half.behind], axis=1))
                lines = [*parts_of(shapely.difference(mark.line, cut)), *jambs]
                left[place] = Seen(mark.number, shapely.multilinestrings(lines), mark.area, False)
    return left


def opened_halves(halves: Sequence[Half]) -> tuple[Polyline, ...]:
    """Return the openings between two lines, halfway."""
    return tuple(Polyline((half.ends + half.behind) / 2.0) for half in halves)
