"""Read an SVG file as a sheet: its marks and words in paint order, nothing understood."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np
import shapely
import svgelements

from pilotage.interpretation import Color, Mark, Pen, Role, Sheet, Text
from pilotage.interpretation.names import SPACES, guessed_role, holds_rooms, is_room, name_words
from pilotage.interpretation.paper import boxes_of
from pilotage.io.clip import Part, cut
from pilotage.io.colors import is_hint, on_paper
from pilotage.io.svg.flatten import flatten
from pilotage.io.svg.outlines import FLATNESS
from pilotage.io.svg.reader import Shape, diagonal_of, flipped, read_content, reading_values
from pilotage.io.svg.roles import ALWAYS, CLOSED, Thing, names_of
from pilotage.io.svg.servers import has_area
from pilotage.io.svg.style import is_named, leading_number, local_name
from pilotage.io.svg.texts import read_texts
from pilotage.io.svg.tree import DRAWN, OUTLINED, Drawn
from pilotage.io.svg.winding import filled_twice

INKSCAPE, SERIF = "http://www.inkscape.org/namespaces/inkscape", "http://www.serif.com/"

Labeled = Mapping[tuple[int, str], Sequence[Shape]]
"""Shapes by the label that they bear, the number of what bears it first: of letters it is what they spell."""

OPAQUE = 0.5
"""Paint that lets more than this through hides nothing."""

LARGE = 0.1
"""A room is longer than this share of the drawing's diagonal; what is smaller and has a title is a thing."""

SMALL = 0.03
"""The same where each shape is called something and nothing is written."""

SEVERAL = 2
"""So many rooms at least are a plan, though not painted."""

GENERIC = frozenset(
    (
        *(*SPACES, *DRAWN, "rectangle", "vector", "shape", "group", "layer", "floor"),
        *("g", "svg", "id", "xmlid", "svgid", "copy", "combined", "compound", "union", "subtract"),
        *("intersect", "oval", "clip", "mask", "image", "use", "fill", "stroke", "outline", "background"),
        *("plan", "map", "floorplan", "building", "grundriss"),
    )
)
"""Words that tell nothing of a room, many of programs."""

NUMBER = re.compile(r"\d{2,4}[A-Za-z]?")
"""Number of a room."""

CALLED = (f"{{{INKSCAPE}}}label", "data-name", f"{{{SERIF}}}id", "id")
"""Where programs keep what a person calls a shape, the id last: it must be of letters without blanks."""

ROUND = ("circle", "ellipse")
"""Lamps, sensors and pins are drawn so."""

LETTERS = 0.8
"""Outlines of words have at least so many subpaths for each letter; a shape that is called so has fewer."""


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
            *(texts_of_rooms([*shapes, *content.unseen], words) or (() if words else texts_of_ids(shapes))),
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


def labeled(shapes: Sequence[Shape]) -> Labeled:
    """Group the shapes that bear a label, or that an element with one holds."""
    found: dict[tuple[int, str], list[Shape]] = {}
    for shape in shapes:
        if shape.drawn.outlined is not None:
            found.setdefault(shape.drawn.outlined, []).append(shape)
    return found


def are_letters(words: str, group: Sequence[Shape]) -> bool:
    """Tell whether shapes are the outlines of words: paths, about one for each letter.

    Labels also say what a drawing or a room of it is called.
    """
    outlines = [sum(isinstance(step, svgelements.Move) for step in shape.outline) for shape in group]
    are_paths = all(local_name(shape.drawn.element.tag) == "path" for shape in group)
    return are_paths and sum(outlines) >= LETTERS * len("".join(words.split()))


def texts_of_labels(found: Labeled, letters: Labeled, written: Sequence[Text]) -> Iterator[Text]:
    """Read the words that texts had before they were turned into outlines, and what single shapes are called.

    A shape in which something is written needs no other name.
    """
    for label, group in found.items():
        _, words = label
        boxes = np.array([shape.bounds for shape in group])
        (left, top), (right, bottom) = boxes[:, :2].min(axis=0).tolist(), boxes[:, 2:].max(axis=0).tolist()
        middle = (left + right) / 2.0, -(top + bottom) / 2.0
        drawn = group[0].drawn
        if label in letters:
            yield Text(words, middle, bottom - top, 0.0, drawn.names, drawn.groups, f"outlines of {words!r}")
        elif drawn.element.get(OUTLINED) and not any(
            left <= text.position[0] <= right and -bottom <= text.position[1] <= -top for text in written
        ):
            yield Text(words, middle, 0.0, 0.0, drawn.names, drawn.groups, source_of(drawn))


