"""The areas to which an SVG document cuts what it draws."""

import math

import shapely
import svgelements

from pilotage.io.clip import Clip, area_of
from pilotage.io.svg.flatten import flatten
from pilotage.io.svg.outlines import FLATNESS, bounds_of, outline_of
from pilotage.io.svg.tree import ClipUse, Document, Drawn

ROUNDING = 1e-6
"""Relative error that transforms may leave in an area."""


class Clips:
    """The areas to which a document cuts what it draws; each is found once."""

    def __init__(self, document: Document) -> None:
        """Begin with none."""
        page = document.page
        self.page = None if page is None else shapely.box(*page.bounds)
        self.document = document
        self.areas: dict[tuple[str, str], shapely.Geometry | None] = {}
        self.clips: dict[tuple[tuple[str, str], ...], Clip | None] = {}

    def clip_of(self, item: Drawn) -> Clip | None:
        """Return what is left of a shape by all that cuts it; None if nothing does."""
        key = tuple((name, str(matrix)) for name, matrix in item.clips)
        if key not in self.clips:
            found = [area for use in item.clips if (area := self.area_of(use)) is not None]
            self.clips[key] = Clip(shapely.intersection_all(found)) if found else None
        return self.clips[key]

    def area_of(self, use: ClipUse) -> shapely.Geometry | None:
        """Return the area of a `clipPath`; None if it has no shape that can be read, or is the page.

        What is drawn beside the page is read as well, for pages are often too small.
        """
        key = (use[0], str(use[1]))
        if key not in self.areas:
            outlines = [outline for item in self.document.walk_clip(use) for outline in outline_of(item)]
            area = shapely.union_all([enclosed_by(outline) for outline in outlines])
            is_page = self.page is not None and area.buffer(ROUNDING * self.page.length).covers(self.page)
            self.areas[key] = None if not outlines or is_page else area
        return self.areas[key]


def enclosed_by(outline: svgelements.Path) -> shapely.Geometry:
    """Return the area that an outline encloses."""
    left, top, right, bottom = bounds_of(outline)
    tolerance = FLATNESS * math.hypot(right - left, bottom - top)
    return area_of([line.vertices for line in flatten(outline, tolerance)] if tolerance > 0.0 else [])
