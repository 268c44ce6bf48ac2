"""Tell windows from furniture and from doors that are drawn shut, between painted walls."""

import shapely

from pilotage.interpretation.paint import parts_of
from pilotage.interpretation.solids import COARSE, HAIR, extent


def without_slivers(solid: shapely.Geometry, width: float) -> shapely.Geometry:
    """Leave out what is thinner than a width: leaves of doors that are painted like walls."""
    inner = shapely.buffer(solid, -width / 2.0, join_style="mitre")
    return shapely.intersection(shapely.buffer(inner, 0.51 * width, join_style="mitre"), solid)


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


def building(walls: shapely.Geometry, gap: float) -> shapely.Geometry:
    """Return all that lies within the outer walls, openings up to a gap wide closed."""
    coarse = shapely.simplify(parts_of(walls), COARSE * gap)
    grown = shapely.buffer(coarse, gap / 2.0, quad_segs=2)
    outlines = [shapely.Polygon(part.exterior) for part in parts_of(shapely.union_all(grown))]
    return shapely.buffer(shapely.union_all(outlines), -gap / 2.0, join_style="mitre")
