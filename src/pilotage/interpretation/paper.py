"""Find the sheet of paper that a drawing stands on, and the color of its ground."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, Polyline, signed_area
from pilotage.interpretation.sheet import BLACK, WHITE, Bounds, Color, Mark, Sheet

ROUNDING = 1e-6
"""Relative error that transforms may leave in an area or a width."""

FAINT = 0.1
"""Paint that differs less than this from the ground in every channel cannot be seen."""

SAME = 0.02
"""Colors that differ by less than this in every channel are one color."""

SMALL = 0.1
"""What is no longer than this share of a drawing in white is a thing in it, and does not tell its ground."""

COVERING = 0.99
"""A rectangle covers the page if it hides this share of it: exporters round, and printers leave a hair."""


@dataclass(frozen=True, slots=True)
class Paper:
    """What lies below the drawing."""

    sheets: tuple[int, ...]  # which marks are sheets of paper
    ground: Color  # the color that the drawing stands on


def find_paper(sheet: Sheet, drawn: Sequence[int]) -> Paper:
    """Find sheets of paper among the marks drawn: rectangles, filled but without a line, below all else.

    A sheet covers the whole page, or is white or of the color of the ground and holds all else; a colored
    rectangle on a part of the page is a building. White lines without any sheet are drawn for a dark one,
    also if lamps and other small things in a color stand among them.
    """
    sheets: list[int] = []
    ground = sheet.background
    bounds = [(left, low, right, high) for left, low, right, high in boxes_of(sheet.marks).tolist()]
    for place, number in enumerate(drawn[:-1]):
        mark = sheet.marks[number]
        covering = sheet.page is not None and share_within(sheet.page, bounds[number]) >= COVERING
        of_ground = mark.fill is not None and min(difference(mark.fill, c) for c in (ground, WHITE)) < SAME
        framing = of_ground and all(holds(bounds[number], bounds[other]) for other in drawn[place + 1 :])
        if mark.pen is not None or mark.fill is None or not is_box(mark) or not (covering or framing):
            break
        sheets.append(number)
        ground = mark.fill if covering else ground
    drawing = [number for number in drawn if number not in sheets]
    if difference(ground, WHITE) < FAINT and any(sheet.marks[number].pen is not None for number in drawing):
        white = [number for number in drawing if is_white(sheet.marks[number])]
        others = [size_of([bounds[number]]) for number in set(drawing) - set(white)]
        few = len(others) < len(white)
        if few and max(others, default=0.0) <= SMALL * size_of([bounds[number] for number in white]):
            ground = BLACK
    return Paper(tuple(sheets), ground)


def is_white(mark: Mark) -> bool:
    """Tell whether all paint of a mark is nearly white."""
    paints = (mark.fill, None if mark.pen is None else mark.pen.color)
    return all(difference(color, WHITE) < FAINT for color in paints if color is not None)


def size_of(boxes: Sequence[Bounds]) -> float:
    """Return the length of the diagonal of what holds boxes."""
    left, bottom, right, top = zip(*boxes, strict=True)
    return math.hypot(max(right) - min(left), max(top) - min(bottom))


def difference(first: Color, second: Color) -> float:
    """Return the largest difference of two colors in a channel, 0 to 1."""
    return max(abs(a - b) for a, b in zip(first, second, strict=True))


def bounds_of(mark: Mark) -> Bounds:
    """Return left, bottom, right and top of a mark."""
    left, bottom, right, top = boxes_of([mark])[0].tolist()
    return left, bottom, right, top


def boxes_of(marks: Sequence[Mark]) -> Array:
    """Return left, bottom, right and top of each mark, (n, 4)."""
    if not marks:
        return np.empty((0, 4))
    points = np.concatenate([outline.vertices for mark in marks for outline in mark.outlines])
    counts = [sum(map(len, mark.outlines)) for mark in marks]
    firsts = np.cumsum([0, *counts[:-1]])
    return np.hstack([np.minimum.reduceat(points, firsts), np.maximum.reduceat(points, firsts)])


def holds(outer: Bounds, inner: Bounds) -> bool:
    """Tell whether one box lies in another."""
    return outer[0] <= inner[0] and outer[1] <= inner[1] and outer[2] >= inner[2] and outer[3] >= inner[3]


def share_within(box: Bounds, cover: Bounds) -> float:
    """Tell which share of a box another hides."""
    width = min(box[2], cover[2]) - max(box[0], cover[0])
    height = min(box[3], cover[3]) - max(box[1], cover[1])
    area = (box[2] - box[0]) * (box[3] - box[1])
    return max(width, 0.0) * max(height, 0.0) / area if area > 0.0 else 0.0


def is_closed(mark: Mark) -> bool:
    """Tell whether a mark is one closed outline, around an area."""
    return len(mark.outlines) == 1 and mark.outlines[0].closed and len(mark.outlines[0]) > 2


def is_box(mark: Mark) -> bool:
    """Tell whether a mark is a rectangle along the axes: it fills its bounds."""
    left, bottom, right, top = bounds_of(mark)
    box = (right - left) * (top - bottom)
    return len(mark.outlines) == 1 and math.isclose(area_of(mark.outlines[0]), box, rel_tol=ROUNDING)


def area_of(outline: Polyline) -> float:
    """Return the area that an outline encloses once it is closed."""
    return abs(signed_area(outline.vertices))
