"""Find lines that are drawn upon a patch: a wider stroke in the color of the ground that erases a wall."""

from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.geometry import Array, Polyline
from pilotage.interpretation.bars import LEVEL, NEAR, SIZES, SLENDER, Bar, goes_on
from pilotage.interpretation.paint import Seen, parts_of
from pilotage.interpretation.paper import FAINT, bounds_of, difference, is_box
from pilotage.interpretation.segments import Segments, segments_of
from pilotage.interpretation.sheet import Color, Mark, Sheet

WIDER = 2.0
"""A patch is at least so many times as wide as the line upon it; else it is the light edge of the line."""

BESIDE = 1.6
"""What a patch that is named a door opens reaches so many of its widths from its middle: through a second
wall as thick, and a line around it."""

LEAST = 0.015
"""A doorway between two boxes is opened at least so wide, as a share of the drawing's diagonal: a gap of less
may be a slip of the pen, a patch is none."""


CORNERS = 5
"""Corners of a box, the first once more."""


@dataclass(frozen=True, eq=False)
class Bridge:
    """A doorway from one box to the next: a patch and a line along it draw it, or a box that is called so."""

    number: int  # of the line or the box, in its sheet
    ends: Array  # (2, 2), where it leads from and to
    width: float  # of the doorway [drawing units]

    @property
    def openings(self) -> Array:
        """The doorway at the one box and at the other, (2, 2, 2): two ends of each."""
        along = self.ends[1] - self.ends[0]
        across = np.array([-along[1], along[0]]) / np.hypot(*along) * self.width / 2.0
        return np.stack([self.ends - across, self.ends + across], axis=1)


def find_patched(
    sheet: Sheet, drawn: Sequence[int], seen: Sequence[Seen], ground: Color, diagonal: float
) -> dict[int, float]:
    """Find lines with the two ends of a patch below them, that is wider, and how wide it is.

    They are signs of doors, or of windows.
    """
    patches = [
        (number, mark.pen.width, ends_of(mark))
        for number in drawn
        if (mark := sheet.marks[number]).pen is not None
        and is_straight(mark, diagonal)
        and difference(mark.pen.color, ground) < FAINT
    ]
    if not patches:
        return {}
    numbers, widths, ends = (np.array(column) for column in zip(*patches, strict=True))
    found = {}
    for number in (mark.number for mark in seen):
        mark = sheet.marks[number]
        if mark.pen is not None and is_straight(mark, diagonal):
            own = ends_of(mark)
            apart = np.minimum(*(np.abs(ends - way).max(axis=(1, 2)) for way in (own, own[::-1])))
            below = (numbers < number) & (widths >= WIDER * mark.pen.width) & (apart <= NEAR * diagonal)
            if below.any():
                found[number] = float(widths[below].max())
    return found


def find_bridges(
    sheet: Sheet, seen: Sequence[Seen], patched: Mapping[int, float], diagonal: float
) -> list[Bridge]:
    """Find the lines upon patches that lead from one box to the next, and lie along no wall.

    Where they end, the patch has erased the outlines of both boxes.
    """
    if not patched:
        return []
    others = segments_of([mark for mark in seen if mark.number not in patched])
    found = []
    for number, width in patched.items():
        ends = ends_of(sheet.marks[number])
        near = [others.tree.query_nearest(point, return_distance=True)[1] for point in shapely.points(ends)]
        reach = width / 2.0 + NEAR * diagonal
        leads = all(len(distances) and distances[0] <= reach for distances in near)
        if leads and not goes_on(Bar(-1, ends, 0.0), others, diagonal):
            found.append(Bridge(number, ends, max(width, LEAST * diagonal)))
    return found


def find_passages(
    sheet: Sheet, seen: Sequence[Seen], named: AbstractSet[int], diagonal: float
) -> list[Bridge]:
    """Find the boxes, among those named doors, of which two opposite sides lie on walls, the others on none.

    They lead from one room to another that stands apart.
    """
    places = [mark.number for mark in seen if mark.number in named]
    others = segments_of([mark for mark in seen if mark.number not in named])
    if not places or not len(others.ends):
        return []
    found = []
    for number in places:
        mark = sheet.marks[number]
        if len(mark.outlines) != 1 or len(mark.outlines[0].ring) != CORNERS:
            continue
        sides = np.stack([mark.outlines[0].ring[:-1], mark.outlines[0].ring[1:]], axis=1)
        lengths = np.hypot(*(sides[:, 1] - sides[:, 0]).T)
        on_wall = [lies_on(side, others, diagonal) for side in sides]
        if lengths.max() <= SIZES[1] * diagonal and on_wall in ([True, False] * 2, [False, True] * 2):
            first = on_wall.index(True)
            ends = sides[[first, first + 2]].mean(axis=1)
            found.append(Bridge(number, ends, float(lengths[first])))
    return found


