"""Tell windows from furniture and from doors that are drawn shut, between painted walls."""

import numpy as np
import shapely

from pilotage.interpretation.paint import NOTHING, parts_of
from pilotage.interpretation.solids import HAIR, extent


def without_slivers(solid: shapely.Geometry, width: float) -> shapely.Geometry:
    """Leave out what is thinner than a width: leaves of doors that are painted like walls."""
    inner = shapely.buffer(solid, -width / 2.0, join_style="mitre")
    return shapely.intersection(shapely.buffer(inner, 0.51 * width, join_style="mitre"), solid)


def windows(
    filled: shapely.Geometry, solid: shapely.Geometry, thickness: float, widest: float
) -> shapely.Geometry:
    """Keep what leads from wall to wall, is as thin, and has a room on one side only.

    What has rooms on both sides is a door that is drawn shut, if it is not wider than any, and what stands at
    a wall is furniture.
    """
    hair = HAIR * thickness
    reach, grown = (shapely.buffer(solid, share * hair, join_style="mitre") for share in (1.0, 2.0))
    bridges = []
    for part in parts_of(shapely.difference(filled, reach)):
        if part.geom_type == "Polygon" and part.area <= thickness * part.length / 2.0:
            contact = shapely.line_merge(shapely.intersection(shapely.boundary(part), grown))
            if shapely.get_num_geometries(contact) > 1:
                bridges.append(shapely.buffer(part, 2.0 * hair, join_style="mitre"))
    rooms = [
        shapely.Polygon(ring)
        for part in parts_of(shapely.union_all([solid, *bridges]))
        if part.geom_type == "Polygon"
        for ring in part.interiors
    ]
    if not (rooms and bridges):
        return NOTHING
    owners, _ = shapely.STRtree(rooms).query(bridges, predicate="dwithin", distance=hair)
    beside = np.bincount(owners, minlength=len(bridges))
    return shapely.union_all(
        [part for part, count in zip(bridges, beside, strict=True) if count < 2 or extent(part) > widest]
    )
