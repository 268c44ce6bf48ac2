"""Walk an SVG document as it is drawn: transforms, styles and roles handed down, `use` followed."""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from xml.etree.ElementTree import Element

from svgelements import Matrix, Viewbox

from pilotage.interpretation import Role
from pilotage.io.svg.roles import Thing, names_of, role_of, thing_of
from pilotage.io.svg.style import Style, StyleSheet, is_named, local_name

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

DRAWN = ("path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "text", "foreignObject")
LIST_END = re.compile(r"[\s,]")
OUTLINED = "aria-label"
"""Where Inkscape keeps the words of a text that was turned into outlines."""

HOLDING = ("svg", "g", "a", "switch")
MEASURES = {
    "x": 0, "y": 1, "width": 0, "height": 1, "cx": 0, "cy": 1, "r": 2, "rx": 0, "ry": 1,
    "x1": 0, "y1": 1, "x2": 0, "y2": 1,
}  # fmt: skip
"""Attributes that are lengths, and of what their percentages are: width, height, diagonal of the viewport."""


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


@dataclass(frozen=True, slots=True)
class Drawn:
    """A shape or text with all that it has inherited."""

    element: Element
    measures: Mapping[str, str]  # attributes and declared properties, lengths in user units
    page_from_element: Matrix
    style: Style
    role: Role
    thing: Thing
    notes: Mapping[str, str]  # the data-... attributes of the element and all that hold it
    names: tuple[str, ...] = ()  # of all that hold it and its own, the outermost first
    groups: tuple[int, ...] = ()  # numbers of the groups and uses that hold it, the outermost first
    outlined: tuple[int, str] | None = None  # the text whose outlines it draws: its number, and its words


@dataclass(frozen=True, slots=True)
class Place:
    """Where the walk stands: the chain of elements from the root, and what they hand down."""

    chain: tuple[Element, ...]
    viewport: Viewport
    page_from_user: Matrix = field(default_factory=Matrix)
    style: Style = field(default_factory=Style)
    role: Role = Role.WALL
    thing: Thing = Thing.SOLID
    notes: Mapping[str, str] = field(default_factory=dict)
    names: tuple[str, ...] = ()
    groups: tuple[int, ...] = ()
    outlined: tuple[int, str] | None = None


MAX_ELEMENTS = 100_000
"""Elements of a drawing, repeated ones too: a few nested `use` could ask for millions."""

MAX_HANDED_DOWN = 20_000_000
"""Elements times what they stand in: for 100,000 elements 200, of which programs write some dozens."""

MAX_LETTERS = 2_000_000
"""Letters of all paths and lists of points together: some seconds of reading."""

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


def walk(root: Element) -> Iterator[Drawn]:
    """Yield every shape and text in drawing order, its points carried to the root's viewBox coordinates."""
    sheet = StyleSheet.of(root)
    by_id = {element.get("id"): element for element in root.iter() if element.get("id")}
    check_size(root)
    waiting = [Place((root,), read_page(root) or UNKNOWN_PAGE)]
    count, handed_down = 0, 0
    while waiting:
        place = waiting.pop()
        count += 1
        if count > MAX_ELEMENTS:
            raise ValueError(f"more than {MAX_ELEMENTS} elements, those that <use> repeats among them")
        handed_down += len(place.chain) * (1 + len(place.chain[-1]))
        if handed_down > MAX_HANDED_DOWN:
            raise ValueError("too many elements in each other")
        element = place.chain[-1]
        tag = local_name(element.tag) if isinstance(element.tag, str) else ""
        if tag not in DRAWN and tag not in HOLDING and tag != "use":
            continue
        declared = sheet.declared(place.chain)
        here = replace(
            place,
            page_from_user=Matrix(declared.get("transform", "")) * place.page_from_user,
            style=place.style.of_child(declared),
            role=role_of(element, place.role),
            thing=thing_of(element, place.thing),
            notes={**place.notes, **noted(element)},
            names=place.names + tuple(names_of(element)),
            groups=place.groups if tag in DRAWN else (*place.groups, count),
            outlined=(count, element.get(OUTLINED, "").strip()) if element.get(OUTLINED) else place.outlined,
        )
        if tag in DRAWN:
            measures = measured(declared, place.viewport)
            yield Drawn(
                element,
                measures,
                here.page_from_user,
                here.style,
                here.role,
                here.thing,
                here.notes,
                here.names,
                here.groups,
                here.outlined,
            )
        elif tag == "use":
            waiting.extend(used(here, by_id))
        else:
            inside = fitted(here, element) if tag == "svg" and len(here.chain) > 1 else here
            children = alternatives(element) if tag == "switch" else list(element)
            waiting.extend(replace(inside, chain=(*inside.chain, child)) for child in reversed(children))


def check_size(root: Element) -> None:
    """Raise ValueError for a document that would take minutes."""
    shapes = [node for node in root.iter() if isinstance(node.tag, str) and local_name(node.tag) in DRAWN]
    if len(shapes) > MAX_ELEMENTS:
        raise ValueError(f"more than {MAX_ELEMENTS} shapes")
    letters = sum(len(node.get(name, "")) for node in shapes for name in ("d", "points"))
    if letters > MAX_LETTERS:
        raise ValueError(f"paths of more than {MAX_LETTERS} letters")


def alternatives(switch: Element) -> list[Element]:
    """Choose what is drawn of a `switch`: its text, or its foreign object if no text says the same."""
    foreign = [child for child in switch if is_named(child, "foreignObject")]
    others = [child for child in switch if not is_named(child, "foreignObject")]
    said = {spoken(child) for child in others}
    return others if not foreign or spoken(foreign[0]) in said else foreign[:1]


def spoken(element: Element) -> str:
    """Join the words of an element, however they are broken into lines."""
    return "".join("".join(element.itertext()).split())


def noted(element: Element) -> dict[str, str]:
    """Collect the data-... attributes of an element."""
    return {name: value.strip() for name, value in element.attrib.items() if name.startswith("data-")}


def measured(declared: Mapping[str, str], viewport: Viewport) -> Mapping[str, str]:
    """Bring all lengths to user units."""
    lengths = {
        name: repr(viewport.length(LIST_END.split(declared[name])[0], axis))
        for name, axis in MEASURES.items()
        if declared.get(name, "auto") not in ("auto", "")
    }
    return {**{name: value for name, value in declared.items() if name not in MEASURES}, **lengths}


def used(place: Place, by_id: Mapping[str | None, Element]) -> Iterator[Place]:
    """Stand at what a `use` refers to, or nowhere if it is not in this file or holds the `use` itself."""
    use = place.chain[-1]
    target = by_id.get(next((v for n, v in use.attrib.items() if local_name(n) == "href"), "")[1:])
    if target is None or target in place.chain:
        return
    x, y = (place.viewport.length(use.get(name, "0"), axis) for axis, name in enumerate("xy"))
    there = replace(place, page_from_user=Matrix.translate(x, y) * place.page_from_user)
    if local_name(target.tag) != "symbol":
        yield replace(there, chain=(*there.chain, target))
        return
    symbol = replace(
        there,
        chain=(*there.chain, target),
        role=role_of(target, there.role),
        names=there.names + tuple(names_of(target)),
    )
    inside = fitted(symbol, use, offset=False)
    yield from (replace(inside, chain=(*inside.chain, child)) for child in reversed(target))


def fitted(place: Place, frame: Element, *, offset: bool = True) -> Place:
    """Fit the viewBox of a nested `svg` or a `symbol` into the frame that shows it."""
    content = place.chain[-1]
    old = place.viewport
    left, top = (old.length(frame.get(name, "0"), axis) if offset else 0.0 for axis, name in enumerate("xy"))
    width, height = (
        old.length(frame.get(name, "100%"), axis) for axis, name in enumerate(("width", "height"))
    )
    box = view_box(content)
    if box is None:
        shift = Matrix.translate(left, top) * place.page_from_user
        return replace(place, page_from_user=shift, viewport=Viewport(0.0, 0.0, width, height))
    fit = Viewbox.viewbox_transform(
        left, top, width, height, box.x, box.y, box.width, box.height, content.get("preserveAspectRatio")
    )
    return replace(place, page_from_user=Matrix(fit) * place.page_from_user, viewport=box)
