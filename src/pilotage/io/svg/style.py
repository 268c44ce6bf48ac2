"""What an SVG element looks like: attributes, `style`, and style sheets (CSS 2.1's plain selectors)."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Self
from xml.etree.ElementTree import Element

from svgelements import Color

INITIAL: Mapping[str, str] = {
    "fill": "black",
    "stroke": "none",
    "stroke-width": "1",
    "stroke-dasharray": "none",
    "stroke-opacity": "1",
    "fill-opacity": "1",
    "fill-rule": "nonzero",
    "visibility": "visible",
    "color": "black",
    "font-size": "16",
    "text-anchor": "start",
}
"""The properties that children inherit and that matter here, with the values a document begins with."""

BRACE = re.compile(r"[{};]")
ATTRIBUTE = r"\[([\w:-]+)(?:([~|^$*]?=)[\"']?([^\"'\]\s]*)[\"']?)?\]"
COMPOUND = re.compile(rf"([\w-]+|\*)?((?:[.#][\w-]+|{ATTRIBUTE})*)")
PART = re.compile(rf"([.#])([\w-]+)|{ATTRIBUTE}")
NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(%?)")

CHOICE = re.compile(r"\s*(?:light-dark\(((?:[^(),]|\([^()]*\))+),.*\)|var\([^,()]*,(.*)\))\s*", re.DOTALL)
"""Functions of CSS that offer two paints."""

MIX = re.compile(r"\s*color-mix\([^,]*,\s*((?:[^(),\s]|\([^()]*\))+)[^,]*,.*\)\s*", re.DOTALL)
"""A function of CSS that mixes two paints: the first is taken for both."""

VARIABLE = re.compile(r"var\(\s*(--[\w-]+)\s*(?:,((?:[^()]|\([^()]*\))*))?\)")
"""A variable of CSS, and what stands in for it."""

MAX_VALUE = 1000
"""Letters of a value once variables are put in."""

MAX_VARIABLES = 8
"""So many variables may stand for each other."""


def local_name(name: str) -> str:
    """Take the namespace off a tag or an attribute.

    >>> local_name("{http://www.w3.org/2000/svg}rect")
    'rect'
    """
    return name.rpartition("}")[2]


def leading_number(text: str, otherwise: float) -> float:
    """Read the number a value begins with, percent as a share.

    >>> leading_number("50%", 1.0), leading_number("2px", 1.0), leading_number("bold", 1.0)
    (0.5, 2.0, 1.0)
    """
    match = NUMBER.match(text)
    if match is None:
        return otherwise
    return float(match[1]) * (0.01 if match[2] else 1.0)


def declarations(text: str) -> dict[str, str]:
    """Split `name: value; ...`."""
    pairs = (part.partition(":") for part in text.split(";"))
    return {
        name.strip().lower(): value.replace("!important", "").strip() for name, colon, value in pairs if colon
    }


def resolved(paint: str) -> str:
    """Choose the paint of a light page, and what stands in for a variable.

    >>> resolved("light-dark(#ffffff, var(--dark))"), resolved("var(--ink, rgb(0, 0, 0))")
    ('#ffffff', 'rgb(0, 0, 0)')
    """
    while match := CHOICE.fullmatch(paint) or MIX.fullmatch(paint):
        paint = (match[1] or match[match.re.groups] or "none").strip()
    return paint


def with_variables(value: str, variables: Mapping[str, str]) -> str:
    """Put what they stand for in place of variables; one that nobody set and without a stand-in stays.

    >>> with_variables("var(--wall, red)", {"--wall": "var(--ink)", "--ink": "blue"})
    'blue'
    """

    def told(match: re.Match[str]) -> str:
        return variables.get(match[1].lower(), match[0] if match[2] is None else match[2].strip())

    for _ in range(MAX_VARIABLES):
        if "var(" not in value or (new := VARIABLE.sub(told, value)) == value or len(new) > MAX_VALUE:
            break
        value = new
    return value


@dataclass(frozen=True, slots=True)
class Selector:
    """A chain of compounds such as `g.walls > line`; the last one is the element's own."""

    compounds: tuple[str, ...]
    child: tuple[
        bool, ...
    ]  # whether compound k must be the parent of compound k + 1, and not only an ancestor

    @classmethod
    def read(cls, text: str) -> Self | None:
        """Read one selector; None for what is not understood (pseudo-classes, siblings)."""
        compounds: list[str] = []
        child: list[bool] = []
        direct = False
        for part in text.replace(">", " > ").split():
            if part == ">":
                direct = True
                continue
            if COMPOUND.fullmatch(part) is None:
                return None
            if compounds:
                child.append(direct)
            compounds.append(part)
            direct = False
        return cls(tuple(compounds), tuple(child)) if compounds else None

    @property
    def specificity(self) -> tuple[int, int, int]:
        """How many ids, classes or attributes, and tags it names: the more specific rule wins."""
        kinds = [part[1] for compound in self.compounds for part in PART.finditer(compound)]
        tags = sum(compound[0] not in ".#*[" for compound in self.compounds)
        return kinds.count("#"), len(kinds) - kinds.count("#"), tags

    def matches(self, chain: Sequence[Element]) -> bool:
        """Tell whether it selects the last element of a chain that begins at the root.

        Goes up the chain once, with all compounds that an element may stand for.
        """
        wanted, descendants = {len(self.compounds) - 1}, set[int]()
        for element in reversed(chain):
            found = {k for k in wanted if compound_matches(self.compounds[k], element)}
            if 0 in found:
                return True
            descendants |= {k - 1 for k in found if not self.child[k - 1]}
            wanted = descendants | {k - 1 for k in found}
            if not wanted:
                return False
        return False


