"""Outlines of the shapes of an SVG document, in the coordinates of its root."""

from collections.abc import Iterator

import svgelements

from pilotage.interpretation.paper import holds
from pilotage.io.svg.style import local_name
from pilotage.io.svg.tree import Drawn

FLATNESS = 0.0005
"""How far a chord may stray from its curve, as a share of the drawing's diagonal: 2 cm in a 40 m building."""

SHAPES = {
    "path": svgelements.Path,
    "rect": svgelements.Rect,
    "circle": svgelements.Circle,
    "ellipse": svgelements.Ellipse,
    "line": svgelements.SimpleLine,
    "polyline": svgelements.Polyline,
    "polygon": svgelements.Polygon,
}

SIZES = {
    svgelements.Rect: ("width", "height"),
    svgelements.Circle: ("r",),
    svgelements.Ellipse: ("rx", "ry"),
}
"""Measures that must be positive for anything to be seen."""

Bounds = tuple[float, float, float, float]  # left, top, right, bottom


def outline_of(item: Drawn) -> Iterator[svgelements.Path]:
    """Carry the outline of a shape to the root's coordinates; texts, and shapes of no size, give none."""
    kind = SHAPES.get(local_name(item.element.tag))
    if kind is None:
        return
    measures = dict(item.measures)
    measures.pop("transform", None)
    if any(float(measures.get(name, "0")) <= 0.0 for name in SIZES.get(kind, ())):
        return
    if kind is svgelements.Path:
        outline = svgelements.Path(measures.get("d", ""))
    else:
        shape = kind(measures)
        if shape.is_degenerate():
            return
        outline = svgelements.Path(shape)
    outline = (outline * item.page_from_element).reify()
    if len(outline) >= 2:
        yield outline


def bounds_of(outline: svgelements.Path) -> Bounds:
    """Return left, top, right and bottom of an outline; a curve within its ends' box needs no search."""
    boxes = [box_of(segment) for segment in outline]
    lefts, tops, rights, bottoms = zip(*boxes, strict=True)
    return min(lefts), min(tops), max(rights), max(bottoms)


def box_of(segment: svgelements.PathSegment) -> Bounds:
    """Return left, top, right and bottom of a part of an outline."""
    if isinstance(segment, svgelements.QuadraticBezier | svgelements.CubicBezier):
        x, y = ([point[axis] for point in segment] for axis in (0, 1))
        ends = min(x[0], x[-1]), min(y[0], y[-1]), max(x[0], x[-1]), max(y[0], y[-1])
        if holds(ends, (min(x), min(y), max(x), max(y))):
            return ends
    box: Bounds = segment.bbox()
    return box
