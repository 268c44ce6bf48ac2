"""Fill outlines by the rule of nonzero winding, where it fills more than the even-odd rule of all others."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array, Polyline, signed_area
from pilotage.interpretation.paint import parts_of

MOST = 2_000_000
"""Sides times faces that are tried; a drawing as dense as that is filled by the even-odd rule."""


def filled_twice(outlines: Sequence[Polyline]) -> tuple[Polyline, ...] | None:
    """Return the borders of what outlines fill by nonzero winding; None if the even-odd rule fills the same.

    Lines that were turned into areas overlap at corners and where rooms meet: even-odd, these are holes.
    """
    rings = [outline for outline in outlines if len(outline.vertices) > 2]
    if not may_overlap(rings):
        return None
    sides = np.concatenate([np.stack([r.vertices, np.roll(r.vertices, -1, axis=0)], axis=1) for r in rings])
    noded = shapely.union_all(shapely.linestrings(sides))
    faces = parts_of(shapely.polygonize(parts_of(noded)))
    if len(faces) * len(sides) > MOST:
        return None
    points = shapely.get_coordinates(shapely.point_on_surface(faces))
    turns = np.array([winding(sides, point) for point in points], dtype=np.intp)
    if not ((turns != 0) & (turns % 2 == 0)).any():
        return None
    filled = parts_of(shapely.union_all(faces[turns != 0]))
    borders = [ring for part in filled for ring in (part.exterior, *part.interiors)]
    return tuple(Polyline(shapely.get_coordinates(ring)[:-1], closed=True) for ring in borders)


def may_overlap(rings: Sequence[Polyline]) -> bool:
    """Tell whether the boxes of two outlines overlap that run the same way round: a hole runs the other."""
    if len(rings) < 2:
        return False
    boxes = shapely.box(*np.array([[*r.vertices.min(axis=0), *r.vertices.max(axis=0)] for r in rings]).T)
    ways: NDArray[np.bool_] = np.array([signed_area(ring.vertices) > 0.0 for ring in rings])
    first, second = shapely.STRtree(boxes).query(boxes, predicate="intersects")
    return bool(((first < second) & (ways[first] == ways[second])).any())


def winding(sides: Array, point: Array) -> int:
    """Count how often sides (n, 2, 2) run around a point (2,), counter-clockwise."""
    (ax, ay), (bx, by) = sides[:, 0].T, sides[:, 1].T
    x, y = point
    left = (bx - ax) * (y - ay) - (x - ax) * (by - ay)
    upward, downward = (ay <= y) & (by > y) & (left > 0.0), (ay > y) & (by <= y) & (left < 0.0)
    return int(upward.sum()) - int(downward.sum())
