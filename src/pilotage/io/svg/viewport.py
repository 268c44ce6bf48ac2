"""Lengths of an SVG document, and the rectangle that its percentages refer to."""

import math
import re
from dataclasses import dataclass
from xml.etree.ElementTree import Element

USER_UNITS = {
    "": 1.0,
    "px": 1.0,
    "in": 96.0,
    "cm": 96.0 / 2.54,
    "mm": 96.0 / 25.4,
    "q": 96.0 / 101.6,
    "pt": 96.0 / 72.0,
    "pc": 16.0,
    "em": 16.0,
    "rem": 16.0,
    "ex": 8.0,
}
"""User units in each unit of CSS; letters are taken to be of the usual size."""

LENGTH = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-zA-Z%]*)")


@dataclass(frozen=True, slots=True)
class Viewport:
    """The rectangle that percentages refer to [user units]."""

    x: float
    y: float
    width: float
    height: float

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, top, right and bottom."""
        return self.x, self.y, self.x + self.width, self.y + self.height

    def length(self, text: str, axis: int) -> float:
        """Convert a length in any unit to user units."""
        diagonal = math.hypot(self.width, self.height) / math.sqrt(2.0)  # SVG 1.1, section 7.10
        units = {**USER_UNITS, "%": (self.width, self.height, diagonal)[axis] / 100.0}
        match = LENGTH.fullmatch(text.strip())
        if match is None or match[2].lower() not in units:
            raise ValueError(f"a length must be a number and a unit, got {text!r}")
        return float(match[1]) * units[match[2].lower()]


UNKNOWN_PAGE = Viewport(0.0, 0.0, 100.0, 100.0)
"""What percentages refer to in a document that does not tell its size."""


def read_page(root: Element) -> Viewport | None:
    """Read the viewBox of the root, else its size; None if it tells neither."""
    box = view_box(root)
    sizes = root.get("width", "100%"), root.get("height", "100%")
    if box is not None or any("%" in size or size == "auto" for size in sizes):
        return box
    width, height = (UNKNOWN_PAGE.length(size, axis) for axis, size in enumerate(sizes))
    return Viewport(0.0, 0.0, width, height)


def view_box(element: Element) -> Viewport | None:
    """Read a viewBox; None if there is none, or none that spans an area."""
    numbers = [float(number) for number in re.split(r"[\s,]+", element.get("viewBox", "").strip()) if number]
    if len(numbers) != 4 or not (numbers[2] > 0.0 and numbers[3] > 0.0):
        return None
    return Viewport(*numbers)
