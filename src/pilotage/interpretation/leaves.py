"""Find leaves of doors that are drawn ajar without an arc, or with one that is too short to tell."""

from collections.abc import Sequence

import numpy as np
import shapely

from pilotage.geometry import Array
from pilotage.interpretation.arcs import Arc
from pilotage.interpretation.paint import Seen
from pilotage.interpretation.segments import Segments
from pilotage.interpretation.sheet import Sheet

AJAR = np.sin(np.radians([8.0, 78.0]))
"""A leaf stands at such an angle to its wall; what stands upright on a wall is a wall."""

AT = 0.1
"""A leaf begins as near to its wall as this share of its length."""

SHORT = 0.6
"""What is shorter than this share of a leaf may touch it: a knob, an arc, a tick."""

SIDES = 2
"""More parallel lines of one length than this are hatching or stairs."""

CHORDS = 8
"""Of the arc that is not drawn."""


def find_leaves(
    sheet: Sheet, seen: Sequence[Seen], segments: Segments, radii: tuple[float, float]
) -> list[Arc]:
    """Find straight lines from a wall into a room, ajar and free at their end: the arcs that they sweep.

    Some draw a wall and its leaf as one line: of such a line, an end that nothing touches.
    `radii` are the least and largest length of a leaf. Where two begin at one point it is an arrow, no door.
    """
    drawn = [
        outline.vertices
        for mark in seen
        if sheet.marks[mark.number].pen is not None and not mark.line.is_empty
        for outline in sheet.marks[mark.number].outlines
        if not outline.closed
    ]
    straight: list[Array] = []
    bent: list[Array] = []
    for line in drawn:
        (straight if is_straight(line) else bent).append(line)
    both_ways = [(line[0], line[-1]) for line in straight] + [(line[-1], line[0]) for line in straight]
    last = [ends for line in bent for ends in ((line[1], line[0]), (line[-2], line[-1]))]
    arcs = [
        swept(hinge, tip, segments, is_part=is_part)
        for lines, short, is_part in ((both_ways, SHORT, False), (last, 0.0, True))
        for hinge, tip in without_hatching(free_lines(lines, segments, radii, short), segments)
    ]
    found = [arc for arc in arcs if arc is not None]
    hinges = shapely.points([arc.center for arc in found]) if found else np.empty(0, dtype=object)
    reach = np.array([AT * arc.radius for arc in found])
    near, _ = shapely.STRtree(hinges).query(hinges, predicate="dwithin", distance=reach)
    return [
        arc for arc, count in zip(found, np.bincount(near, minlength=len(found)), strict=True) if count == 1
    ]


def free_lines(
    lines: Sequence[tuple[Array, Array]], segments: Segments, radii: tuple[float, float], short: float
) -> Array:
    """Choose lines from hinge to tip, of a leaf's length, whose outer half nothing comes near to.

    What is shorter than `short`, a share of the line, may. Returns (n, 2, 2).
    """
    ends = np.array(lines).reshape(-1, 2, 2)
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    ends = ends[(lengths >= radii[0]) & (lengths <= radii[1])]
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    outer = shapely.linestrings(np.stack([ends.mean(axis=1), ends[:, 1]], axis=1))
    line, near = segments.tree.query(outer, predicate="dwithin", distance=AT / 2.0 * lengths)
    long = segments.lengths[near] >= short * lengths[line]
    return np.asarray(ends[np.bincount(line[long], minlength=len(ends)) <= 1])


def is_straight(points: Array) -> bool:
    """Tell whether all vertices (n, 2) lie on a line from the first to the last, up to its thickness."""
    if len(points) == 2:  # most lines of large drawings
        return True
    along = points[-1] - points[0]
    spokes = points - points[0]
    strays = np.abs(spokes[:, 0] * along[1] - spokes[:, 1] * along[0])
    return bool(strays.max() <= AT / 2.0 * (along @ along))


def swept(hinge: Array, tip: Array, segments: Segments, *, is_part: bool) -> Arc | None:
    """Return the arc from a leaf to its wall; None if it is no leaf."""
    leaf = tip - hinge
    length = float(np.hypot(*leaf))
    near = segments.tree.query(shapely.Point(hinge), predicate="dwithin", distance=AT * length)
    near = near[segments.lengths[near] >= SHORT * length]
    for wall in near[np.argsort(-segments.lengths[near])]:
        along = (segments.ends[wall, 1] - segments.ends[wall, 0]) / segments.lengths[wall]
        along = along if along @ leaf > 0.0 else -along
        turn = (along[0] * leaf[1] - along[1] * leaf[0]) / length
        if AJAR[0] <= abs(turn) <= AJAR[1]:
            angle = np.arctan2(turn, along @ leaf / length)
            first = np.arctan2(leaf[1], leaf[0])
            angles = np.linspace(first, first - angle, CHORDS + 1)
            points = hinge + length * np.column_stack([np.cos(angles), np.sin(angles)])
            return Arc(hinge, length, points[[0, -1]], points, float(abs(angle)), is_part)
    return None


def without_hatching(lines: Array, segments: Segments) -> Array:
    """Leave out lines (n, 2, 2) that have others like them beside them; a leaf has two sides at most."""
    along = lines[:, 1] - lines[:, 0]
    lengths = np.hypot(*along.T)
    line, near = segments.tree.query(
        shapely.points(lines.mean(axis=1)), predicate="dwithin", distance=lengths
    )
    steps = segments.ends[near, 1] - segments.ends[near, 0]
    shares = segments.lengths[near] / lengths[line]
    turn = np.abs(steps[:, 0] * along[line, 1] - steps[:, 1] * along[line, 0]) / lengths[line]
    alike = (shares >= SHORT) & (shares <= 1.0 / SHORT) & (turn <= AT * segments.lengths[near])
    return np.asarray(lines[np.bincount(line[alike], minlength=len(lines)) <= SIDES])
