"""Shapes of draw.io's floor plan library, in a box of given size, y down, before it is turned.

Walls, windows and doors are as in the library. Furniture is the outline of its box: its name tells the rest.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array
from pilotage.io.curves import arc
from pilotage.io.drawio.cells import number

LIBRARY = "mxgraph.floorplan."

SILL = 5.0
"""Thickness of a door's threshold [px]."""

STEP = 25.0
"""Depth of a step of a stair [px]."""

MOST_STEPS = 1000
"""Steps of a stair that are drawn."""


@dataclass(frozen=True, slots=True)
class Figure:
    """Outlines (n, 2) of one paint operation."""

    outlines: tuple[Array, ...]
    closed: bool = True
    filled: bool = True


Figures = tuple[Figure, ...]
Style = Mapping[str, str]


def box(x: float, y: float, width: float, height: float) -> Array:
    """Outline a box."""
    return np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])


def line(*points: tuple[float, float]) -> Array:
    """Join points."""
    return np.array(points)


def area(*outlines: Array) -> Figure:
    """Fill and stroke outlines."""
    return Figure(outlines)


def strokes(*lines: Array) -> Figure:
    """Draw open lines."""
    return Figure(lines, closed=False, filled=False)


def thickness(style: Style) -> float:
    """Return the thickness of a wall."""
    return number(style.get("wallThickness", ""), 10.0)


def wall(width: float, height: float, style: Style) -> Figures:
    """Draw a straight wall along the middle of its box."""
    thick = thickness(style)
    return (area(box(0.0, (height - thick) / 2.0, width, thick)),)


def wall_corner(width: float, height: float, style: Style) -> Figures:
    """Draw two walls that meet at the upper left corner."""
    t = thickness(style)
    return (area(line((0, height), (0, 0), (width, 0), (width, t), (t, t), (t, height))),)


def wall_u(width: float, height: float, style: Style) -> Figures:
    """Draw three walls, open at the bottom."""
    t = thickness(style)
    outer = [(0.0, height), (0.0, 0.0), (width, 0.0), (width, height)]
    inner = [(width - t, height), (width - t, t), (t, t), (t, height)]
    return (area(line(*outer, *inner)),)


def room(width: float, height: float, style: Style) -> Figures:
    """Draw four walls."""
    t = thickness(style)
    return (area(box(0.0, 0.0, width, height), box(t, t, width - 2.0 * t, height - 2.0 * t)),)


def window(width: float, height: float, style: Style) -> Figures:
    """Draw a window: a wall with a line along its middle."""
    middle = line((0.0, height / 2.0), (width, height / 2.0))
    return (*wall(width, height, style), strokes(middle))


def door_left(width: float, _height: float, _style: Style) -> Figures:
    """Draw a door hinged at the left: threshold, arc and leaf."""
    swing = arc((0.0, SILL), (width, width), 0.0, math.pi / 2.0)
    return (area(box(0.0, 0.0, width, SILL)), strokes(np.vstack([swing, [[0.0, SILL]]])))


def door_right(width: float, _height: float, _style: Style) -> Figures:
    """Draw a door hinged at the right."""
    swing = arc((width, SILL), (width, width), math.pi, -math.pi / 2.0)
    return (area(box(0.0, 0.0, width, SILL)), strokes(np.vstack([swing, [[width, SILL]]])))


def door_double(width: float, _height: float, _style: Style) -> Figures:
    """Draw a door of two leaves."""
    half = width / 2.0
    left = arc((0.0, SILL), (half, half), 0.0, math.pi / 2.0)
    right = arc((width, SILL), (half, half), math.pi, -math.pi / 2.0)
    leaves = strokes(np.vstack([left, [[0.0, SILL]]]), np.vstack([right, [[width, SILL]]]))
    return (area(box(0.0, 0.0, width, SILL)), leaves)


def door(width: float, height: float, _style: Style) -> Figures:
    """Draw any other door: sliding, folding or rolling, as its threshold."""
    return (area(box(0.0, 0.0, width, min(height, 2.0 * SILL))),)


def stairs(width: float, height: float, _style: Style) -> Figures:
    """Draw a flight of stairs."""
    length = max(width, 2.0 * STEP)
    steps = [line((x, 0.0), (x, height)) for x in np.arange(STEP, length, STEP)[:MOST_STEPS]]
    middle = line((0.0, height / 2.0), (length, height / 2.0))
    return (area(box(0.0, 0.0, length, height)), strokes(*steps, middle))


def elevator(width: float, height: float, _style: Style) -> Figures:
    """Draw a box with a cross."""
    cross = strokes(line((0.0, 0.0), (width, height)), line((width, 0.0), (0.0, height)))
    return (area(box(0.0, 0.0, width, height)), cross)


def dimension(width: float, height: float, _style: Style) -> Figures:
    """Draw a dimension line with its two extension lines."""
    y = min(20.0, height)
    ends = (line((0.0, 0.0), (0.0, height)), line((width, 0.0), (width, height)))
    return (strokes(line((0.0, y), (width, y)), *ends),)


def furniture(width: float, height: float, _style: Style) -> Figures:
    """Draw the outline of a piece of furniture."""
    return (area(box(0.0, 0.0, width, height)),)


SHAPES: Mapping[str, Callable[[float, float, Style], Figures]] = {
    "wall": wall,
    "wallCorner": wall_corner,
    "wallU": wall_u,
    "room": room,
    "doorLeft": door_left,
    "doorRight": door_right,
    "doorDouble": door_double,
    "stairs": stairs,
    "stairsRest": stairs,
    "elevator": elevator,
    "dimension": dimension,
    "dimensionBottom": dimension,
}


def is_furniture(shape: str) -> bool:
    """Tell whether a shape of the library is no part of a building.

    >>> is_furniture("mxgraph.floorplan.water_cooler"), is_furniture("mxgraph.floorplan.wallU")
    (True, False)
    """
    name = shape.removeprefix(LIBRARY)
    return shape.startswith(LIBRARY) and name not in SHAPES and not name.startswith(("window", "door"))


def floorplan_figures(shape: str, width: float, height: float, style: Style) -> Figures:
    """Draw a shape of the library by its name."""
    name = shape.removeprefix(LIBRARY)
    if name in SHAPES:
        return SHAPES[name](width, height, style)
    if is_furniture(shape):
        return furniture(width, height, style)
    return (window if name.startswith("window") else door)(width, height, style)
