"""Name cells so that a name stays when something is drawn elsewhere.

A cell that bears a label is called by it: `meeting-room`. Any other is called by its rounded middle,
in the axes of the drawing's file: `x120y80`. Cells of one name are numbered, the largest first: `wc`, `wc-2`.
"""

import math
import re
from collections.abc import Sequence

import numpy as np
import shapely

from pilotage.maps.file_axes import FileAxes

ROUNDING = 0.02
"""Middles are rounded to the power of ten below this share of the drawing's diameter."""

LONGEST = 40
"""Letters of a label that are used."""


def identify(
    polygons: Sequence[shapely.Polygon], words: Sequence[Sequence[str]], diameter: float, axes: FileAxes
) -> list[str]:
    """Name cells, the largest first, by the labels in each, else by their middles."""
    names = [
        next((slug for text in texts if (slug := slug_of(text))), "") or place_name(polygon, diameter, axes)
        for polygon, texts in zip(polygons, words, strict=True)
    ]
    return numbered(names)


def slug_of(label: str) -> str:
    """Write a label in small letters, digits and hyphens; letters of any script are kept.

    >>> slug_of("Meeting room"), slug_of(" WC 2 "), slug_of("?")
    ('meeting-room', 'wc-2', '')
    """
    return re.sub(r"[\W_]+", "-", label.casefold()[:LONGEST]).strip("-")


def place_name(polygon: shapely.Polygon, diameter: float, axes: FileAxes) -> str:
    """Write where a cell is: its middle, or a point in it if that is not in it, rounded."""
    middle = polygon.centroid
    if not polygon.covers(middle):
        middle = polygon.point_on_surface()
    digits = -math.floor(math.log10(ROUNDING * diameter))
    place = axes.from_sketch(np.array([(middle.x, middle.y)]))[0]
    x, y = (number(value, digits) for value in place.tolist())
    return f"x{x}y{y}"


def number(value: float, digits: int) -> str:
    """Round to so many digits behind the point, or before it if that is negative.

    >>> number(123.4, -1), number(-0.04, 1), number(2.36, 1)
    ('120', '0.0', '2.4')
    """
    return f"{float(np.round(value, digits)) + 0.0:.{max(digits, 0)}f}"


def numbered(names: Sequence[str]) -> list[str]:
    """Put a number behind names that occur again.

    >>> numbered(["wc", "hall", "wc", "wc-2"])
    ['wc', 'hall', 'wc-2', 'wc-2-2']
    """
    taken: set[str] = set()
    result = []
    for name in names:
        unique, count = name, 1
        while unique in taken:
            count += 1
            unique = f"{name}-{count}"
        taken.add(unique)
        result.append(unique)
    return result
