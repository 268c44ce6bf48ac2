"""Read what an SVG document shows: shapes and texts in the coordinates of its root."""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import svgelements

from pilotage.errors import FileError
from pilotage.geometry import Array, Polyline, signed_area
from pilotage.interpretation import Color
from pilotage.interpretation.paper import holds
from pilotage.interpretation.sheet import WHITE as PAPER
from pilotage.io.clip import Clip
from pilotage.io.colors import read_color
from pilotage.io.files import check_regular, read_bytes
from pilotage.io.svg.clips import ROUNDING, Clips
from pilotage.io.svg.flatten import flatten
from pilotage.io.svg.matplotlib import read_tree
from pilotage.io.svg.outlines import FLATNESS, Bounds, bounds_of, outline_of
from pilotage.io.svg.style import local_name, resolved
from pilotage.io.svg.tree import WORDED, Document, Drawn
from pilotage.io.svg.viewport import Viewport

WHITE = svgelements.Color("white")

FARTHEST = 1e9
"""Largest coordinate that is accepted: beyond it, areas and lengths lose their digits or overflow."""

SCALE = "data-metres-per-unit"
"""Attribute of the root: metres in a unit of its viewBox."""


@dataclass(frozen=True, slots=True)
class Shape:
    """A shape of the drawing, its outline in the root's coordinates."""

    drawn: Drawn
    outline: svgelements.Path
    bounds: Bounds  # of what its clips leave
    clip: Clip | None = None  # what it is cut to, in the root's coordinates


@dataclass(frozen=True, slots=True)
class Content:
    """All that can be seen, and what the file says of the page on which it stands."""

    shapes: list[Shape]
    texts: list[Drawn]
    page: Viewport | None
    metres_per_unit: float | None  # what the file claims
    background: Color = PAPER  # of the page, as its style says
    unseen: Sequence[Shape] = ()  # areas without paint, at which one can point nevertheless


def read_content(path: Path) -> Content:
    """Read all shapes and texts that can be seen, and the page they stand on.

    Raises FileError for a file that is missing or is not SVG.
    """
    root = read_document(path)
    with reading_values(path):
        document = Document(root)
        items = [item for item in document.walk() if item.style.there]
        clips = Clips(document)
        shapes = [shape for item in items if is_seen(item) for shape in read_shape(item, clips)]
        unseen = [shape for item in items if not is_seen(item) for shape in read_shape(item, clips)]
    texts = [item for item in items if local_name(item.element.tag) in WORDED and has_text(item)]
    return Content(shapes, texts, document.page, read_scale(root), read_background(document), unseen)


def read_background(document: Document) -> Color:
    """Read the color that a page in the browser has below the drawing; white if none is told."""
    declared = document.declared_of_root
    written = (declared.get(name, "") for name in ("background-color", "background"))
    return next((color for value in written if (color := read_color(resolved(value)))), PAPER)


def read_scale(root: ET.Element) -> float | None:
    """Read the scale that the drawing table writes when something was measured; None if it means nothing.

    >>> read_scale(ET.Element("svg", {"data-metres-per-unit": "0.02"})), read_scale(ET.Element("svg"))
    (0.02, None)
    """
    try:
        metres = float(root.get(SCALE, ""))
    except ValueError:
        return None
    return metres if 0.0 < metres < math.inf else None


@contextmanager
def reading_values(path: Path) -> Iterator[None]:
    """Raise FileError for attributes that `svgelements` or the flattening of curves cannot work with."""
    try:
        with np.errstate(all="ignore"):
            yield
    except (ValueError, TypeError, IndexError, AttributeError, ArithmeticError) as error:
        reason = f" ({error})" if isinstance(error, ValueError) and str(error) else ""
        raise FileError(f"an SVG drawing holds a value that cannot be read{reason}", path) from error


LARGEST = 30_000_000
"""The largest drawing that is read [bytes], after unpacking: its tree takes twenty times as much."""


