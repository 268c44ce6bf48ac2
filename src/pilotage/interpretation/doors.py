"""Find doors by what is drawn of them: an arc about the hinge, and a leaf."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.interpretation.arcs import AJAR, EVEN, UPRIGHT, Arc, find_arcs
from pilotage.interpretation.closing import closings
from pilotage.interpretation.leaves import find_leaves
from pilotage.interpretation.paint import NOTHING, Seen, parts_of, shapes_of
from pilotage.interpretation.segments import Segments, segments_of
from pilotage.interpretation.sheet import Sheet

RADII = (0.004, 0.12)
"""Least and largest radius of a door as a share of the drawing's diagonal: in a hall, in a kiosk."""

ALIKE = 1.6
"""Doors of one drawing differ in width from their median by no more than this factor."""

LEAF = (0.6, 1.25)
"""A leaf is as long as the radius of its arc, within these shares."""

SLACK = 0.1
"""How far a leaf may stray from its arc's spoke, as a share of the radius: it has a thickness."""

BESIDE = 0.25
"""Where a wall is looked for beyond hinge and latch, as a share of the radius."""

GATE = 3.0
"""Two leaves that meet may each be so many times as wide as most doors: a gate."""

JAMB = 0.06
"""Share of an opening at either end that is not cut."""

THROUGH = 0.5
"""How far a wall is cut to either side of an opening, as a share of its width: no wall is thicker."""

FEW = 3
"""Fewer walls that end in a line ajar are walls; who draws wall and leaf as one line does so more often."""

DOORS = 0.25
"""If a smaller share of the arcs as wide as doors are doors, none is: a hand draws walls with bends."""

TWINS = 0.2
"""Arcs whose centers and radii differ by less than this share of the radius draw one door."""


@dataclass(frozen=True, eq=False)
class Door:
    """An opening with a leaf."""

    hinge: Array  # (2,)
    latch: Array  # (2,)
    arc: Arc
    marks: tuple[int, ...]  # places of the marks that draw its arc, among those seen

    @property
    def width(self) -> float:
        """[drawing units]."""
        return self.arc.radius

    @cached_property
    def opening(self) -> shapely.Polygon:
        """What is cut out of the wall."""
        along = (self.latch - self.hinge) / np.hypot(*(self.latch - self.hinge))
        across = np.array([-along[1], along[0]]) * THROUGH * self.width
        first, last = self.hinge + JAMB * self.width * along, self.latch - JAMB * self.width * along
        return shapely.Polygon([first - across, last - across, last + across, first + across])

    @cached_property
    def swing(self) -> shapely.Polygon:
        """Where the leaf swings, and a little more."""
        sector = shapely.Polygon(np.vstack([self.arc.center, self.arc.vertices]))
        return shapely.buffer(shapely.make_valid(sector), SLACK * self.width, join_style="mitre")


def find_doors(sheet: Sheet, seen: Sequence[Seen], diagonal: float) -> list[Door]:
    """Find the doors that are drawn with an arc.

    An arc is a door's if there is a leaf along one of its spokes, or if it is as wide as those that have one;
    where no leaf is drawn at all, if a wall ends at its hinge and its latch.
    """
    outlines = [
        (outline, place) for place, mark in enumerate(seen) for outline in sheet.marks[mark.number].outlines
    ]
    radii = (RADII[0] * diagonal, RADII[1] * diagonal)
    arcs = [
        (arc, outlines[number][1])
        for arc, number in find_arcs([outline for outline, _ in outlines])
        if radii[0] <= arc.radius <= radii[1]
    ]
    segments = segments_of(seen)
    judged = righted(without_twins(arcs), segments)
    judged = [one for one in judged if not one[0].is_part or is_notch(one[0], *one[2:])]
    ajar = find_leaves(sheet, seen, segments, radii)
    ajar = [arc for arc, walls in zip(ajar, judge(ajar, segments)[1], strict=True) if walls[1] == 2.0]
    ajar = without_odd_walls(ajar)
    leaved = [arc for arc, _, leaves, _ in judged if leaves.any()]
    hang = any(walls.max() == 2.0 for _, _, leaves, walls in judged if leaves.any())  # not those of a chart
    candidates = (leaved if hang else ajar) or leaved or [arc for arc, *_ in judged]
    if not candidates:
        return []
    usual = usual_width(candidates)
    drawn = [one for one in judged if is_drawn(one[0], *one[2:], usual, leaved)]
    if len(drawn) < DOORS * sum(is_like(arc, usual) for arc, *_ in judged):
        drawn = []
    sides = [(arc, leaves, walls) for arc, _, leaves, walls in drawn]
    doors = [
        Door(ends[0], ends[1], arc, marks)
        for (arc, marks, *_), ends in zip(drawn, closings(sides, segments), strict=True)
    ]
    for arc in ajar:
        leaf = shapely.LineString([arc.center, arc.ends[0]])
        if is_like(arc, usual) and not any(door.swing.contains(leaf) for door in doors):
            doors.append(Door(arc.center, arc.ends[1], arc, ()))
    return doors


