"""Find doors that are marked on walls without a gap: by bars along or across them, or by small squares."""

from collections import defaultdict
from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import shapely

from pilotage.geometry import Array, Polyline
from pilotage.interpretation.dashed import dashed_among
from pilotage.interpretation.paint import NOTHING, Seen, parts_of
from pilotage.interpretation.pieces import on_grid
from pilotage.interpretation.segments import Segments, segments_of
from pilotage.interpretation.sheet import Sheet, Text

SIZES = (0.004, 0.12)
"""Least and largest length of a bar as a share of the drawing's diagonal."""

GATE = 0.3
"""And of one that is named a door and stands in a gap: that of a garage."""

SLENDER = 0.25
"""A bar is at most so wide, as a share of its length."""

SQUARE = 0.7
"""A square is at least so wide, as a share of its length."""

LARGEST_SQUARE = 0.03
"""Length of the largest square that marks a door, as a share of the drawing's diagonal."""

NEAR = 0.002
"""Lines that come this near lie on each other, as a share of the drawing's diagonal."""

USUAL = 0.03
"""Width of a door that a square or a bar across its wall marks, as a share of the drawing's diagonal."""

BEYOND = 0.01
"""Least distance beyond a bar at which its wall goes on, as a share of the drawing's diagonal."""

LEVEL = np.sin(np.radians(5.0))
"""A bar and its wall are parallel up to this."""

PARTING = 2
"""So many marks of one style at least part rooms; the front door does not."""

ALIKE = 3
"""So many marks of one style at least lie on walls, where marks of this style are doors."""

MOST = 0.5
"""And so many of all marks of this style, as a share: what also stands within rooms is furniture."""


@dataclass(frozen=True, eq=False)
class Bar:
    """A mark on a wall that says where a door is."""

    place: int  # of its mark, among those seen
    ends: Array  # (2, 2), on the wall
    width: float  # across the wall [drawing units]
    tips: Array = field(default_factory=lambda: np.empty((0, 2)))  # of a bar across the wall: its free ends

    @property
    def length(self) -> float:
        """[drawing units]."""
        return float(np.hypot(*(self.ends[1] - self.ends[0])))

    @cached_property
    def across(self) -> Array:
        """Unit vector that leads from one room to the other, (2,)."""
        along = (self.ends[1] - self.ends[0]) / self.length
        return np.array([-along[1], along[0]])


def find_bars(
    sheet: Sheet, seen: Sequence[Seen], named: AbstractSet[int], diagonal: float, *, only_named: bool = False
) -> list[Bar]:
    """Find the bars and squares that mark doors: alike, on walls, each between two rooms that are closed.

    A line may lie along its wall, or stand upright on it or across it with its other ends free.
    Where walls have gaps for doors, what lies on both sides of them is one room: there are no such marks.
    Dashed lines part no rooms: outside of the walls they are the edge of a roof. One mark is enough if it is
    among those named doors. If only these may be doors, a line that but stands on a wall is a leaf.
    """
    shapes: dict[object, list[int]] = defaultdict(list)
    for place, mark in enumerate(seen):
        if only_named and mark.number not in named:
            continue
        drawn = sheet.marks[mark.number]
        shapes[drawn.pen, drawn.fill, mark.number in named].append(place)
    dashed = dashed_among(sheet, seen)
    found: list[Bar] = []
    for places in shapes.values():
        is_named = seen[places[0]].number in named
        least = 1 if is_named else ALIKE
        bars = [bar for place in places for bar in bars_of(sheet, seen, place, diagonal)]
        if is_named:
            bars += [bar for place in places for bar in boxed_bars(sheet, seen, place, diagonal)]
            bars += [bar for place in places for bar in curved_bars(sheet, seen, place, diagonal)]
        if len({bar.place for bar in bars}) < least:
            continue
        own = dashed.union(seen[place].number for place in places)
        others = [mark for mark in seen if mark.number not in own]
        parting = {bar.place: bar for bar in parting_bars(bars, others, least, diagonal)}
        if len(parting) >= (1 if least == 1 else max(PARTING, MOST * len(places))):
            found.extend(bar for bar in parting.values() if not only_named or len(bar.tips) != 1)
    return found


