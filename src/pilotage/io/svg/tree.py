"""Walk an SVG document as it is drawn: transforms, styles and roles handed down, `use` followed."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple
from xml.etree.ElementTree import Element

from svgelements import Matrix, Viewbox

from pilotage.interpretation import Role
from pilotage.io.svg.roles import Thing, names_of, role_of, thing_of
from pilotage.io.svg.servers import REFERENCE, PaintServers
from pilotage.io.svg.style import Style, is_named, local_name, with_variables
from pilotage.io.svg.style_sheet import StyleSheet
from pilotage.io.svg.viewport import UNKNOWN_PAGE, Viewport, read_page, view_box

WORDED = ("text", "foreignObject", "flowRoot")
DRAWN = ("path", "rect", "circle", "ellipse", "line", "polyline", "polygon", *WORDED)
HOLDING = ("svg", "g", "a", "switch")
LIST_END = re.compile(r"[\s,]")
OUTLINED = "aria-label"
"""Where Inkscape keeps the words of a text that was turned into outlines; here those of matplotlib, too."""

MEASURES = {
    "x": 0, "y": 1, "width": 0, "height": 1, "cx": 0, "cy": 1, "r": 2, "rx": 0, "ry": 1,
    "x1": 0, "y1": 1, "x2": 0, "y2": 1,
}  # fmt: skip
"""Attributes that are lengths, and of what their percentages are: width, height, diagonal of the viewport."""

MAX_ELEMENTS = 100_000
"""Elements of a drawing, repeated ones too: a few nested `use` could ask for millions."""

MAX_HANDED_DOWN = 20_000_000
"""Elements times what they stand in: for 100,000 elements 200, of which programs write some dozens."""

MAX_LETTERS = 2_000_000
"""Letters of all paths and lists of points together: some seconds of reading."""


ClipUse = tuple[str, Matrix]
"""The id of a `clipPath`, and the map from the user space of what it cuts to the page."""


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
    clips: tuple[ClipUse, ...] = ()  # what cuts it, and all that hold it


class Place(NamedTuple):  # two of three steps of a walk replace a part of it: as a tuple that is quick
    """Where the walk stands: the chain of elements from the root, and what they hand down."""

    chain: tuple[Element, ...]
    viewport: Viewport
    page_from_user: Matrix
    style: Style
    notes: Mapping[str, str]
    role: Role = Role.WALL
    thing: Thing = Thing.SOLID
    names: tuple[str, ...] = ()
    groups: tuple[int, ...] = ()
    outlined: tuple[int, str] | None = None
    clips: tuple[ClipUse, ...] = ()


@dataclass
class Effort:
    """How much has been walked; a few lines can ask for millions of elements."""

    elements: int = 0
    handed_down: int = 0

    def spend(self, place: Place) -> None:
        """Count a step; raises ValueError if it is one too many."""
        self.elements += 1
        if self.elements > MAX_ELEMENTS:
            raise ValueError(f"more than {MAX_ELEMENTS} elements, those that <use> repeats among them")
        self.handed_down += len(place.chain) * (1 + len(place.chain[-1]))
        if self.handed_down > MAX_HANDED_DOWN:
            raise ValueError("too many elements in each other")


class Document:
    """An SVG document, and what its elements refer to; `page` is the root's viewBox."""

    def __init__(self, root: Element) -> None:
        """Collect ids and styles; raises ValueError for a document that would take minutes."""
        check_size(root)
        self.page = read_page(root)
        self.start = Place((root,), self.page or UNKNOWN_PAGE, Matrix(), Style(), {})
        self.sheet = StyleSheet.of(root)
        backwards = reversed(list(root.iter()))  # of two elements with one id the first counts
        self.by_id = {element.get("id"): element for element in backwards if element.get("id")}
        self.servers = PaintServers(self.by_id, self.sheet)
        self.effort_for_clips = Effort()

    @property
    def declared_of_root(self) -> Mapping[str, str]:
        """What attributes and style say of the whole drawing, variables put in."""
        declared = self.sheet.declared(self.start.chain)
        return {name: with_variables(value, declared) for name, value in declared.items()}

    def walk(self) -> Iterator[Drawn]:
        """Yield every shape and text in drawing order."""
        return walk([self.start], self, Effort())

    def walk_clip(self, use: ClipUse) -> Iterator[Drawn]:
        """Yield the shapes of a `clipPath`; none if not in this file, or measured in what it cuts."""
        name, page_from_user = use
        clip = self.by_id.get(name)
        if clip is None or not is_named(clip, "clipPath") or clip.get("clipPathUnits") == "objectBoundingBox":
            return iter(())
        page_from_clip = Matrix(clip.get("transform", "")) * page_from_user
        chain = (*self.start.chain, clip)
        places = [self.start._replace(chain=(*chain, child), page_from_user=page_from_clip) for child in clip]
        return walk(places, self, self.effort_for_clips)


