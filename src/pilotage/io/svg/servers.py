"""The color that stands for a gradient or a pattern: `fill="url(#wood)"`."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from xml.etree.ElementTree import Element

import numpy as np
from svgelements import Color

from pilotage.io.svg.style import INITIAL, Style, is_named, leading_number, local_name
from pilotage.io.svg.style_sheet import StyleSheet

REFERENCE = re.compile(r"\s*url\(\s*[\"']?#([^\"')]*)[\"']?\s*\)\s*(.*)")
GRADIENTS = ("linearGradient", "radialGradient")

NUMBER = r"[-+]?[\d.]+"
POINT = rf"\s*{NUMBER}(?:[\s,]+|(?=[-+])){NUMBER}\s*"
STRAIGHT = re.compile(rf"\s*(?:[Mm]{POINT}(?:[Ll]{POINT}|[HhVv]\s*{NUMBER}\s*))+")
"""A path of single lines: it has no area to fill."""

UNKNOWN = "black"
"""The color of what is not known: something is to be seen there."""

SPARSE = 0.08
"""Lines thinner than this share of a pattern's width let the paper through: squared paper, no hatching."""

FAINT = 0.5
"""A gradient that hides less than this share of what is below draws nothing."""

MAX_HREFS = 8
"""So many gradients or patterns may refer to each other."""

MAX_SHAPES = 100
"""So many shapes of a pattern are looked at."""


@dataclass(frozen=True, eq=False)
class PaintServers:
    """The gradients and patterns of a drawing; each is looked at once for each setting of its variables."""

    by_id: Mapping[str | None, Element]
    sheet: StyleSheet
    colors: dict[tuple[str, tuple[tuple[str, str], ...]], str | None] = field(default_factory=dict)

    def plain(self, style: Style) -> Style:
        """Put colors in place of references to gradients and patterns."""
        found = {name: REFERENCE.fullmatch(style.values[name]) for name in ("fill", "stroke")}
        plain = {
            name: self.color_of(match[1], style) or match[2] or UNKNOWN
            for name, match in found.items()
            if match is not None
        }
        return replace(style, values={**style.values, **plain}) if plain else style

    def color_of(self, name: str, style: Style) -> str | None:
        """Return the mean color of a gradient, or the color that most of a pattern has; None if unknown."""
        variables = {key: value for key, value in style.values.items() if key.startswith("--")}
        asked = name, tuple(sorted(variables.items()))
        if asked not in self.colors:
            self.colors[asked] = color_of_server(name, variables, self.by_id, self.sheet)
        return self.colors[asked]


def color_of_server(
    name: str, variables: Mapping[str, str], by_id: Mapping[str | None, Element], sheet: StyleSheet
) -> str | None:
    """Return the color of a gradient or a pattern under these variables; None if there is none."""
    server = by_id.get(name)
    for _ in range(MAX_HREFS):
        if server is None:
            return None
        children = [child for child in server if isinstance(child.tag, str)]
        if children:
            chain = (server,)
            outer = Style({**INITIAL, **variables}).of_child(sheet.declared(chain))
            return (
                mean_of_stops(chain, children, outer, sheet)
                if any(is_named(server, kind) for kind in GRADIENTS)
                else ground_of(chain, children, outer, sheet)
            )
        href = next((value for key, value in server.attrib.items() if local_name(key) == "href"), "")
        server = by_id.get(href[1:])
    return None


def mean_of_stops(
    chain: Sequence[Element], stops: Sequence[Element], outer: Style, sheet: StyleSheet
) -> str | None:
    """Mix the stops of a gradient; None if it lets through what is below: it is a glint or a shadow.

    The light of a lamp lets most through: it is "none".
    """
    colors = []
    for stop in stops:
        if not is_named(stop, "stop"):
            continue
        declared = sheet.declared((*chain, stop))
        shown = outer.of_child({**declared, "fill": declared.get("stop-color", "black")})
        color = Color(shown.paint("fill"))
        opacity = leading_number(declared.get("stop-opacity", "1"), 1.0) * float(color.opacity or 0.0)
        colors.append((color.red or 0, color.green or 0, color.blue or 0, opacity))
    if not colors:
        return None
    if np.mean([opacity for *_, opacity in colors]) < FAINT:
        return "none"
    is_solid = min(opacity for *_, opacity in colors) >= 1.0
    return rgba(np.mean(colors, axis=0).tolist()) if is_solid else None


def ground_of(
    chain: Sequence[Element], shapes: Sequence[Element], outer: Style, sheet: StyleSheet
) -> str | None:
    """Return the first fill of a pattern, upon which all else is drawn; else the color of its lines.

    Sparse lines let the paper through: then it is none.
    """
    tile = leading_number(chain[0].get("width", ""), 0.0) if is_in_user_units(chain[0]) else 0.0
    leaves: list[tuple[Style, bool]] = []
    waiting = [((*chain, shape), outer) for shape in reversed(shapes)]
    while waiting and len(leaves) < MAX_SHAPES:
        place, above = waiting.pop()
        style = above.of_child(sheet.declared(place))
        inner = [child for child in place[-1] if isinstance(child.tag, str)]
        if inner:
            waiting.extend(((*place, child), style) for child in reversed(inner))
        else:
            leaves.append((style, has_area(place[-1])))
    for name in ("fill", "stroke"):
        for style, is_area in leaves:
            is_shown = is_area and style.filled if name == "fill" else style.stroked
            if is_shown and not REFERENCE.match(style.paint(name)):
                if name == "stroke" and leading_number(style.values["stroke-width"], 1.0) < SPARSE * tile:
                    return "none"
                color = Color(style.paint(name))
                opacity = leading_number(style.values[f"{name}-opacity"], 1.0) * float(color.opacity or 0.0)
                return rgba((color.red or 0, color.green or 0, color.blue or 0, opacity * style.opacity))
    return None


def is_in_user_units(pattern: Element) -> bool:
    """Tell whether the width of a pattern is no share of what it fills."""
    return pattern.get("patternUnits") == "userSpaceOnUse" and "%" not in pattern.get("width", "")


def has_area(shape: Element) -> bool:
    """Tell whether there is something to fill: not so for a line, though it may be said to be filled."""
    if is_named(shape, "path"):
        return STRAIGHT.fullmatch(shape.get("d", "")) is None
    return not is_named(shape, "line")


def rgba(channels: Sequence[float]) -> str:
    """Write a color: red, green and blue from 0 to 255 and an opacity from 0 to 1.

    >>> rgba((255.0, 127.6, 0.0, 0.5))
    'rgba(255, 128, 0, 0.5)'
    """
    red, green, blue, opacity = channels
    return f"rgba({round(red)}, {round(green)}, {round(blue)}, {opacity:g})"