def find_fronts(
    sheet: Sheet, seen: Sequence[Seen], named: AbstractSet[int], bars: Sequence[Bar], diagonal: float
) -> list[Bar]:
    """Find the bars that are named doors, stand in a gap of a wall and part no two rooms, as front doors."""
    known = {bar.place for bar in bars}
    places = [place for place, mark in enumerate(seen) if mark.number in named and place not in known]
    if not places:
        return []
    segments = segments_of([mark for mark in seen if mark.number not in named])
    every = (bars_of(sheet, seen, place, diagonal, GATE) for place in places)
    along = (found[-1] for found in every if len(found) in (1, 4))
    return [bar for bar in along if goes_on(bar, segments, diagonal, BEYOND * diagonal)]


def bars_of(
    sheet: Sheet, seen: Sequence[Seen], place: int, diagonal: float, largest: float = SIZES[1]
) -> list[Bar]:
    """Return the bar that a mark draws; of a square or a line all that it may be; none for all else.

    A filled box without a line may be a door in a wall that runs through its middle, along either side.
    """
    mark = sheet.marks[seen[place].number]
    if len(mark.outlines) != 1 or len(mark.outlines[0]) > 5:
        return []
    points = mark.outlines[0].vertices
    box = shapely.get_coordinates(shapely.oriented_envelope(shapely.multipoints(points)))
    sides = np.diff(box, axis=0)[:2] if len(box) == 5 else np.array([points[-1] - points[0], [0.0, 0.0]])
    sides = sides[np.argsort(-np.hypot(*sides.T))]
    length, width = np.hypot(*sides.T)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    if not SIZES[0] * diagonal <= length <= largest * diagonal:
        return []
    is_square = mark.fill is not None and width >= SQUARE * length and length <= LARGEST_SQUARE * diagonal
    if mark.pen is None and SLENDER * length < width < SQUARE * length and len(box) == 5:
        return [Bar(place, middle + np.array([[-0.5], [0.5]]) * side, 0.0) for side in sides]
    if not is_square and width > SLENDER * length:
        return []
    if len(points) == 2:
        return [*upright_bars(place, points, diagonal), Bar(place, points, 0.0)]
    wide = max(USUAL * diagonal / length, 1.0) if is_square else 1.0
    return [
        Bar(place, middle + np.array([[-0.5], [0.5]]) * wide * side, float(width))
        for side in (sides if is_square else sides[:1])
    ]


def boxed_bars(sheet: Sheet, seen: Sequence[Seen], place: int, diagonal: float) -> list[Bar]:
    """Return the bars that a box may be that is named a door: as wide as its wall, or across it."""
    mark = sheet.marks[seen[place].number]
    if len(mark.outlines) != 1 or not mark.outlines[0].closed or len(mark.outlines[0]) > 5:
        return []
    points = mark.outlines[0].vertices
    box = shapely.get_coordinates(shapely.oriented_envelope(shapely.multipoints(points)))
    sides = np.diff(box, axis=0)[:2]
    lengths = np.hypot(*sides.T)
    if (
        not SIZES[0] * diagonal <= lengths.max() <= SIZES[1] * diagonal
        or lengths.min() <= SLENDER * lengths.max()
    ):
        return []
    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    return [
        Bar(place, middle + np.array([[-0.5], [0.5]]) * side, float(width))
        for side, width in zip(sides, lengths[::-1], strict=True)
    ]


def curved_bars(sheet: Sheet, seen: Sequence[Seen], place: int, diagonal: float) -> list[Bar]:
    """Return the bars that a swing may be that is named a door: it stands on a wall with an end."""
    mark = sheet.marks[seen[place].number]
    if len(mark.outlines) != 1 or mark.outlines[0].closed or len(mark.outlines[0]) < 3:
        return []
    ends = mark.outlines[0].vertices[[0, -1]]
    if not SIZES[0] * diagonal <= np.hypot(*(ends[1] - ends[0])) <= SIZES[1] * diagonal:
        return []
    half = USUAL * diagonal / 2.0
    return [
        Bar(place, foot + half * np.array([[-1.0], [1.0]]) * along, 0.0, tip[None])
        for foot, tip in (ends, ends[::-1])
        for along in np.eye(2)
    ]


