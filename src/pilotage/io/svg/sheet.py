"""Read an SVG file as a sheet: its marks and words in paint order, nothing understood."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import svgelements

from pilotage.interpretation import Color, Mark, Pen, Role, Sheet, Text
from pilotage.io.colors import on_paper
from pilotage.io.svg.flatten import flatten
from pilotage.io.svg.reader import FLATNESS, Shape, diagonal_of, flipped, read_content, reading_values
from pilotage.io.svg.roles import ALWAYS, CLOSED, Thing
from pilotage.io.svg.style import leading_number, local_name
from pilotage.io.svg.texts import read_texts
from pilotage.io.svg.tree import Drawn

OPAQUE = 0.5
"""Paint that lets more than this through hides nothing."""


def read_svg_sheet(path: Path) -> Sheet:
    """Read an SVG (or gzipped SVG) file in the units of its root's viewBox.

    Raises FileError for a file that is missing or is not SVG.
    """
    content = read_content(path)
    shapes, page = content.shapes, content.page
    with reading_values(path):
        walls = [shape for shape in shapes if shape.drawn.role is Role.WALL]
        tolerance = FLATNESS * diagonal_of(walls or shapes) if shapes else 0.0
        marks = tuple(mark for shape in shapes for mark in read_mark(shape, tolerance))
        words = tuple(text for item in content.texts for text in read_texts(item))
    bounds = None if page is None else (page.x, -(page.y + page.height), page.x + page.width, -page.y)
    return Sheet(
        marks,
        words + tuple(outlined_texts(shapes)),
        bounds,
        y_down=True,
        metres_per_unit=content.metres_per_unit,
        source=str(path),
    )


def read_mark(shape: Shape, tolerance: float) -> Iterator[Mark]:
    """Flatten a shape; one without length gives none."""
    if tolerance == 0.0:
        return
    outlines = tuple(flipped(stroke) for stroke in flatten(shape.outline, tolerance))
    drawn = shape.drawn
    pen = read_pen(drawn) if drawn.style.stroked and opacity(drawn, "stroke") >= OPAQUE else None
    fill = color_of(drawn, "fill") if drawn.style.filled and opacity(drawn, "fill") >= OPAQUE else None
    if pen is None and drawn.style.stroked and fill is None:
        pen = read_pen(drawn)
    if not outlines or (pen is None and fill is None):
        return
    names = drawn.names if stands(drawn) else (*drawn.names, "ignore")
    if drawn.notes.get(CLOSED) == ALWAYS:  # a door that never opens
        names = (*names, "wall")
    if drawn.outlined is not None:
        names = (*names, "text")
    yield Mark(outlines, pen, fill, names, drawn.groups, source_of(drawn))


def read_pen(drawn: Drawn) -> Pen:
    """Read how a line is drawn, its width in the root's units."""
    matrix = drawn.page_from_element
    stretch = math.sqrt(abs(matrix.a * matrix.d - matrix.b * matrix.c))
    width = leading_number(drawn.style.values["stroke-width"], 1.0) * stretch
    dashes = drawn.style.values["stroke-dasharray"]
    return Pen(color_of(drawn, "stroke"), width, dashed=any(char in "123456789" for char in dashes))


def color_of(drawn: Drawn, name: str) -> Color:
    """Read the color of "stroke" or "fill" as it looks on white paper."""
    color = svgelements.Color(drawn.style.paint(name))
    return on_paper((color.red, color.green, color.blue), opacity(drawn, name))


def opacity(drawn: Drawn, name: str) -> float:
    """Tell how much of what lies below the paint of "stroke" or "fill" hides, 0 to 1."""
    color = svgelements.Color(drawn.style.paint(name))
    own = leading_number(drawn.style.values[f"{name}-opacity"], 1.0)
    return min(float(color.opacity) * drawn.style.opacity * own, 1.0)


def stands(item: Drawn) -> bool:
    """Tell whether a stroke belongs to the building itself: not people of a world, nor doors that open."""
    opens = item.notes.get(CLOSED, ALWAYS) != ALWAYS
    return item.thing is not Thing.PERSON and not (item.thing is Thing.DOOR and opens)


def outlined_texts(shapes: Sequence[Shape]) -> Iterator[Text]:
    """Read the words that texts had before they were turned into outlines."""
    letters: dict[tuple[int, str], list[Shape]] = {}
    for shape in shapes:
        if shape.drawn.outlined is not None:
            letters.setdefault(shape.drawn.outlined, []).append(shape)
    for (_, words), group in letters.items():
        boxes = np.array([shape.bounds for shape in group])
        (left, top), (right, bottom) = boxes[:, :2].min(axis=0).tolist(), boxes[:, 2:].max(axis=0).tolist()
        middle = (left + right) / 2.0, -(top + bottom) / 2.0
        drawn = group[0].drawn
        yield Text(words, middle, bottom - top, 0.0, drawn.names, drawn.groups, f"outlines of {words!r}")


def source_of(drawn: Drawn) -> str:
    """Say where a shape is in its file."""
    element = drawn.element
    name = element.get("id") or element.get("class")
    attribute = "id" if element.get("id") else "class"
    return f"<{local_name(element.tag)} {attribute}={name}>" if name else f"<{local_name(element.tag)}>"
