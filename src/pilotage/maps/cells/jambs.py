"""See how free space widens beside an opening: a door has jambs, the cut of a corridor has none."""

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array

DEPTH = 0.2
"""How far beside an opening to look, in its widths."""

FARTHEST = 2.0
"""How far to either hand to look, in its widths: wider is wide enough."""


def find_jambs(openings: Array, walls: Array) -> Array:
    """Measure free space parallel to each opening (n, 2, 2), a little beside it, in its widths, (n,).

    Of both sides the narrower counts: 1 in the midst of a corridor and at its mouth, more at a door.
    """
    if len(openings) == 0:
        return np.empty(0)
    along = openings[:, 1] - openings[:, 0]
    across = np.column_stack([-along[:, 1], along[:, 0]])
    middle = openings.mean(axis=1)
    lines = shapely.linestrings(walls.reshape(-1, 2, 2))
    tree = shapely.STRtree(lines)
    sides = []
    for depth in (DEPTH, -DEPTH):
        start = middle + depth * across
        sides.append(reach(start, along, tree, lines) + reach(start, -along, tree, lines))
    return np.asarray(np.minimum(sides[0], sides[1]))


def reach(start: Array, along: Array, tree: shapely.STRtree, walls: NDArray[np.object_]) -> Array:
    """Measure how far one sees from each point (n, 2) along (n, 2), in lengths of that, (n,)."""
    rays = shapely.linestrings(np.stack([start, start + FARTHEST * along], axis=1))
    ray, wall = tree.query(rays, predicate="intersects")
    hits = shapely.distance(shapely.points(start[ray]), shapely.intersection(rays[ray], walls[wall]))
    nearest = np.full(len(start), FARTHEST)
    np.minimum.at(nearest, ray, hits / np.hypot(along[ray, 0], along[ray, 1]))
    return nearest