def upright_bars(place: int, ends: Array, diagonal: float) -> list[Bar]:
    """Return the bars across a wall that a line may be: with its middle or with one end on the wall."""
    along = (ends[1] - ends[0]) / np.hypot(*(ends[1] - ends[0]))
    half = USUAL * diagonal / 2.0 * np.array([-along[1], along[0]])
    feet = ((ends.mean(axis=0), ends), (ends[0], ends[1:]), (ends[1], ends[:1]))
    return [Bar(place, np.array([foot - half, foot + half]), 0.0, tips) for foot, tips in feet]


def parting_bars(bars: Sequence[Bar], others: Sequence[Seen], least: int, diagonal: float) -> list[Bar]:
    """Keep bars between two rooms, told by the other marks; none if fewer than `least` are on walls."""
    segments = segments_of(others)
    on_wall = [
        bar for bar in bars if goes_on(bar, segments, diagonal) and is_free(bar.tips, segments, diagonal)
    ]
    if len({bar.place for bar in on_wall}) < least:
        return []
    grain = NEAR * diagonal / 2.0
    joints = [bar.ends[:, None] + 2.0 * grain * np.array([[-1.0], [1.0]]) * bar.across for bar in on_wall]
    pieces = np.concatenate([segments.ends, *(bar.ends[None] for bar in on_wall), *joints])
    pieces = on_grid(pieces, grain)
    noded = shapely.union_all(shapely.multilinestrings(shapely.linestrings(pieces)), grid_size=grain)
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
    if not len(faces):
        return []
    tree = shapely.STRtree(faces)
    kept = []
    for bar in on_wall:
        step = (bar.width / 2.0 + 2.0 * NEAR * diagonal) * bar.across
        sides = shapely.points(bar.ends.mean(axis=0) + np.array([-step, step]))
        held, rooms = tree.query(sides, predicate="within")
        if len(held) == 2 and rooms[0] != rooms[1] and shapely.area(faces[rooms]).min() > bar.length**2:
            kept.append(bar)
    return kept


def goes_on(bar: Bar, segments: Segments, diagonal: float, further: float | None = None) -> bool:
    """Tell whether a wall goes on beyond both ends of a bar, and so far."""
    along = (bar.ends[1] - bar.ends[0]) / bar.length
    step = max(bar.length / 4.0, BEYOND * diagonal) if further is None else further
    least = bar.length / 2.0 if further is None else further
    for point in (bar.ends[0] - step * along, bar.ends[1] + step * along):
        near = segments.tree.query(
            shapely.Point(point), predicate="dwithin", distance=bar.width / 2.0 + NEAR * diagonal
        )
        steps, lengths = segments.ends[near, 1] - segments.ends[near, 0], segments.lengths[near]
        turn = np.abs(steps[:, 0] * along[1] - steps[:, 1] * along[0])
        if not ((turn <= LEVEL * lengths) & (lengths > least)).any():
            return False
    return True


def is_free(tips: Array, segments: Segments, diagonal: float) -> bool:
    """Tell whether no line comes near to any of some points (n, 2)."""
    near = segments.tree.query(shapely.points(tips), predicate="dwithin", distance=NEAR * diagonal)
    return bool(near.size == 0)


def without_bars(seen: Sequence[Seen], bars: Sequence[Bar], diagonal: float) -> list[Seen]:
    """Take bars out of what is seen, and the wall below them: gaps are left."""
    if not bars:
        return list(seen)
    gone = {bar.place for bar in bars}
    cut = shapely.union_all(
        [
            shapely.buffer(shapely.LineString(bar.ends), bar.width / 2.0 + NEAR * diagonal, cap_style="flat")
            for bar in bars
        ]
    )
    shapely.prepare(cut)
    left = []
    for place, mark in enumerate(seen):
        if place not in gone and cut.intersects(mark.line):
            parts = parts_of(shapely.difference(mark.line, cut))
            line = shapely.multilinestrings(parts) if len(parts) else NOTHING
            left.append(Seen(mark.number, line, mark.area, False))
        elif place not in gone:
            left.append(mark)
    return left


def written_upon(bars: Sequence[Bar], texts: Sequence[Text]) -> set[int]:
    """List the texts that stand upon bars, by number."""
    return {
        number
        for number, text in enumerate(texts)
        for bar in bars
        if shapely.LineString(bar.ends).distance(shapely.Point(text.position)) < bar.width / 2.0
    }


def opened_bars(bars: Sequence[Bar]) -> tuple[Polyline, ...]:
    """Return the openings that bars mark."""
    return tuple(Polyline(bar.ends) for bar in bars)
