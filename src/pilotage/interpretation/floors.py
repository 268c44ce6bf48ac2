"""Find where painted floors end: a walk along a building, or a wide opening, has no other border."""

from collections.abc import Sequence

import shapely

from pilotage.interpretation.paint import NOTHING, areas_of, parts_of
from pilotage.interpretation.paper import SAME, difference
from pilotage.interpretation.sheet import Color, Mark
from pilotage.interpretation.solids import lightness

PALE = 0.4
"""A fill that differs less than this from the ground in lightness is a floor if it has no line around it."""

CARRIED = 0.9
"""Floors are those of the building if so much of the walls that touch them stands on them, as a share."""

MOST = 0.5
"""And if they touch so much of all walls: what stands beside is a symbol, or another building."""

SITE = 2.0
"""What is painted below a building is a site, no floor, if it is so many times as large as its hull."""

BESIDE = 0.5
"""An edge this near to a wall, in thicknesses, is the wall."""


def floor_edges(
    floors: shapely.Geometry, walls: shapely.Geometry, thickness: float, gap: float
) -> shapely.Geometry:
    """Return the edges of the floors that walls stand on, where there is no wall over more than a gap."""
    if floors.is_empty or walls.is_empty:
        return NOTHING
    reached = shapely.buffer(floors, thickness, join_style="mitre")
    parts = parts_of(walls)
    touching = shapely.area(parts[shapely.intersects(parts, floors)]).sum()
    carried = shapely.intersection(walls, reached).area
    if carried < CARRIED * touching or touching < MOST * walls.area:
        return NOTHING
    paved = shapely.buffer(shapely.union(floors, walls), thickness, join_style="mitre")
    paved = shapely.buffer(paved, -thickness, join_style="mitre")
    paved = shapely.union_all(
        [part for part in parts_of(paved) if shapely.intersection(part, walls).area > 0.0]
    )
    if paved.area > SITE * shapely.convex_hull(walls).area:
        return NOTHING
    body = shapely.buffer(walls, BESIDE * thickness, join_style="mitre")
    edges = parts_of(shapely.line_merge(shapely.difference(shapely.boundary(paved), walls)))
    open_ = edges[shapely.length(shapely.difference(edges, body)) > gap]
    return shapely.multilinestrings(open_) if len(open_) else NOTHING


def find_floors(marks: Sequence[Mark], ground: Color) -> shapely.Geometry:
    """Return all that is painted in the colors of floors, also so faintly that it erases what lies below."""
    floors = [
        mark
        for mark in marks
        if mark.fill is not None and is_floor(mark.fill, ground) and difference(mark.fill, ground) >= SAME
    ]
    return shapely.union_all(areas_of(floors))


def is_floor(color: Color, ground: Color) -> bool:
    """Tell whether a fill without a line is the color of a floor."""
    return abs(lightness(color) - lightness(ground)) < PALE
