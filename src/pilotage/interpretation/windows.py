"""Tell windows from furniture and from doors that are drawn shut, between painted walls."""

import shapely

from pilotage.interpretation.paint import parts_of
from pilotage.interpretation.pieces import joined, straight
from pilotage.interpretation.sheet import Color
from pilotage.interpretation.solids import COARSE, HAIR, SLENDER, extent, lightness, measured_walls

PANES = 3
"""A window is drawn with so many lines or more from jamb to jamb: faces of its wall, and panes between."""

LIGHT, BLUE = 0.6, 0.15
"""Glass is painted in a color at least so light, and with so much less red than blue, 0 to 1."""

DEEP = 1.2
"""They lie within so many thicknesses of a wall."""


def without_slivers(solid: shapely.Geometry, width: float) -> shapely.Geometry:
    """Leave out what is thinner than a width: leaves of doors that are painted like walls."""
    inner = shapely.buffer(solid, -width / 2.0, join_style="mitre")
    left = parts_of(shapely.intersection(shapely.buffer(inner, 0.51 * width, join_style="mitre"), solid))
    return shapely.multipolygons(left[shapely.get_dimensions(left) == 2])  # where both touch there are lines


def windows(
    filled: shapely.Geometry,
    solid: shapely.Geometry,
    glass: shapely.Geometry,
    thickness: float,
    widest: float,
) -> tuple[shapely.Geometry, shapely.Geometry]:
    """Tell windows from doors that are drawn shut, in this order, among what lies between solids.

    Both lead from wall to wall and are as thin. A window has the outside on one side, or is named so: then it
    touches the `glass`. What has rooms on both sides is a door, if it is not wider than any, and what stands
    at a wall is furniture.
    """
    hair = HAIR * thickness
    reach, grown = (shapely.buffer(solid, share * hair, join_style="mitre") for share in (1.0, 2.0))
    bridges, named = [], []
    shapely.prepare(glass)
    for part in parts_of(shapely.difference(filled, reach)):
        if part.geom_type != "Polygon":
            continue
        if glass.intersects(part):
            named.append(shapely.buffer(part, 2.0 * hair, join_style="mitre"))
        elif part.area <= thickness * part.length / 2.0:
            contact = shapely.line_merge(shapely.intersection(shapely.boundary(part), grown))
            if shapely.get_num_geometries(contact) > 1:
                bridges.append(shapely.buffer(part, 2.0 * hair, join_style="mitre"))
    within = shapely.buffer(building(shapely.union_all([solid, *named, *bridges]), widest), -thickness)
    shapely.prepare(within)
    are_doors = [extent(part) <= widest and within.contains(part) for part in bridges]
    doors, glazed = (
        [part for part, is_door in zip(bridges, are_doors, strict=True) if is_door is kind]
        for kind in (True, False)
    )
    return shapely.union_all([*glazed, *named]), shapely.union_all(doors)


def is_glass(area: shapely.Geometry, color: Color) -> bool:
    """Tell whether a fill without a line is painted as a window: light blue, long and narrow."""
    length, thick = measured_walls(area)
    is_blue = color[2] - color[0] >= BLUE and lightness(color) >= LIGHT
    return is_blue and bool((length > SLENDER * thick).all())


def painted_glass(glass: shapely.Geometry, solid: shapely.Geometry, thickness: float) -> shapely.Geometry:
    """Return what of windows is painted over a wall, and narrow: it closes the wall again."""
    reach = shapely.buffer(solid, HAIR * thickness)
    shapely.prepare(reach)
    areas = [part for part in parts_of(glass) if part.geom_type == "Polygon" and reach.intersects(part)]
    return shapely.union_all([area for area in areas if area.area <= DEEP * thickness * area.length / 2.0])


def panes(
    lines: shapely.Geometry, solid: shapely.Geometry, thickness: float, widest: float
) -> shapely.Geometry:
    """Fill windows: three lines or more that lead from jamb to jamb, within the thickness of a wall."""
    hair = HAIR * thickness
    whole = shapely.linestrings(joined(straight(lines), hair))
    touching = whole[shapely.STRtree(whole).query(solid, predicate="intersects")]
    pieces = parts_of(shapely.difference(shapely.multilinestrings(touching), solid))
    reach = shapely.buffer(solid, hair)
    shapely.prepare(reach)
    from_jambs = shapely.intersects(reach, shapely.get_point(pieces, 0))
    from_jambs &= shapely.intersects(reach, shapely.get_point(pieces, -1))
    lengths = shapely.length(pieces)
    pieces = pieces[from_jambs & (lengths > thickness) & (lengths <= widest)]
    found = []
    for group in parts_of(shapely.union_all(shapely.buffer(pieces, thickness / 2.0, cap_style="flat"))):
        own = pieces[shapely.intersects(group, pieces)]
        window = shapely.convex_hull(shapely.multilinestrings(own))
        if len(own) >= PANES and window.area <= DEEP * thickness * shapely.length(own).max():
            found.append(shapely.buffer(window, 2.0 * hair, join_style="mitre"))
    return shapely.union_all(found)


def building(walls: shapely.Geometry, gap: float) -> shapely.Geometry:
    """Return all that lies within the outer walls, openings up to a gap wide closed."""
    coarse = shapely.simplify(parts_of(walls), COARSE * gap)
    grown = shapely.buffer(coarse, gap / 2.0, quad_segs=2)
    outlines = [shapely.Polygon(part.exterior) for part in parts_of(shapely.union_all(grown))]
    return shapely.buffer(shapely.union_all(outlines), -gap / 2.0, join_style="mitre")
