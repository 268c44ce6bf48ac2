"""Cut what is drawn to what its clip leaves of it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from pilotage.geometry import Array, Polyline
from pilotage.interpretation.sheet import Bounds, Color, Pen
from pilotage.io.sheet_builder import outline_through, outlines_of_area


def area_of(rings: Sequence[Array]) -> shapely.Geometry:
    """Return the area of rings (n, 2) by the even-odd rule."""
    area: shapely.Geometry = shapely.Polygon()
    for ring in rings:
        if len(ring) > 2:
            area = shapely.symmetric_difference(area, shapely.make_valid(shapely.Polygon(ring)))
    return area


@dataclass(frozen=True, eq=False)
class Clip:
    """What shapes are cut to."""

    area: shapely.Geometry

    @cached_property
    def box(self) -> Bounds | None:
        """Left, bottom, right and top if it is a rectangle along the axes."""
        if self.area.is_empty:
            return None
        left, bottom, right, top = shapely.bounds(self.area).tolist()
        is_box = self.area.area >= 0.999 * (right - left) * (top - bottom)
        return (left, bottom, right, top) if is_box else None

    def leaves_whole(self, outlines: Sequence[Polyline]) -> bool:
        """Tell whether a shape with these outlines stays whole, if that is plain to see."""
        if self.box is None:
            return False
        left, bottom, right, top = self.box
        points = np.vstack([outline.vertices for outline in outlines])
        (x0, y0), (x1, y1) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        return bool(left <= x0 and bottom <= y0 and x1 <= right and y1 <= top)

    def cut_box(self, bounds: Bounds) -> Bounds | None:
        """Return the part of a box in the box around this; None if they have nothing in common."""
        if self.area.is_empty:
            return None
        own = shapely.bounds(self.area).tolist()
        left, low, right, high = *map(max, bounds[:2], own[:2]), *map(min, bounds[2:], own[2:])
        return (left, low, right, high) if left <= right and low <= high else None


Part = tuple[Sequence[Polyline], Pen | None, Color | None]
"""Outlines, and how they are drawn and filled."""


def cut(outlines: Sequence[Polyline], pen: Pen | None, fill: Color | None, clip: Clip) -> Iterator[Part]:
    """Yield what a clip leaves of a shape: its area, then its line, for the cut has none."""
    if fill is not None:
        yield clipped_area(outlines, clip.area), None, fill
    if pen is not None:
        yield clipped_lines(outlines, clip.area, pen.width), pen, None


def clipped_lines(outlines: Sequence[Polyline], clip: shapely.Geometry, width: float) -> list[Polyline]:
    """Return the parts of lines of a width inside a clip, or so near along its border that some is seen."""
    lines = shapely.multilinestrings([shapely.LineString(outline.ring) for outline in outlines])
    inside = shapely.intersection(lines, clip)
    border = shapely.intersection(lines, shapely.buffer(clip, width / 2.0, join_style="mitre"))
    beside = shapely.get_parts(shapely.line_merge(shapely.difference(border, clip)))
    along = shapely.multilinestrings(beside[shapely.length(beside) > width])
    parts = shapely.get_parts(shapely.line_merge(shapely.union(inside, along)))
    found = [outline_through(shapely.get_coordinates(part)) for part in parts if part.length > 0.0]
    return [outline for outline in found if outline is not None]


def clipped_area(outlines: Sequence[Polyline], clip: shapely.Geometry) -> list[Polyline]:
    """Return the rings of the part of an area inside a clip."""
    area = area_of([outline.vertices for outline in outlines])
    return outlines_of_area(shapely.intersection(area, clip))
