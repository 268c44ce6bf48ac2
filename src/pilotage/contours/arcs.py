"""Maximal convex and concave arcs (Wolter 2001, section 3)."""

from dataclasses import dataclass
from enum import Enum
from itertools import pairwise

import numpy as np

from pilotage.contours.tangent import turns
from pilotage.geometry import Array, Polyline, Span

Cut = tuple[int, float]  # a vertex and a share of the segment that starts there

STRAIGHT_TURN = 1e-9  # [rad]; a smaller turn is rounding


class Bend(Enum):
    """How an arc looks from free space, which lies left of it."""

    CONVEX = 1  # turns left: free space bulges, as in the corner of a room
    CONCAVE = -1  # turns right: something juts out into free space
    STRAIGHT = 0


@dataclass(frozen=True, slots=True)
class Arc:
    """A stretch of a polyline that bends one way only."""

    span: Span
    bend: Bend
    turn: float  # [rad], positive to the left


def find_arcs(polyline: Polyline) -> tuple[Arc, ...]:
    """Cut a polyline into maximal convex and concave arcs (section 3).

    The stretch between two opposite turns is cut at its middle, so that the arcs partition the polyline. On a
    closed polyline the first arc starts at the first cut; one without a cut is a single arc from vertex 0.

    >>> notch = Polyline.through([(0, 0), (4, 0), (4, 2), (6, 2), (6, 0), (8, 0)])
    >>> [(arc.bend.name, arc.span.first, arc.span.last) for arc in find_arcs(notch)]
    [('CONVEX', 0, 2), ('CONCAVE', 1, 4), ('CONVEX', 3, 5)]
    """
    turn = turns(polyline)
    cuts = _cuts(polyline, turn)  # section 3: maximal arcs
    return tuple(_arc(turn, first, last) for first, last in pairwise(cuts))


def _cuts(polyline: Polyline, turn: Array) -> list[Cut]:
    """Find where arcs start, and where the last one ends."""
    n = len(polyline)
    bent = [int(vertex) for vertex in np.flatnonzero(np.abs(turn) > STRAIGHT_TURN)]
    following = [*bent[1:], bent[0] + n] if polyline.closed and bent else bent[1:]
    neighbors = zip(bent, following, strict=False)
    inflections = [_middle(polyline, i, j) for i, j in neighbors if turn[i] * turn[j % n] < 0.0]
    if not polyline.closed:
        return [(0, 0.0), *inflections, (n - 1, 0.0)]
    if not inflections:
        return [(0, 0.0), (n, 0.0)]
    around = sorted((vertex % n, share) for vertex, share in inflections)
    return [*around, (around[0][0] + n, around[0][1])]


def _middle(polyline: Polyline, i: int, j: int) -> Cut:
    """Find the middle of the way from vertex i to vertex j > i."""
    lengths = polyline.segment_lengths[np.arange(i, j) % len(polyline.segment_lengths)]
    way = np.concatenate([[0.0], np.cumsum(lengths)])
    k = int(np.searchsorted(way, way[-1] / 2.0, side="right")) - 1
    return i + k, float((way[-1] / 2.0 - way[k]) / lengths[k])


def _arc(turn: Array, first: Cut, last: Cut) -> Arc:
    """Join two cuts."""
    (i, first_share), (j, last_share) = first, last
    end, trim_last = (j + 1, 1.0 - last_share) if last_share > 0.0 else (j, 0.0)
    total = float(turn[np.arange(i + 1, end) % len(turn)].sum())
    bend = Bend(int(np.sign(total))) if abs(total) > STRAIGHT_TURN else Bend.STRAIGHT
    return Arc(Span(i, end, first_share, trim_last), bend, total)