def without_odd_walls(arcs: list[Arc]) -> list[Arc]:
    """Leave out leaves that are the end of a wall's line, if there are few."""
    return arcs if sum(arc.is_part for arc in arcs) >= FEW else [arc for arc in arcs if not arc.is_part]


def is_drawn(arc: Arc, leaves: NDArray[np.bool_], walls: Array, usual: float, leaved: Sequence[Arc]) -> bool:
    """Tell whether an arc is a door's: as wide as most or a gate, with a leaf or a wall at both its ends."""
    is_gate = usual * ALIKE < arc.radius <= usual * GATE and any(meet(arc, other) for other in leaved)
    has_ends = leaves.any() or (arc.sweep >= AJAR and walls.max() == 2.0)
    return bool((is_gate or is_like(arc, usual)) and has_ends)


def is_like(arc: Arc, usual: float) -> bool:
    """Tell whether an arc is about as wide as most doors."""
    return usual / ALIKE <= arc.radius <= usual * ALIKE


def meet(first: Arc, second: Arc) -> bool:
    """Tell whether two arcs are of one width and meet halfway between their hinges: a double door."""
    slack = SLACK * first.radius
    middle = (first.center + second.center) / 2.0
    gaps = [np.hypot(*(arc.ends - middle).T).min() for arc in (first, second)]
    apart = np.hypot(*(first.center - second.center)) / 2.0
    return bool(
        max(abs(first.radius - second.radius), abs(apart - first.radius), *gaps) <= slack
        and min(first.sweep, second.sweep) >= AJAR
    )


def usual_width(arcs: Sequence[Arc]) -> float:
    """Find the usual width of doors: half of the length of all arcs belongs to narrower ones.

    A plant or a chair may have more arcs than there are doors, but they are short.
    """
    ordered = sorted(arcs, key=lambda arc: arc.radius)
    length = np.cumsum([arc.sweep * arc.radius for arc in ordered])
    return ordered[int(np.searchsorted(length, length[-1] / 2.0))].radius


def without_twins(arcs: Sequence[tuple[Arc, int]]) -> list[tuple[Arc, tuple[int, ...]]]:
    """Keep the widest of arcs that draw the same door, with the marks of all."""
    ordered = sorted(arcs, key=lambda item: -item[0].radius)
    centers = np.array([arc.center for arc, _ in ordered]).reshape(-1, 2)
    slack = TWINS * np.array([[arc.radius] for arc, _ in ordered]).reshape(-1, 1)
    around = shapely.box(*np.hstack([centers - slack, centers + slack]).T)
    first, second = shapely.STRtree(shapely.points(centers)).query(around)
    earlier = second < first
    wider: dict[int, list[int]] = {}
    for rank, other in sorted(zip(first[earlier].tolist(), second[earlier].tolist(), strict=True)):
        wider.setdefault(rank, []).append(other)
    kept: dict[int, list[int]] = {}
    for rank, (arc, place) in enumerate(ordered):
        for other in wider.get(rank, []):
            ends = ordered[other][0].ends
            gap = min(np.abs(arc.ends - ends).max(), np.abs(arc.ends - ends[::-1]).max())
            if other in kept and gap < TWINS * arc.radius:
                kept[other].append(place)
                break
        else:
            kept[rank] = [place]
    return [(ordered[rank][0], tuple(sorted(set(marks)))) for rank, marks in kept.items()]


def judge(arcs: Sequence[Arc], segments: Segments) -> tuple[NDArray[np.bool_], Array]:
    """Tell at both ends of arcs whether a leaf lies there, and at how many sides of it is a wall, (n, 2)."""
    radii = np.repeat([arc.radius for arc in arcs], 2)
    spokes = np.array([(arc.center, end) for arc in arcs for end in arc.ends]).reshape(-1, 2, 2)
    beyond = spokes + BESIDE * np.diff(spokes, axis=1) * [[-1.0], [1.0]]
    reach = np.repeat(SLACK * 1.5 * radii, 2)
    near, _ = segments.tree.query(shapely.points(beyond.reshape(-1, 2)), predicate="dwithin", distance=reach)
    walls = (np.bincount(near, minlength=len(reach)) > 0).reshape(-1, 2, 2).sum(axis=2, dtype=np.float64)
    return have_leaves(spokes, radii, segments).reshape(-1, 2), walls


