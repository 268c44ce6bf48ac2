"""What an SVG element looks like, by what is declared for it and what it inherits."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
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


def is_named(node: Element, name: str) -> bool:
    """Tell whether a node is an element of this name; comments and instructions have no name."""
    return isinstance(node.tag, str) and local_name(node.tag) == name


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
