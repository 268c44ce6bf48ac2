"""Find walls without thickness beside those that have one: lines that part rooms."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.interpretation.paint import NOTHING, parts_of
from pilotage.interpretation.pieces import on_grid, straight

ROOM_AREA = 4.0
"""What a thin wall parts is a room if it has so much area, in squares over a door's width; a bed has less."""

ISLAND_AREA = 16.0
"""What stands free amid a room and has no door is one only if it has so much: a table for twenty has less."""

ROOM_WIDTH = 1.0
"""And if it is nowhere narrower than this many widths of a door, but for corners; a counter is."""

TOUCHING = 0.05
"""A line ends at a wall if it comes as near as this share of a door's width."""


def find_partitions(
    lines: shapely.Geometry, solid: shapely.Geometry, closing: Sequence[shapely.LineString], width: float
) -> shapely.Geometry:
    """Find lines outside solids that part one room from the next; doors are `closing`, from jamb to jamb.

    These are wider than the grid is fine: an arc tells a jamb less exactly than a wall is drawn.
    """
    body = shapely.make_valid(shapely.buffer(solid, TOUCHING * width, join_style="mitre"))
    loose = outside(lines, body)
    if loose.is_empty:
        return NOTHING
    grain = TOUCHING * width / 4.0
    across = [shapely.boundary(shapely.buffer(line, 2.0 * grain, cap_style="square")) for line in closing]
    pieces = on_grid(straight(np.array([loose, shapely.boundary(body), *across])), grain)
    noded = shapely.union_all(shapely.multilinestrings(shapely.linestrings(pieces)), grid_size=grain)
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
    large = faces[shapely.area(faces) >= ROOM_AREA * width**2]  # first: most faces are pieces of furniture
    inner = ~shapely.contains(body, shapely.point_on_surface(large))
    narrow = shapely.is_empty(shapely.buffer(large, -ROOM_WIDTH * width / 2.0))
    rooms = large[inner & ~narrow]
    held = standing(rooms, np.array([body, *closing]), 2.0 * grain)
    rooms = rooms[held | (shapely.area(rooms) >= ISLAND_AREA * width**2)]
    if len(rooms) < 2:
        return NOTHING
    borders = shapely.buffer(shapely.boundary(rooms), grain)
    first, second = shapely.STRtree(rooms).query(rooms, predicate="dwithin", distance=2.0 * grain)
    pairs = first < second
    shared = shapely.union_all(shapely.intersection(borders[first[pairs]], borders[second[pairs]]))
    kept = [part for part in parts_of(shapely.intersection(loose, shared)) if part.length > TOUCHING * width]
    return shapely.multilinestrings(kept) if kept else NOTHING


def standing(rooms: NDArray[np.object_], held: NDArray[np.object_], reach: float) -> NDArray[np.bool_]:
    """Tell which rooms, (n,), stand at a wall or at a door, or at another room that does."""
    outlines = shapely.buffer(shapely.get_exterior_ring(rooms), reach)
    groups = parts_of(shapely.union_all(outlines))
    groups = groups[shapely.intersects(groups, shapely.union_all(held))]
    return np.asarray(shapely.intersects(outlines, shapely.union_all(groups)))


def outside(lines: shapely.Geometry, body: shapely.Geometry) -> shapely.Geometry:
    """Return what of lines lies outside a body; only the lines that cross its border are cut."""
    parts = parts_of(lines)
    shapely.prepare(body)
    cut = shapely.intersects(body, parts)
    parts[cut] = shapely.difference(parts[cut], body)
    left = [part for part in parts_of(parts) if not part.is_empty]
    return shapely.multilinestrings(left) if left else NOTHING