def righted(
    arcs: Sequence[tuple[Arc, tuple[int, ...]]], segments: Segments
) -> list[tuple[Arc, tuple[int, ...], NDArray[np.bool_], Array]]:
    """Judge arcs; one is mirrored over its chord if only so walls are at its hinge and its latch.

    The sense of an arc is easily mistaken where it is written by hand.
    """
    found = []
    for (arc, marks), leaves, walls in zip(arcs, *judge([arc for arc, _ in arcs], segments), strict=True):
        mirrored = replace(arc, center=arc.ends.sum(axis=0) - arc.center)
        if is_quarter(arc) and not leaves.any() and walls.max() < 2.0 and is_at_wall(mirrored, segments):
            (mirrored_leaves,), (mirrored_walls,) = judge([mirrored], segments)
            found.append((mirrored, marks, mirrored_leaves, mirrored_walls))
        else:
            found.append((arc, marks, leaves, walls))
    return found


def is_quarter(arc: Arc) -> bool:
    """Tell whether an arc is a quarter circle in even chords, which no hand draws."""
    chords = np.hypot(*np.diff(arc.vertices, axis=0).T)
    is_even = chords.max() <= EVEN * chords.min()
    return bool(not arc.is_part and is_even and abs(arc.sweep - np.pi / 2.0) <= UPRIGHT)


def is_at_wall(arc: Arc, segments: Segments) -> bool:
    """Tell whether there are straight walls before an arc's hinge and beyond one of its ends."""
    for end in arc.ends:
        along = BESIDE * (end - arc.center)
        places = shapely.points([arc.center - along, end + along])
        place, near = segments.tree.query(places, predicate="dwithin", distance=SLACK * arc.radius)
        if len(np.unique(place[segments.lengths[near] > BESIDE * arc.radius])) == 2:
            return True
    return False


def is_notch(arc: Arc, leaves: NDArray[np.bool_], walls: Array) -> bool:
    """Tell whether an arc within an outline is a door: the outline returns along a leaf to where it left."""
    return bool(arc.sweep >= AJAR and leaves.sum() == 1 and walls[np.argmin(leaves)] == 2.0)


def have_leaves(spokes: Array, radii: Array, segments: Segments) -> NDArray[np.bool_]:
    """Tell along which spokes (n, 2, 2) of arcs a segment of the right length runs, (n,)."""
    around = shapely.buffer(shapely.linestrings(spokes), SLACK * 1.5 * radii, cap_style="square")
    spoke, near = segments.tree.query(around)
    lengths = segments.lengths[near]
    long = (lengths >= LEAF[0] * radii[spoke]) & (lengths <= LEAF[1] * radii[spoke])
    spoke, near = spoke[long], near[long]
    along = shapely.contains(around[spoke], segments.tree.geometries[near])
    return np.bincount(spoke[along], minlength=len(spokes)) > 0


def without_doors(seen: Sequence[Seen], doors: Sequence[Door]) -> list[Seen]:
    """Take doors out of what is seen: arcs, leaves, and what closes the opening."""
    left = list(seen)
    if not seen:
        return left
    tree = shapely.STRtree(shapes_of(seen).ravel())
    for door in doors:
        reach = shapely.union(door.swing, door.opening)
        shapely.prepare([door.swing, door.opening])
        for place in np.unique(tree.query(reach, predicate="intersects") % len(seen)).tolist():
            mark = left[place]
            line, area = mark.line, mark.area
            if place in door.marks:
                track = shapely.LineString(door.arc.vertices)
                narrow, wide = (
                    shapely.buffer(track, share * door.width, cap_style="square")
                    for share in (SLACK / 2.0, TWINS)
                )
                line, area = shapely.difference(line, narrow), shapely.difference(area, wide)
            line = without_leaf(line, door)
            area = shapely.difference(area, door.opening)
            whole = mark.whole and line.equals(mark.line)
            left[place] = Seen(mark.number, line, area, whole)
    return left


def without_leaf(line: shapely.Geometry, door: Door) -> shapely.Geometry:
    """Take leaf and threshold of a door out of a line."""
    if line.is_empty:
        return line
    along = (door.latch - door.hinge) / door.width
    kept = []
    for part in parts_of(line):
        points = shapely.get_coordinates(part)
        steps = np.diff(points, axis=0)
        segments = shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1))
        inner = shapely.contains(door.swing, segments)
        level = np.abs(steps @ np.array([-along[1], along[0]])) < 0.35 * np.hypot(*steps.T)
        crossed = level & shapely.intersects(segments, door.opening) & ~inner
        if not inner.any() and not crossed.any():
            kept.append(part)
            continue
        cut = np.where(crossed, shapely.difference(segments, door.opening), segments)
        kept.append(shapely.line_merge(shapely.union_all(cut[~inner])))
    pieces = [
        piece
        for part in kept
        for piece in parts_of(part)
        if piece.geom_type == "LineString" and not piece.is_empty
    ]
    return shapely.multilinestrings(pieces) if pieces else NOTHING