def texts_of_rooms(shapes: Sequence[Shape], written: Sequence[Text]) -> list[Text]:
    """Read what shapes are called by their titles, if nothing is written, and by the ids of rooms.

    A shape in which something is written needs no other name; a small one with a title is a thing.
    """
    found = []
    places = shapely.points(np.reshape([text.position for text in written], (-1, 2)))
    smallest = LARGE * diagonal_of(shapes) if shapes else 0.0
    for shape in shapes:
        drawn = shape.drawn
        is_large = diagonal_of([shape]) >= smallest
        words = (title_of(drawn.element) if is_large and not written else "") or room_name(drawn)
        if not words or drawn.outlined:
            continue
        area = area_of(shape)
        if not area.is_empty and not shapely.intersects(area, places).any():
            found.append(text_within(area, words, drawn))
    return found


def texts_of_ids(shapes: Sequence[Shape]) -> list[Text]:
    """Read what shapes are called by their ids in a drawing without words: areas that are not small.

    An area that holds several others is no room. One name alone is that of the drawing.
    """
    smallest = SMALL * diagonal_of(shapes) if shapes else 0.0
    called = [
        (shape, words, area)
        for shape in shapes
        if diagonal_of([shape]) >= smallest
        and local_name(shape.drawn.element.tag) not in ROUND
        and (words := own_name(shape.drawn))
        and guessed_role(shape.drawn.names) is None
        and not (area := area_of(shape, closed=True)).is_empty
    ]
    areas = np.array([area for *_, area in called], dtype=object)
    inner = shapely.point_on_surface(areas)
    texts = [
        text_within(area, words, shape.drawn)
        for shape, words, area in called
        if shapely.contains(area, inner).sum() <= SEVERAL
    ]
    return texts if len(texts) >= SEVERAL else []


def area_of(shape: Shape, *, closed: bool = False) -> shapely.Geometry:
    """Return what a shape encloses, y up; `closed` leaves out what only its chords would close."""
    lines = flatten(shape.outline, FLATNESS * diagonal_of([shape]))
    rings = [flipped(line).vertices for line in lines if line.closed or not closed]
    return shapely.union_all([shapely.Polygon(ring).buffer(0.0) for ring in rings if len(ring) > 2])


def text_within(area: shapely.Geometry, words: str, drawn: Drawn) -> Text:
    """Write what a shape is called into its area."""
    x, y = shapely.get_coordinates(shapely.point_on_surface(area))[0].tolist()
    return Text(words, (x, y), 0.0, 0.0, drawn.names, drawn.groups, source_of(drawn))


def title_of(element: Element) -> str:
    """Return what an element is called when one points at it; nothing if it has no title."""
    return next((" ".join((node.text or "").split()) for node in element if is_named(node, "title")), "")


def room_name(drawn: Drawn) -> str:
    """Return what a shape is called that is classed a room, or is in a group of rooms, and is no thing.

    Nothing if a program made its label and its id.
    """
    above = drawn.names[: len(drawn.names) - len(list(names_of(drawn.element)))]
    if not (is_room(drawn.names[-1:]) or holds_rooms(above[-1:])) or guessed_role(drawn.names) is not None:
        return ""
    return own_name(drawn)


def own_name(drawn: Drawn) -> str:
    """Return what a person called a shape, as a word or the number of a room; nothing if programs did."""
    written = [drawn.element.get(name, "") for name in CALLED]
    return next((name for name in written if NUMBER.fullmatch(name) or set(name_words(name)) - GENERIC), "")


def source_of(drawn: Drawn) -> str:
    """Say where a shape is in its file."""
    element = drawn.element
    name = element.get("id") or element.get("class")
    attribute = "id" if element.get("id") else "class"
    return f"<{local_name(element.tag)} {attribute}={name}>" if name else f"<{local_name(element.tag)}>"
