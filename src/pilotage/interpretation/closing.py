"""Tell where doors close: which spoke of an arc lies in the wall, and which is the leaf that stands open."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.interpretation.arcs import AJAR, Arc
from pilotage.interpretation.segments import Segments

SLACK = 0.1
"""How far a wall may stray from a spoke that it runs along, as a share of the radius."""

BEHIND = (0.03, 0.2)
"""A wall this far behind a leaf that stands wide open, as shares of the radius, is one that it leans on."""

ALONGSIDE = (0.25, 0.75, 1.25)
"""It passes what lies between these shares of the leaf, and is longer than the last."""

BEYOND = 0.25
"""Where a wall is looked for beyond hinge and latch, as a share of the radius; it is longer than that."""

Sides = tuple[Arc, NDArray[np.bool_], Array]
"""An arc, at which of its two ends a leaf lies (2,), and at how many sides of each spoke a wall is (2,)."""


def closings(judged: Sequence[Sides], segments: Segments) -> list[Array]:
    """Return from where to where each door closes, from its hinge to its latch, (2, 2).

    Most drawings show leaves open, some show them shut: where one door tells nothing, most others do.
    """
    shut = [is_shut(*sides, segments) for sides in judged]
    usually = shut.count(True) > shut.count(False)
    return [
        closing(*sides, segments, shut=usually if is_it is None else is_it)
        for sides, is_it in zip(judged, shut, strict=True)
    ]


def is_shut(arc: Arc, leaves: NDArray[np.bool_], walls: Array, segments: Segments) -> bool | None:
    """Tell whether the one leaf of a door is drawn in its wall; None if it is no matter, or may be both.

    It is, too, if it fills a gap between two ends of a wall and nothing lies before or behind the open door,
    or but what crosses its way, as the other side of a corridor does. One that leans on a wall stands open.
    """
    if arc.sweep < AJAR or leaves.sum() != 1:
        return None
    leaf = int(np.argmax(leaves))
    if leans(arc, arc.ends[leaf], segments):
        return False
    through, across = (len(offsets(arc, arc.ends[k], segments, SLACK)) > 0 for k in (leaf, 1 - leaf))
    if through and across:
        return None
    if through:
        return bool(walls[1 - leaf] < 2.0)
    is_free = across or walls[1 - leaf] == 0.0
    return bool(walls[leaf] == 2.0 and (is_free or fills(arc, leaf, segments)))


def closing(arc: Arc, leaves: NDArray[np.bool_], walls: Array, segments: Segments, *, shut: bool) -> Array:
    """Return hinge and latch of a door that stands open, or is drawn shut."""
    alone = leaves & ~leaves[::-1]
    if shut and alone.any():
        return np.array([arc.center, arc.ends[int(np.argmax(alone))]])
    closed = int(np.argmax(walls - 2.0 * alone))
    if arc.sweep >= AJAR and leaves.any() and walls.max() == 0.0:
        far = far_side(arc, segments)
        if far is not None:
            return far
    if arc.sweep >= AJAR and leaves.all() and walls[0] == walls[1]:
        closed = int(leans(arc, arc.ends[0], segments) and not leans(arc, arc.ends[1], segments))
    return np.array([arc.center, arc.ends[closed]])


def far_side(arc: Arc, segments: Segments) -> Array | None:
    """Find the wall of a symbol that is turned the wrong way: along the box of its arc, beyond an end."""
    corner = arc.ends.sum(axis=0) - arc.center
    for end in arc.ends:
        side = Arc(corner, arc.radius, np.array([end, end]), arc.vertices, arc.sweep)
        if len(offsets(side, end, segments, SLACK)):
            return np.array([corner, end])
    return None


def offsets(arc: Arc, end: Array, segments: Segments, reach: float) -> Array:
    """Measure how far walls are that run along the spoke to one end of an arc, as shares of the radius, (n,).

    Positive is where the arc is. A wall that runs along is longer than the spoke.
    """
    along = (end - arc.center) / arc.radius
    inward = arc.ends.sum(axis=0) - 2.0 * end
    first, last, long = ALONGSIDE
    middle = shapely.LineString(arc.center + np.array([[first], [last]]) * (end - arc.center))
    near = segments.tree.query(middle, predicate="dwithin", distance=reach * arc.radius)
    steps, lengths = segments.ends[near, 1] - segments.ends[near, 0], segments.lengths[near]
    turn = np.abs(steps[:, 0] * along[1] - steps[:, 1] * along[0])
    near = near[(lengths >= long * arc.radius) & (turn <= SLACK * lengths)]
    across = np.array([-along[1], along[0]])
    across = across if across @ inward > 0.0 else -across
    return np.asarray((segments.ends[near].mean(axis=1) - arc.center) @ across / arc.radius)


def fills(arc: Arc, leaf: int, segments: Segments) -> bool:
    """Tell whether a wall goes on beyond both ends of a leaf, and none along the other spoke."""
    return goes_on(arc, arc.ends[leaf], segments) == 2 and not goes_on(arc, arc.ends[1 - leaf], segments)


def goes_on(arc: Arc, end: Array, segments: Segments) -> int:
    """Count at how many sides of the spoke to one end of an arc a wall goes on in its direction."""
    along = (end - arc.center) / arc.radius
    places = shapely.points([arc.center - BEYOND * arc.radius * along, end + BEYOND * arc.radius * along])
    side, near = segments.tree.query(places, predicate="dwithin", distance=1.5 * SLACK * arc.radius)
    steps, lengths = segments.ends[near, 1] - segments.ends[near, 0], segments.lengths[near]
    turn = np.abs(steps[:, 0] * along[1] - steps[:, 1] * along[0])
    return len(np.unique(side[(turn <= SLACK * lengths) & (lengths > BEYOND * arc.radius)]))


def leans(arc: Arc, end: Array, segments: Segments) -> bool:
    """Tell whether a wall passes behind the spoke to one end of an arc, and none along it: it is no opening.

    Behind is where the arc is not. A door that is drawn on a wall without a gap has a line along its opening.
    """
    away = offsets(arc, end, segments, BEHIND[1])
    return bool((away < -BEHIND[0]).any() and not (np.abs(away) <= BEHIND[0]).any())