def walk(places: Sequence[Place], document: Document, effort: Effort) -> Iterator[Drawn]:
    """Yield every shape and text at these places and in what they hold, in drawing order."""
    sheet = document.sheet
    waiting = list(reversed(places))
    while waiting:
        place = waiting.pop()
        effort.spend(place)
        count = effort.elements
        element = place.chain[-1]
        tag = local_name(element.tag) if isinstance(element.tag, str) else ""
        if tag not in DRAWN and tag not in HOLDING and tag != "use":
            continue
        declared = sheet.declared(place.chain)
        page_from_user = Matrix(declared.get("transform", "")) * place.page_from_user
        clip = REFERENCE.fullmatch(declared.get("clip-path", ""))
        here = place._replace(
            page_from_user=page_from_user,
            style=document.servers.plain(place.style.of_child(declared)),
            role=role_of(element, place.role),
            thing=thing_of(element, place.thing),
            notes={**place.notes, **noted(element)},
            names=place.names + tuple(names_of(element)),
            groups=place.groups if tag in DRAWN else (*place.groups, count),
            outlined=(count, element.get(OUTLINED, "").strip()) if element.get(OUTLINED) else place.outlined,
            clips=(*place.clips, (clip[1], page_from_user)) if clip else place.clips,
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
                here.clips,
            )
        elif tag == "use":
            waiting.extend(used(here, document.by_id, sheet))
        else:
            inside = fitted(here, element) if tag == "svg" and len(here.chain) > 1 else here
            children = alternatives(element) if tag == "switch" else list(element)
            waiting.extend(inside._replace(chain=(*inside.chain, child)) for child in reversed(children))


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


def used(place: Place, by_id: Mapping[str | None, Element], sheet: StyleSheet) -> Iterator[Place]:
    """Stand at what a `use` refers to, or nowhere if it is not in this file or holds the `use` itself."""
    use = place.chain[-1]
    target = by_id.get(next((v for n, v in use.attrib.items() if local_name(n) == "href"), "")[1:])
    if target is None or target in place.chain:
        return
    x, y = (place.viewport.length(use.get(name, "0"), axis) for axis, name in enumerate("xy"))
    there = place._replace(page_from_user=Matrix.translate(x, y) * place.page_from_user)
    if local_name(target.tag) != "symbol":
        yield there._replace(chain=(*there.chain, target))
        return
    chain = (*there.chain, target)
    declared = {**sheet.declared(chain), "display": "inline"}  # a symbol that is used is shown
    symbol = there._replace(
        chain=chain,
        style=there.style.of_child(declared),
        role=role_of(target, there.role),
        names=there.names + tuple(names_of(target)),
    )
    inside = fitted(symbol, use, offset=False)
    yield from (inside._replace(chain=(*inside.chain, child)) for child in reversed(target))


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
        return place._replace(page_from_user=shift, viewport=Viewport(0.0, 0.0, width, height))
    fit = Viewbox.viewbox_transform(
        left, top, width, height, box.x, box.y, box.width, box.height, content.get("preserveAspectRatio")
    )
    return place._replace(page_from_user=Matrix(fit) * place.page_from_user, viewport=box)
