"""Outlines of draw.io's shapes in a box of given size, y down, before it is turned."""

import math
from collections.abc import Callable, Mapping

import numpy as np

from pilotage.geometry import Affine2
from pilotage.io.curves import arc
from pilotage.io.drawio.cells import Box, number
from pilotage.io.drawio.floorplan import (
    LIBRARY,
    Figures,
    Style,
    area,
    box,
    dimension,
    floorplan_figures,
    line,
    strokes,
)

INVISIBLE = frozenset(("group", "none", "edgeLabel", "text"))
"""Shapes that are no more than what they hold; a text may have a border all the same."""

QUARTERS = {"east": 0, "south": 1, "west": 2, "north": 3}
"""Quarter turns, clockwise on the page."""


def ellipse(width: float, height: float, _style: Style) -> Figures:
    """Draw an ellipse."""
    return (area(arc((width / 2, height / 2), (width / 2, height / 2), 0.0, 2.0 * math.pi)),)


def rhombus(width: float, height: float, _style: Style) -> Figures:
    """Draw a rhombus."""
    return (area(line((width / 2, 0), (width, height / 2), (width / 2, height), (0, height / 2))),)


def triangle(width: float, height: float, _style: Style) -> Figures:
    """Draw a triangle that points right."""
    return (area(line((0, 0), (width, height / 2), (0, height))),)


def hexagon(width: float, height: float, _style: Style) -> Figures:
    """Draw a hexagon."""
    a = 0.25 * width
    left = [(a, 0.0), (width - a, 0.0), (width, height / 2)]
    return (area(line(*left, (width - a, height), (a, height), (0.0, height / 2))),)


def middle_line(width: float, height: float, _style: Style) -> Figures:
    """Draw a line across the middle."""
    return (strokes(line((0, height / 2), (width, height / 2))),)


def corner(width: float, height: float, style: Style) -> Figures:
    """Draw an L."""
    dx = min(number(style.get("dx", ""), 20.0), width)
    dy = min(number(style.get("dy", ""), 20.0), height)
    return (area(line((0, 0), (width, 0), (width, dy), (dx, dy), (dx, height), (0, height))),)


def tee(width: float, height: float, style: Style) -> Figures:
    """Draw a T."""
    dx = min(number(style.get("dx", ""), 20.0), width)
    dy = min(number(style.get("dy", ""), 20.0), height)
    left, right = (width - dx) / 2.0, (width + dx) / 2.0
    bar = [(0.0, 0.0), (width, 0.0), (width, dy), (right, dy)]
    return (area(line(*bar, (right, height), (left, height), (left, dy), (0.0, dy))),)


def partial(width: float, height: float, style: Style) -> Figures:
    """Draw a rectangle of which some sides are left out."""
    sides = {
        "top": line((0, 0), (width, 0)),
        "right": line((width, 0), (width, height)),
        "bottom": line((width, height), (0, height)),
        "left": line((0, height), (0, 0)),
    }
    return (strokes(*(side for name, side in sides.items() if style.get(name) != "0")),)


def rectangle(width: float, height: float, style: Style) -> Figures:
    """Draw a rectangle, its corners rounded if they are."""
    if style.get("rounded") != "1":
        return (area(box(0.0, 0.0, width, height)),)
    radius = min(width, height) * min(max(number(style.get("arcSize", ""), 15.0) / 100.0, 0.0), 0.5)
    centers = [(width - radius, radius), (width - radius, height - radius), (radius, height - radius)]
    arcs = [
        arc(center, (radius, radius), math.radians(90.0 * k - 90.0), math.pi / 2.0)
        for k, center in enumerate([*centers, (radius, radius)])
    ]
    return (area(np.vstack(arcs)),)


SHAPES: Mapping[str, Callable[[float, float, Style], Figures]] = {
    "ellipse": ellipse,
    "doubleEllipse": ellipse,
    "rhombus": rhombus,
    "triangle": triangle,
    "hexagon": hexagon,
    "line": middle_line,
    "corner": corner,
    "tee": tee,
    "partialRectangle": partial,
    "dimension": dimension,
}


def figures_of(box_: Box, style: Style) -> Figures:
    """Draw a shape in the size of its box; shapes that are not known are rectangles."""
    width, height = box_.width, box_.height
    if style.get("direction") in ("north", "south"):
        width, height = height, width
    shape = style.get("shape", "")
    if shape.startswith(LIBRARY):
        return floorplan_figures(shape, width, height, style)
    return SHAPES.get(shape, rectangle)(width, height, style)


def page_from_figure(box_: Box, style: Style) -> Affine2:
    """Return the map from a figure to the page, y down: mirrored, then turned about the middle."""
    quarters = QUARTERS.get(style.get("direction", "east"), 0)
    upright = quarters % 2 == 1
    size = np.array([box_.height, box_.width] if upright else [box_.width, box_.height])
    flips = [-1.0 if style.get(name) == "1" else 1.0 for name in ("flipH", "flipV")]
    mirror = np.diag(flips[::-1] if upright else flips)
    angle = math.radians(number(style.get("rotation", ""), 0.0)) + quarters * math.pi / 2.0
    cosine, sine = math.cos(angle), math.sin(angle)
    linear = np.array([[cosine, -sine], [sine, cosine]]) @ mirror  # clockwise: y points down
    return Affine2(linear, box_.middle - linear @ (size / 2.0))