def compound_matches(compound: str, element: Element) -> bool:
    """Tell whether tag, ids, classes and attributes of one compound are all the element's."""
    match = COMPOUND.fullmatch(compound)
    assert match is not None, "Selector.read lets no other through"
    if match[1] not in (None, "*", local_name(element.tag)):
        return False
    return all(part_matches(part, element) for part in PART.finditer(match[2]))


def part_matches(part: re.Match[str], element: Element) -> bool:
    """Tell whether an id, a class or an attribute of a compound is the element's."""
    kind, name, attribute, how, wanted = part.groups()
    if kind is not None:
        return name == element.get("id") if kind == "#" else name in element.get("class", "").split()
    value = next((value for key, value in element.attrib.items() if local_name(key) == attribute), None)
    if value is None or how is None:
        return value is not None
    return {
        "=": value == wanted,
        "~=": wanted in value.split(),
        "|=": value == wanted or value.startswith(f"{wanted}-"),
        "^=": bool(wanted) and value.startswith(wanted),
        "$=": bool(wanted) and value.endswith(wanted),
        "*=": bool(wanted) and wanted in value,
    }[how]


@dataclass(frozen=True, slots=True)
class StyleSheet:
    """The rules of all `<style>` elements, the least specific first."""

    rules: tuple[tuple[Selector, Mapping[str, str]], ...] = ()

    @classmethod
    def of(cls, root: Element) -> Self:
        """Collect the rules of a document."""
        texts = ("".join(node.itertext()) for node in root.iter() if is_named(node, "style"))
        rules = [rule for text in texts for rule in read_rules(text)]
        return cls(tuple(sorted(rules, key=lambda rule: rule[0].specificity)))  # stable: the later one wins

    def declared(self, chain: Sequence[Element]) -> dict[str, str]:
        """Collect what is declared for the last element of a chain: attributes, then rules, then `style`."""
        element = chain[-1]
        found = {local_name(name): value.strip() for name, value in element.attrib.items()}
        for selector, values in self.rules:
            if selector.matches(chain):
                found.update(values)
        found.update(declarations(element.get("style", "")))
        return found


def is_named(node: Element, name: str) -> bool:
    """Tell whether a node is an element of this name; comments and instructions have no name."""
    return isinstance(node.tag, str) and local_name(node.tag) == name


def read_rules(text: str) -> Iterator[tuple[Selector, Mapping[str, str]]]:
    """Read the rules of a style sheet that this reader understands."""
    for names, body in plain_blocks(without_comments(text)):
        for name in names.split(","):
            selector = Selector.read("svg" if name.strip() == ":root" else name)
            if selector is not None:
                yield selector, declarations(body)


def without_comments(text: str) -> str:
    """Take away comments of CSS, and the marks of those of XML.

    >>> without_comments("a /* b */ c <!-- d")
    'a  c  d'
    """
    head, *others = text.split("/*")
    kept = "".join([head, *(part.partition("*/")[2] for part in others)])
    return kept.replace("<!--", "").replace("-->", "")


def plain_blocks(text: str) -> Iterator[tuple[str, str]]:
    """Yield what stands before each pair of braces and in it; @-rules and what is in them are left out.

    >>> list(plain_blocks("@import x; a {b: c} @media print {d {e: f}} g {}"))
    [(' a ', 'b: c'), (' g ', '')]
    """
    depth, start, names = 0, 0, ""
    for mark in BRACE.finditer(text):
        if mark[0] == "{":
            if depth == 0:
                names, start = text[start : mark.start()], mark.end()
            depth += 1
        elif mark[0] == "}":
            if depth == 1 and not names.lstrip().startswith("@"):
                yield names, text[start : mark.start()]
            depth = max(depth - 1, 0)
            start = mark.end() if depth == 0 else start
        elif depth == 0:
            start = mark.end()


@dataclass(frozen=True, slots=True)
class Style:
    """What an element has inherited and what it says itself."""

    values: Mapping[str, str] = field(default_factory=lambda: INITIAL)
    opacity: float = 1.0  # of the element and all that hold it, multiplied
    displayed: bool = True

    def of_child(self, declared: Mapping[str, str]) -> "Style":
        """Resolve a child's style from what it declares."""
        variables = {name: value for name, value in declared.items() if name.startswith("--")}
        known = {**self.values, **variables}
        own = {
            name: with_variables(declared[name], known)
            for name in INITIAL
            if declared.get(name, "inherit") != "inherit"
        }
        opacity = leading_number(declared.get("opacity", "1"), 1.0)
        displayed = declared.get("display", "inline") != "none"
        return Style({**known, **own}, self.opacity * opacity, self.displayed and displayed)

    @property
    def there(self) -> bool:
        """Whether the element is there at all; one that is as clear as glass can still be pointed at."""
        return self.displayed and self.values["visibility"] == "visible"

    @property
    def shown(self) -> bool:
        """Whether the element is shown at all."""
        return self.there and self.opacity > 0.0

    @property
    def stroked(self) -> bool:
        """Whether its line can be seen."""
        width = leading_number(self.values["stroke-width"], 1.0)
        return self.shown and width > 0.0 and self._painted("stroke")

    @property
    def filled(self) -> bool:
        """Whether its area can be seen."""
        return self.shown and self._painted("fill")

    def paint(self, name: str) -> str:
        """Return the paint of "stroke" or "fill" as it is written."""
        value = resolved(self.values[name])
        return resolved(self.values["color"]) if value.lower() == "currentcolor" else value

    def _painted(self, name: str) -> bool:
        color = Color(self.paint(name))
        if color.value is None or color.opacity == 0.0:
            return False
        return leading_number(self.values[f"{name}-opacity"], 1.0) > 0.0