def lies_on(side: Array, walls: Segments, diagonal: float) -> bool:
    """Tell whether the middle and both ends of a side (2, 2) lie on a wall."""
    points = shapely.points([side[0], side.mean(axis=0), side[1]])
    near = walls.tree.query(points, predicate="dwithin", distance=NEAR * diagonal)
    along = (side[1] - side[0]) / np.hypot(*(side[1] - side[0]))
    steps, lengths = walls.ends[near[1], 1] - walls.ends[near[1], 0], walls.lengths[near[1]]
    level = np.abs(steps[:, 0] * along[1] - steps[:, 1] * along[0]) <= LEVEL * lengths
    return len(np.unique(near[0][level])) == len(points)


def opened_through(sheet: Sheet, seen: Sequence[Seen], named: AbstractSet[int], ground: Color) -> list[Seen]:
    """Open what lies beside patches that are named doors, as far as these are wide, along their whole length.

    Programs draw each room with walls of its own, and the patch over the wall of one room only.
    """
    cuts = [
        shapely.buffer(shapely.LineString(middle), BESIDE * width, cap_style="flat")
        for number in sorted(named)
        if (patch := sheet.marks[number]).fill is not None
        and difference(patch.fill, ground) < FAINT
        and is_box(patch)
        for middle, width in [middle_of(patch)]
        if width <= SLENDER * np.hypot(*(middle[1] - middle[0]))
    ]
    if not cuts:
        return list(seen)
    cut = shapely.union_all(cuts)
    shapely.prepare(cut)
    left = []
    for mark in seen:
        if mark.number in named or not (cut.intersects(mark.area) or cut.intersects(mark.line)):
            left.append(mark)
        else:
            line = shapely.multilinestrings(parts_of(shapely.difference(mark.line, cut)))
            left.append(Seen(mark.number, line, shapely.difference(mark.area, cut), False))
    return left


def middle_of(box: Mark) -> tuple[Array, float]:
    """Return the ends of the middle line of a box along its longer side, (2, 2), and its width."""
    left, bottom, right, top = bounds_of(box)
    center, half = np.array([(left + right) / 2.0, (bottom + top) / 2.0]), (right - left) / 2.0
    along = np.array([half, 0.0])
    width = top - bottom
    if width > 2.0 * half:
        along, width = np.array([0.0, width / 2.0]), 2.0 * half
    return np.stack([center - along, center + along]), width


def without_bridges(seen: Sequence[Seen], bridges: Sequence[Bridge], diagonal: float) -> list[Seen]:
    """Open both boxes at each doorway, and put its two sides in place of the line through it."""
    if not bridges:
        return list(seen)
    openings = shapely.linestrings(np.concatenate([bridge.openings for bridge in bridges]))
    cut = shapely.union_all(shapely.buffer(openings, NEAR * diagonal, cap_style="flat"))
    shapely.prepare(cut)
    sides = {
        bridge.number: shapely.multilinestrings(shapely.linestrings(bridge.openings.swapaxes(0, 1)))
        for bridge in bridges
    }
    left = []
    for mark in seen:
        if mark.number in sides:
            left.append(Seen(mark.number, sides[mark.number], mark.area, False))
        elif cut.intersects(mark.line):
            line = shapely.multilinestrings(parts_of(shapely.difference(mark.line, cut)))
            left.append(Seen(mark.number, line, mark.area, False))
        else:
            left.append(mark)
    return left


def opened_bridges(bridges: Sequence[Bridge]) -> tuple[Polyline, ...]:
    """Return the openings between two boxes, halfway."""
    return tuple(Polyline(bridge.openings.mean(axis=0)) for bridge in bridges)


def is_straight(mark: Mark, diagonal: float) -> bool:
    """Tell whether a mark is one straight line of the length of a door."""
    if len(mark.outlines) != 1 or len(mark.outlines[0]) != 2:
        return False
    return SIZES[0] * diagonal <= mark.outlines[0].length <= SIZES[1] * diagonal


def ends_of(mark: Mark) -> Array:
    """Return the ends of a straight line, (2, 2)."""
    return mark.outlines[0].vertices
