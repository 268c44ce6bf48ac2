"""Where free space narrows (Wolter 2001, section 4.1).

At a chord from wall to wall, clearance has a minimum along the Voronoi diagram or begins to grow. A door has
jambs: free space widens beside it on both sides. The cut of a corridor has none.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps.cells.voronoi import VoronoiDiagram, feet

SLACK = 1e-3
"""By what share of its width a chord may miss its Voronoi edge, or the end of a wall: ties on the grid."""

SHALLOW = 0.25
"""By what share of its width the mouth of a shallow niche may miss its Voronoi edge."""

BEHIND_WALLS = 1e-2
"""Share of a chord at either end that is not looked at when it must not touch a wall."""

JAMB_DEPTH = 0.2
"""Distance beside an opening at which free space is measured, in its widths."""

BEHIND = 0.7
"""Distance beside an opening at which one stands behind the wall that it is in, in its widths."""

JAMB_REACH = 2.0
"""Distance to either side up to which it is measured, in widths of the opening."""


@dataclass(frozen=True, eq=False)
class Chords:
    """Segments across free space from wall to wall; no two cross."""

    segments: Array  # (n, 2, 2)
    widths: Array  # (n,)


def find_chords(diagram: VoronoiDiagram) -> Chords:
    """Find a chord for every Voronoi edge on which its two sites come nearest to each other.

    Between two ends of walls that is the straight line, between an end and a wall the perpendicular; between
    two walls clearance has no minimum inside an edge. The mouth of a corridor is such an edge, too: there
    clearance begins to grow. At the mouth of a shallow niche the sites would come nearest just before
    the edge begins; there a chord must see its other end and cross no other.
    """
    left, right = diagram.sites[:, 0], diagram.sites[:, 1]
    left_is_end = (left[:, :2] == left[:, 2:]).all(axis=1)
    right_is_end = (right[:, :2] == right[:, 2:]).all(axis=1)
    ends = np.where(left_is_end[:, None], left[:, :2], right[:, :2])
    across = np.where(left_is_end[:, None], right, left)
    segments = np.stack([ends, feet(ends, across)], axis=1)
    misses = missed_shares(segments, diagram)
    misses[~(left_is_end | right_is_end)] = np.inf
    minimal = misses <= SLACK
    narrow = without_twins(welded(segments[minimal], across[minimal]))
    shallow = (misses <= SHALLOW) & ~minimal
    mouths = without_twins(welded(segments[shallow], across[shallow]))
    clear = without_crossing(mouths, diagram.segments, narrow)
    chords = np.concatenate([narrow, clear])
    return Chords(chords, widths_of(chords))


def widths_of(segments: Array) -> Array:
    """Measure chords (n, 2, 2) from wall to wall."""
    across = segments[:, 1] - segments[:, 0]
    return np.asarray(np.hypot(across[:, 0], across[:, 1]))


def missed_shares(segments: Array, diagram: VoronoiDiagram) -> Array:
    """Tell how far the middle of each chord (k, 2, 2) lies off its Voronoi edge, in widths of the chord."""
    across = segments[:, 1] - segments[:, 0]
    along = np.column_stack([-across[:, 1], across[:, 0]])
    middle = segments.mean(axis=1)
    ends = [np.einsum("ij,ij->i", diagram.vertices[k] - middle, along) for k in diagram.edges.T]
    beyond = np.maximum(np.minimum(*ends), -np.maximum(*ends))
    square = widths_of(segments) ** 2
    return np.asarray(np.where(square > 0.0, beyond / np.where(square > 0.0, square, 1.0), np.inf))


def welded(segments: Array, walls: Array) -> Array:
    """Let a chord that ends beside an end of its wall (n, 4) end there."""
    moved = segments.copy()
    slack = SLACK * widths_of(segments)
    for end in (walls[:, :2], walls[:, 2:]):
        gap = np.hypot(*(end - segments[:, 1]).T)
        moved[gap <= slack, 1] = end[gap <= slack]
    return moved


def without_twins(segments: Array) -> Array:
    """Leave out chords that join the same two points as another."""
    swapped = (segments[:, 0, 0] > segments[:, 1, 0]) | (
        (segments[:, 0, 0] == segments[:, 1, 0]) & (segments[:, 0, 1] > segments[:, 1, 1])
    )
    ordered = np.where(swapped[:, None, None], segments[:, ::-1], segments)
    return np.asarray(np.unique(ordered.reshape(-1, 4), axis=0).reshape(-1, 2, 2))


def without_crossing(segments: Array, walls: Array, chords: Array) -> Array:
    """Leave out segments that touch a wall between their ends, or cross a chord or a shorter one of them."""
    inner = segments + BEHIND_WALLS * (segments[:, ::-1] - segments)
    lines = shapely.linestrings(inner)
    obstacles = shapely.linestrings(np.concatenate([walls.reshape(-1, 2, 2), chords]))
    blocked = np.zeros(len(lines), dtype=bool)
    blocked[shapely.STRtree(obstacles).query(lines, predicate="intersects")[0]] = True
    free = np.flatnonzero(~blocked)
    order = free[np.argsort(widths_of(segments[free]), kind="stable")]
    kept: list[int] = []
    first, second = shapely.STRtree(lines[order]).query(lines[order], predicate="intersects")
    crossed: NDArray[np.bool_] = np.zeros(len(order), dtype=bool)
    for rank in range(len(order)):
        if not crossed[rank]:
            kept.append(int(order[rank]))
            crossed[second[first == rank]] = True
    return segments[sorted(kept)]


def find_jambs(openings: Array, walls: Array, depth: float = JAMB_DEPTH) -> Array:
    """Measure how far free space widens beside each opening (n, 2, 2), in its widths, (n,) (section 4.1).

    It is measured parallel to the opening on both sides, so many of its widths away, of which the narrower
    counts: 1 in the midst of a corridor and at its mouth, more at a door.
    """
    if len(openings) == 0:
        return np.empty(0)
    along = openings[:, 1] - openings[:, 0]
    across = np.column_stack([-along[:, 1], along[:, 0]])
    middle = openings.mean(axis=1)
    lines = shapely.linestrings(walls.reshape(-1, 2, 2))
    tree = shapely.STRtree(lines)
    sides = []
    for side in (depth, -depth):
        start = middle + side * across
        sides.append(free_distance(start, along, tree, lines) + free_distance(start, -along, tree, lines))
    return np.asarray(np.minimum(sides[0], sides[1]))


def free_distance(start: Array, along: Array, tree: shapely.STRtree, walls: NDArray[np.object_]) -> Array:
    """Measure how far one sees from each point (n, 2) along (n, 2), in lengths of that, (n,)."""
    rays = shapely.linestrings(np.stack([start, start + JAMB_REACH * along], axis=1))
    ray, wall = tree.query(rays, predicate="intersects")
    hits = shapely.distance(shapely.points(start[ray]), shapely.intersection(rays[ray], walls[wall]))
    nearest = np.full(len(start), JAMB_REACH)
    np.minimum.at(nearest, ray, hits / np.hypot(along[ray, 0], along[ray, 1]))
    return nearest
