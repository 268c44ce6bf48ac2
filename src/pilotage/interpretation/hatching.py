"""Find doors that are drawn shut in walls of two faces: as a frame over the wall, or its hatching pauses."""

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Polyline
from pilotage.interpretation.paint import NOTHING, parts_of
from pilotage.interpretation.windows import building

SHORT = 3.0
"""Lines of hatching leave pieces no longer than so many thicknesses of a wall."""

EVEN = 2.0
"""Hatching runs from face to face: most pieces are as wide as others, within this factor."""

PAUSE = 2.0
"""Where hatching pauses a piece is so many times as long as others."""

MOST = 0.75
"""A piece is one of a wall if so much of it lies within, as a share."""

ELONGATED = 2.0
"""A frame over a wall is at least so many times as wide as the wall is thick: a column is not."""

BEYOND = (0.25, 2.0)
"""The wall goes on beyond its ends, from and to so many thicknesses, and no wall crosses it there."""

FULL = 0.9
"""A frame fills so much of its bounds, as a share: it is a rectangle."""

NODED = 1 / 16
"""Lines meet where they come nearer than this share of a wall's thickness."""


def shut_doors(
    lines: shapely.Geometry, walls: shapely.Geometry, thickness: float, widest: float
) -> shapely.Geometry:
    """Return what in hatched walls is not hatched, no wider than a door, and has rooms on both sides.

    In walls that are not hatched, all that lies between two faces is one long piece, and a frame that is
    laid over it is a door.
    """
    noded = shapely.union_all([lines], grid_size=NODED * thickness)
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
    area, half = shapely.area(faces), shapely.length(faces) / 2.0
    length = half / 2.0 + np.sqrt(np.maximum(half**2 / 4.0 - area, 0.0))  # of a rectangle alike
    between = shapely.area(shapely.intersection(faces, walls)) > MOST * area
    short = between & (length < SHORT * thickness)
    within = shapely.buffer(building(shapely.union_all([walls, *faces]), widest), -thickness)
    shapely.prepare(within)
    if area[short].sum() <= area[between].sum() / 2.0:
        return laid_over(faces[between & (length < widest) & within.contains(faces)], noded, walls)
    width = area / length
    thin, thick = np.percentile(width[short], [25, 75])
    if thick > EVEN * thin:
        return NOTHING
    pausing = between & (length > max(PAUSE * np.median(length[short]), thickness)) & (length < widest)
    pausing &= width > thin / EVEN
    return shapely.union_all(faces[pausing & shapely.contains(within, faces)])


def laid_over(
    frames: NDArray[np.object_], lines: shapely.Geometry, walls: shapely.Geometry
) -> shapely.Geometry:
    """Keep rectangles, of one piece or several, that are in one wall with what lies beyond both ends."""
    shapely.prepare(lines)
    shapely.prepare(walls)
    found = []
    for part in parts_of(shapely.union_all(frames)):
        corners = shapely.get_coordinates(shapely.oriented_envelope(part))
        if len(corners) != 5:
            continue
        sides = np.diff(corners, axis=0)[:2]
        sides = sides[np.argsort(-np.hypot(*sides.T))]
        length, width = np.hypot(*sides.T)
        if length < ELONGATED * width or part.area < FULL * length * width:
            continue
        middle, along = corners[:4].mean(axis=0), sides[0] / length
        near, far = (length / 2.0 + share * width for share in BEYOND)
        beyond = shapely.linestrings(middle + np.array([[[-far], [-near]], [[near], [far]]]) * along)
        if walls.contains(beyond).all() and not lines.intersects(beyond).any():
            found.append(part)
    return shapely.union_all(found)


def opened_shut(shut: shapely.Geometry) -> tuple[Polyline, ...]:
    """Return the openings that are drawn shut, from jamb to jamb."""
    boxes = [shapely.get_coordinates(shapely.oriented_envelope(part)) for part in parts_of(shut)]
    doors = []
    for box in boxes:
        if len(box) == 5:
            middles = (box[:-1] + box[1:]) / 2.0  # of the sides
            across = np.hypot(*(middles[:2] - middles[2:]).T)
            doors.append(Polyline(middles[0::2] if across[0] > across[1] else middles[1::2]))
    return tuple(doors)
