"""Find doors that are drawn shut in hatched walls: there the hatching pauses."""

import numpy as np
import shapely

from pilotage.interpretation.paint import NOTHING
from pilotage.interpretation.windows import building

SHORT = 3.0
"""Lines of hatching leave pieces no longer than so many thicknesses of a wall."""

EVEN = 2.0
"""Hatching runs from face to face: most pieces are as wide as others, within this factor."""

PAUSE = 2.0
"""Where hatching pauses a piece is so many times as long as others."""

MOST = 0.75
"""A piece is one of a wall if so much of it lies within, as a share."""

NODED = 1 / 16
"""Lines meet where they come nearer than this share of a wall's thickness."""


def shut_doors(
    lines: shapely.Geometry, walls: shapely.Geometry, thickness: float, widest: float
) -> shapely.Geometry:
    """Return what in hatched walls is not hatched, no wider than a door, and has rooms on both sides.

    Nothing where walls are not hatched: all that lies between two faces is one long piece then.
    """
    noded = shapely.union_all([lines], grid_size=NODED * thickness)
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
    area, half = shapely.area(faces), shapely.length(faces) / 2.0
    length = half / 2.0 + np.sqrt(np.maximum(half**2 / 4.0 - area, 0.0))  # of a rectangle alike
    between = shapely.area(shapely.intersection(faces, walls)) > MOST * area
    short = between & (length < SHORT * thickness)
    if area[short].sum() <= area[between].sum() / 2.0:
        return NOTHING
    width = area / length
    thin, thick = np.percentile(width[short], [25, 75])
    if thick > EVEN * thin:
        return NOTHING
    pausing = between & (length > max(PAUSE * np.median(length[short]), thickness)) & (length < widest)
    pausing &= width > thin / EVEN
    within = shapely.buffer(building(shapely.union_all([walls, *faces]), widest), -thickness)
    shapely.prepare(within)
    return shapely.union_all(faces[pausing & shapely.contains(within, faces)])
