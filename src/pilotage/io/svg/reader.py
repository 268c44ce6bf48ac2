"""Read what an SVG document shows: shapes and texts in the coordinates of its root."""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import shapely
import svgelements

from pilotage.errors import FileError
from pilotage.geometry import Array, Polyline, signed_area
from pilotage.interpretation.paper import holds
from pilotage.io.clip import Clip, area_of
from pilotage.io.files import check_regular, read_bytes
from pilotage.io.svg.flatten import flatten
from pilotage.io.svg.style import local_name
from pilotage.io.svg.tree import ClipUse, Document, Drawn
from pilotage.io.svg.viewport import Viewport

FLATNESS = 0.0005
"""How far a chord may stray from its curve, as a share of the drawing's diagonal: 2 cm in a 40 m building."""

WHITE = svgelements.Color("white")

ROUNDING = 1e-6
"""Relative error that transforms may leave in an area."""

WORDED = ("text", "foreignObject")

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

FARTHEST = 1e9
"""Largest coordinate that is accepted: beyond it, areas and lengths lose their digits or overflow."""

SCALE = "data-metres-per-unit"
"""Attribute of the root: metres in a unit of its viewBox."""

Bounds = tuple[float, float, float, float]  # left, top, right, bottom


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


def read_content(path: Path) -> Content:
    """Read all shapes and texts that can be seen, and the page they stand on.

    Raises FileError for a file that is missing or is not SVG.
    """
    root = read_document(path)
    with reading_values(path):
        document = Document(root)
        items = [item for item in document.walk() if item.style.shown]
        clips = Clips(document)
        shapes = [shape for item in items for shape in read_shape(item, clips)]
    texts = [item for item in items if local_name(item.element.tag) in WORDED and has_text(item)]
    return Content(shapes, texts, document.page, read_scale(root))


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
        root = ET.fromstring(read_bytes(path, LARGEST))  # noqa: S314  # expat itself refuses entity bombs
    except (ET.ParseError, LookupError, ValueError) as error:
        raise FileError(f"an SVG drawing must be well-formed XML ({error})", path) from error
    if local_name(root.tag) != "svg":
        raise FileError(f"an SVG drawing must begin with <svg>, found <{local_name(root.tag)}>", path)
    return root


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


def read_shape(item: Drawn, clips: Clips) -> Iterator[Shape]:
    """Carry a shape to the root's coordinates; texts, and shapes of which nothing is seen, give none."""
    if not (item.style.stroked or item.style.filled):
        return
    for outline in outline_of(item):
        bounds = bounds_of(outline)
        if not all(abs(bound) <= FARTHEST for bound in bounds):  # not a number, too
            raise ValueError(f"<{local_name(item.element.tag)}> reaches farther than {FARTHEST:g}")
        clip = clips.clip_of(item)
        if clip is None:
            yield Shape(item, outline, bounds)
        elif (seen := clip.cut_box(bounds)) is not None:
            yield Shape(item, outline, seen, clip)


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


def has_text(item: Drawn) -> bool:
    """Tell whether a text says anything that can be seen."""
    return (item.style.filled or item.style.stroked) and any(part.strip() for part in item.element.itertext())


def apply(matrix: svgelements.Matrix, point: Array) -> Array:
    """Move one point (2,) by an SVG matrix."""
    x, y = point
    return np.array([matrix.a * x + matrix.c * y + matrix.e, matrix.b * x + matrix.d * y + matrix.f])
