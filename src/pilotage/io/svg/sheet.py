"""Read an SVG file as a sheet: its marks and words in paint order, nothing understood."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import svgelements

from pilotage.interpretation import Color, Mark, Pen, Role, Sheet
from pilotage.interpretation.paper import boxes_of
from pilotage.io.clip import Part, cut
from pilotage.io.colors import is_hint, on_paper
from pilotage.io.svg.flatten import flatten
from pilotage.io.svg.names import (
    SEVERAL,
    Labeled,
    are_letters,
    labeled,
    room_name,
    source_of,
    texts_of_labels,
    texts_of_shapes,
)
from pilotage.io.svg.outlines import FLATNESS
from pilotage.io.svg.reader import Shape, diagonal_of, flipped, read_content, reading_values
from pilotage.io.svg.roles import ALWAYS, CLOSED, Thing
from pilotage.io.svg.servers import has_area
from pilotage.io.svg.style import leading_number
from pilotage.io.svg.texts import read_texts
from pilotage.io.svg.tree import Drawn
from pilotage.io.svg.winding import filled_twice

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
        labels = labeled(shapes)
        letters = {label: group for label, group in labels.items() if are_letters(label[1], group)}
        marks = read_marks(shapes, tolerance, letters, OPAQUE) or read_marks(shapes, tolerance, letters, 0.0)
        marks = with_hidden_rooms([*shapes, *content.unseen], marks)
        words = tuple(text for item in content.texts for text in read_texts(item))
    bounds = None if page is None else (page.x, -(page.y + page.height), page.x + page.width, -page.y)
    return Sheet(
        marks,
        (
            *words,
            *texts_of_labels(labels, letters, words),
            *texts_of_shapes(shapes, content.unseen, words),
        ),
        bounds,
        content.background,
        y_down=True,
        metres_per_unit=content.metres_per_unit,
        source=str(path),
    )


def read_marks(
    shapes: Sequence[Shape], tolerance: float, letters: Labeled, opaque: float
) -> tuple[Mark, ...]:
    """Flatten all shapes; paint that is less opaque than this is none."""
    return tuple(mark for shape in shapes for mark in read_mark(shape, tolerance, letters, opaque))


def with_hidden_rooms(shapes: Sequence[Shape], marks: Sequence[Mark]) -> tuple[Mark, ...]:
    """Outline the shapes that are called rooms and not painted, where no mark is as long as most of them.

    Dashboards lay them over a picture of the plan; all that is painted shows what is measured.
    """
    hidden = [
        shape for shape in shapes if room_name(shape.drawn) and not any(read_mark(shape, 1.0, {}, OPAQUE))
    ]
    lengths = [math.dist(box[:2], box[2:]) for box in boxes_of(marks)]
    if len(hidden) < SEVERAL or max(lengths, default=0.0) >= np.median([diagonal_of([a]) for a in hidden]):
        return tuple(marks)
    tolerance = FLATNESS * diagonal_of(hidden)
    return (
        *(replace(mark, names=(*mark.names, "ignore")) for mark in marks),
        *(
            Mark(tuple(outlines), Pen(), None, shape.drawn.names, shape.drawn.groups, source_of(shape.drawn))
            for shape in hidden
            if (outlines := [flipped(line) for line in flatten(shape.outline, tolerance)])
        ),
    )


def read_mark(shape: Shape, tolerance: float, letters: Labeled, opaque: float) -> Iterator[Mark]:
    """Flatten a shape; one without length gives none."""
    if tolerance == 0.0:
        return
    outlines = tuple(flatten(shape.outline, tolerance))
    drawn, clip = shape.drawn, shape.clip
    pen = read_pen(shape) if drawn.style.stroked and opacity(drawn, "stroke") >= opaque else None
    filled = drawn.style.filled and has_area(drawn.element) and opacity(drawn, "fill") >= opaque
    fill = color_of(drawn, "fill") if filled else None
    if pen is None and drawn.style.stroked and fill is None and can_be_seen(drawn):
        pen = read_pen(shape)
    if not outlines or (pen is None and fill is None):
        return
    names = drawn.names if stands(drawn) else (*drawn.names, "ignore")
    if drawn.notes.get(CLOSED) == ALWAYS:  # a door that never opens
        names = (*names, "wall")
    if drawn.outlined in letters:
        names = (*names, "text")
    winds = fill is not None and drawn.style.values["fill-rule"] == "nonzero"
    twice = filled_twice(outlines) if winds else None
    wholes: list[Part] = [(outlines, pen, fill)]
    if twice is not None:
        wholes = [(twice, None, fill)] + ([] if pen is None else [(outlines, pen, None)])
    parts: Iterable[Part] = wholes
    if clip is not None and not clip.leaves_whole(outlines):
        parts = (part for whole in wholes for part in cut(*whole, clip))
    for part, line, area in parts:
        if part:
            up = tuple(flipped(outline) for outline in part)
            yield Mark(up, line, area, names, drawn.groups, source_of(drawn))


def read_pen(shape: Shape) -> Pen:
    """Read how a line is drawn, its width in the root's units.

    A first dash as long as the whole line, with which pages let it appear, is none.
    """
    drawn, (left, top, right, bottom) = shape.drawn, shape.bounds
    matrix = drawn.page_from_element
    stretch = math.sqrt(abs(matrix.a * matrix.d - matrix.b * matrix.c))
    width = leading_number(drawn.style.values["stroke-width"], 1.0) * stretch
    dashes = drawn.style.values["stroke-dasharray"]
    dashed = any(char in "123456789" for char in dashes)
    dashed = dashed and leading_number(dashes, 0.0) * stretch < 2.0 * (right - left + bottom - top)
    return Pen(color_of(drawn, "stroke"), width, dashed=dashed)


def color_of(drawn: Drawn, name: str) -> Color:
    """Read the color of "stroke" or "fill" as it looks on white paper."""
    return on_paper(*paint_of(drawn, name))


def paint_of(drawn: Drawn, name: str) -> tuple[tuple[int, int, int], float]:
    """Read red, green and blue of "stroke" or "fill", 0 to 255, and how much of it hides what lies below."""
    color = svgelements.Color(drawn.style.paint(name))
    return (color.red, color.green, color.blue), opacity(drawn, name)


def can_be_seen(drawn: Drawn) -> bool:
    """Tell whether a line is more than a hint of its color."""
    return not is_hint(*paint_of(drawn, "stroke"))


def opacity(drawn: Drawn, name: str) -> float:
    """Tell how much of what lies below the paint of "stroke" or "fill" hides, 0 to 1."""
    color = svgelements.Color(drawn.style.paint(name))
    own = leading_number(drawn.style.values[f"{name}-opacity"], 1.0)
    return min(float(color.opacity) * drawn.style.opacity * own, 1.0)


def stands(item: Drawn) -> bool:
    """Tell whether a stroke belongs to the building itself: not people of a world, nor doors that open."""
    opens = item.notes.get(CLOSED, ALWAYS) != ALWAYS
    return item.thing is not Thing.PERSON and not (item.thing is Thing.DOOR and opens)
