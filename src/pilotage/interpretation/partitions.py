"""Find walls without thickness beside those that have one: lines that part rooms."""

from collections.abc import Sequence

import shapely

from pilotage.interpretation.doors import Door
from pilotage.interpretation.paint import NOTHING, parts_of

ROOM_AREA = 4.0
"""What a thin wall parts is a room if it has so much area, in squares over a door's width; a bed has less."""

ROOM_WIDTH = 1.0
"""And if it is nowhere narrower than this many widths of a door, but for corners; a counter is."""

TOUCHING = 0.05
"""A line ends at a wall if it comes as near as this share of a door's width."""


def find_partitions(
    lines: shapely.Geometry, solid: shapely.Geometry, doors: Sequence[Door], width: float
) -> shapely.Geometry:
    """Find lines outside solids that part one room from the next."""
    body = shapely.buffer(solid, TOUCHING * width, join_style="mitre")
    loose = shapely.difference(lines, body)
    if loose.is_empty:
        return NOTHING
    closing = [shapely.LineString([door.hinge, door.latch]) for door in doors]
    noded = shapely.union_all([loose, shapely.boundary(body), *closing], grid_size=TOUCHING * width / 4.0)
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
    large = faces[shapely.area(faces) >= ROOM_AREA * width**2]  # first: most faces are pieces of furniture
    inner = ~shapely.contains(body, shapely.point_on_surface(large))
    narrow = shapely.is_empty(shapely.buffer(large, -ROOM_WIDTH * width / 2.0))
    rooms = large[inner & ~narrow]
    if len(rooms) < 2:
        return NOTHING
    borders = shapely.boundary(rooms)
    tree = shapely.STRtree(rooms)
    first, second = tree.query(rooms, predicate="intersects")
    common = [
        shapely.intersection(borders[a], borders[b]) for a, b in zip(first, second, strict=True) if a < b
    ]
    shared = shapely.buffer(shapely.union_all(common), TOUCHING * width / 4.0) if common else NOTHING
    kept = [part for part in parts_of(shapely.intersection(loose, shared)) if part.length > TOUCHING * width]
    return shapely.multilinestrings(kept) if kept else NOTHING
