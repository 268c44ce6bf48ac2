"""Cut what is drawn to what its clip leaves of it."""

from collections.abc import Sequence

import shapely

from pilotage.geometry import Array, Polyline
from pilotage.io.sheet_builder import outline_through, outlines_of_area


def area_of(rings: Sequence[Array]) -> shapely.Geometry:
    """Return the area of rings (n, 2) by the even-odd rule."""
    area: shapely.Geometry = shapely.Polygon()
    for ring in rings:
        if len(ring) > 2:
            area = shapely.symmetric_difference(area, shapely.make_valid(shapely.Polygon(ring)))
    return area


def contains(clip: shapely.Geometry, points: Array) -> bool:
    """Tell whether a clip leaves a shape with these points (n, 2) whole, if that is plain to see."""
    if clip.is_empty:
        return False
    left, bottom, right, top = clip.bounds
    (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
    is_box = bool(clip.area >= 0.999 * (right - left) * (top - bottom))
    return is_box and bool(left <= x0 and bottom <= y0 and x1 <= right and y1 <= top)


def clipped_lines(outlines: Sequence[Polyline], clip: shapely.Geometry) -> list[Polyline]:
    """Return the parts of lines inside a clip."""
    lines = shapely.multilinestrings([shapely.LineString(outline.ring) for outline in outlines])
    parts = shapely.get_parts(shapely.line_merge(shapely.intersection(lines, clip)))
    found = [outline_through(shapely.get_coordinates(part)) for part in parts if part.length > 0.0]
    return [outline for outline in found if outline is not None]


def clipped_area(outlines: Sequence[Polyline], clip: shapely.Geometry) -> list[Polyline]:
    """Return the rings of the part of an area inside a clip."""
    area = area_of([outline.vertices for outline in outlines])
    return outlines_of_area(shapely.intersection(area, clip))
