"""What the shapes of an SVG file are called, where words are not written as text: labels, titles and ids."""

import re
from collections.abc import Iterator, Mapping, Sequence
from xml.etree.ElementTree import Element

import numpy as np
import shapely
import svgelements

from pilotage.interpretation import Text
from pilotage.interpretation.names import SPACES, guessed_role, holds_rooms, is_room, name_words
from pilotage.io.svg.flatten import flatten
from pilotage.io.svg.outlines import FLATNESS
from pilotage.io.svg.reader import Shape, diagonal_of, flipped
from pilotage.io.svg.roles import names_of
from pilotage.io.svg.style import is_named, local_name
from pilotage.io.svg.tree import DRAWN, OUTLINED, Drawn

INKSCAPE, SERIF = "http://www.inkscape.org/namespaces/inkscape", "http://www.serif.com/"

Labeled = Mapping[tuple[int, str], Sequence[Shape]]
"""Shapes by the label that they bear, the number of what bears it first: of letters it is what they spell."""

LARGE = 0.1
"""A room is longer than this share of the drawing's diagonal; what is smaller and has a title is a thing."""

SMALL = 0.03
"""The same where each shape is called something and nothing is written."""

SEVERAL = 2
"""So many rooms at least are a plan, though not painted."""

OF_PROGRAMS = (
    "rectangle vector shape group layer floor g svg id xmlid svgid copy combined compound union subtract"
    " intersect oval clip mask image use fill stroke outline background plan map floorplan building grundriss"
)
GENERIC = frozenset((*SPACES, *DRAWN, *OF_PROGRAMS.split()))
"""Words that tell nothing of a room, many of programs."""

NUMBER = re.compile(r"\d{2,4}[A-Za-z]?")
"""Number of a room."""

CALLED = (f"{{{INKSCAPE}}}label", "data-name", f"{{{SERIF}}}id", "id")
"""Where programs keep what a person calls a shape, the id last: it must be of letters without blanks."""

ROUND = ("circle", "ellipse")
"""Lamps, sensors and pins are drawn so."""

LETTERS = 0.8
"""Outlines of words have at least so many subpaths for each letter; a shape that is called so has fewer."""


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


def texts_of_shapes(shapes: Sequence[Shape], unseen: Sequence[Shape], written: Sequence[Text]) -> list[Text]:
    """Read what rooms are called, painted or not; where nothing is written and no room is, what areas are."""
    return texts_of_rooms([*shapes, *unseen], written) or ([] if written else texts_of_ids(shapes))


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
    _, around = shapely.STRtree(areas).query(shapely.point_on_surface(areas), predicate="within")
    held = np.bincount(around, minlength=len(called)).tolist()
    texts = [
        text_within(area, words, shape.drawn)
        for (shape, words, area), count in zip(called, held, strict=True)
        if count <= SEVERAL
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