def read_document(path: Path) -> ET.Element:
    """Parse the file and return its root, an `svg` element."""
    check_regular(path)
    try:
        root = read_tree(read_bytes(path, LARGEST))
    except (ET.ParseError, LookupError, ValueError) as error:
        raise FileError(f"an SVG drawing must be well-formed XML ({error})", path) from error
    if local_name(root.tag) != "svg":
        raise FileError(f"an SVG drawing must begin with <svg>, found <{local_name(root.tag)}>", path)
    return root


def read_shape(item: Drawn, clips: Clips) -> Iterator[Shape]:
    """Carry a shape to the root's coordinates; texts, and shapes that are cut away, give none."""
    for outline in outline_of(item):
        bounds = bounds_of(outline)
        if not all(abs(bound) <= FARTHEST for bound in bounds):  # not a number, too
            raise ValueError(f"<{local_name(item.element.tag)}> reaches farther than {FARTHEST:g}")
        clip = clips.clip_of(item)
        if clip is None:
            yield Shape(item, outline, bounds)
        elif (seen := clip.cut_box(bounds)) is not None:
            yield Shape(item, outline, seen, clip)


def without_background(walls: Sequence[Shape], page: Viewport | None) -> list[Shape]:
    """Leave out sheets of paper: rectangles, filled but not stroked, below all else.

    A sheet covers the whole page, or is white and holds all else; a colored rectangle on a part of the page
    is a building.
    """
    kept = list(walls)
    while len(kept) > 1:
        first, rest = kept[0], kept[1:]
        covering = page is not None and holds(first.bounds, page.bounds)
        white = svgelements.Color(first.drawn.style.paint("fill")) == WHITE
        framing = white and all(holds(first.bounds, other.bounds) for other in rest)
        if first.drawn.style.stroked or not is_box(first) or not (covering or framing):
            break
        kept.pop(0)
    return kept


def is_box(shape: Shape) -> bool:
    """Tell whether an outline is a rectangle along the axes: it fills its bounds."""
    left, top, right, bottom = shape.bounds
    width, height = right - left, bottom - top
    strokes = list(flatten(shape.outline, math.hypot(width, height)))
    return len(strokes) == 1 and math.isclose(area(strokes[0]), width * height, rel_tol=ROUNDING)


def wall_strokes(walls: Sequence[Shape]) -> Iterator[Polyline]:
    """Flatten the outlines; one that is filled and not stroked is closed, and seen only if it has an area."""
    if not walls:
        return
    diagonal = diagonal_of(walls)
    if diagonal == 0.0:
        return
    for wall in walls:
        for stroke in flatten(wall.outline, FLATNESS * diagonal):
            if wall.drawn.style.stroked:
                yield stroke
            elif area(stroke) > (FLATNESS * diagonal) ** 2:
                yield Polyline(stroke.vertices, closed=True)


def diagonal_of(shapes: Sequence[Shape]) -> float:
    """Measure the diagonal of the box around shapes, at least one."""
    boxes = np.array([shape.bounds for shape in shapes])
    return float(np.hypot(*(boxes[:, 2:].max(axis=0) - boxes[:, :2].min(axis=0))))


def area(stroke: Polyline) -> float:
    """Return the area that a stroke encloses once it is closed."""
    return abs(signed_area(stroke.vertices))


def flipped(stroke: Polyline) -> Polyline:
    """Turn the y axis from down to up."""
    return Polyline(stroke.vertices * (1.0, -1.0), stroke.closed)


def is_seen(item: Drawn) -> bool:
    """Tell whether anything is painted."""
    return item.style.filled or item.style.stroked


def has_text(item: Drawn) -> bool:
    """Tell whether a text says anything that can be seen."""
    return is_seen(item) and any(part.strip() for part in item.element.itertext())


def apply(matrix: svgelements.Matrix, point: Array) -> Array:
    """Move one point (2,) by an SVG matrix."""
    x, y = point
    return np.array([matrix.a * x + matrix.c * y + matrix.e, matrix.b * x + matrix.d * y + matrix.f])
