"""Read the words of an SVG text line by line, and where the middle of each line is."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree.ElementTree import Element

import numpy as np

from pilotage.interpretation import Text
from pilotage.io.svg.reader import FARTHEST, apply
from pilotage.io.svg.style import declarations, is_named, leading_number, local_name
from pilotage.io.svg.tree import Drawn

GLYPH_WIDTH = 0.5
"""Mean width of a letter in font sizes: good enough to find the middle of a word."""

LINE_HEIGHT = 1.2
"""Distance of lines of text in a foreign object or a flowed text, in font sizes."""

BLOCKS = ("div", "p", "br", "li", "h1", "h2", "h3", "tr")
"""Elements of HTML that begin a line."""

NOT_A_WORD = ("Text is not SVG - cannot display", "Viewer does not support full SVG 1.1")
"""What draw.io writes for programs that do not read foreign objects."""

INSET = re.compile(r"\s*(-?[\d.]+)(px)?\s*")


@dataclass(frozen=True, slots=True)
class Line:
    """Words on one line of a text, where they begin in the element's own coordinates, and their size."""

    words: str
    x: float
    y: float
    size: float
    anchored: float  # where the middle is from x, in widths of the line


def read_texts(item: Drawn) -> Iterator[Text]:
    """Read the lines of a text, a flowed text or a foreign object, y up."""
    lines = READERS[local_name(item.element.tag)](item)
    matrix = item.page_from_element
    angle = math.atan2(-matrix.b, matrix.a)
    stretch = math.sqrt(abs(matrix.a * matrix.d - matrix.b * matrix.c))
    for line in lines:
        if line.words in NOT_A_WORD or not line.words:
            continue
        middle = line.x + line.anchored * len(line.words) * GLYPH_WIDTH * line.size
        x, y = apply(matrix, np.array([middle, line.y])).tolist()
        if not max(abs(x), abs(y)) <= FARTHEST:  # not a number, too
            raise ValueError(f"<text> stands farther away than {FARTHEST:g}")
        source = f"text {line.words!r}"
        yield Text(line.words, (x, -y), line.size * stretch, angle, item.names, item.groups, source)


def text_lines(item: Drawn) -> Iterator[Line]:
    """Read the lines of a text: a part that says where it stands, or is shifted down, begins one."""
    size = leading_number(item.style.values["font-size"], 16.0)
    anchored = {"middle": 0.0, "end": -0.5}.get(item.style.values["text-anchor"], 0.5)
    x, y = (leading_number(item.measures.get(name) or "0", 0.0) for name in "xy")
    words: list[str] = []
    for part, said in parts(item.element):
        if part is not None and starts_line(part) and "".join(words).strip():
            yield Line(" ".join("".join(words).split()), x, y, size, anchored)
            words = []
        if part is not None:
            own = declarations(part.get("style", ""))
            size = leading_number(part.get("font-size") or own.get("font-size", ""), size)
            anchor = part.get("text-anchor") or own.get("text-anchor", "")
            anchored = {"start": 0.5, "middle": 0.0, "end": -0.5}.get(anchor, anchored)
            x = leading_number(part.get("x") or "", x)
            y = leading_number(part.get("y") or "", y) + shift_of(part, size)
        words.append(said)
    yield Line(" ".join("".join(words).split()), x, y, size, anchored)


def parts(element: Element) -> Iterator[tuple[Element | None, str]]:
    """Walk the text of an element: each part with what it says first, and what follows it."""
    yield None, element.text or ""
    for child in element:
        if is_named(child, "title"):
            continue
        inner = parts(child)
        yield child, next(inner)[1]
        yield from inner
        yield None, child.tail or ""


def starts_line(part: Element) -> bool:
    """Tell whether a part of a text stands on a line of its own."""
    return (
        bool(part.get("y"))
        or shift_of(part, 1.0) != 0.0
        or "line" in (value for value in part.attrib.values())
    )


def shift_of(part: Element, size: float) -> float:
    """Read how far a part is shifted down [user units]."""
    written = part.get("dy") or ""
    shift = leading_number(written, 0.0)
    return shift * size if written.strip().endswith("em") else shift


def flowed_lines(item: Drawn) -> Iterator[Line]:
    """Read the paragraphs of a flowed text of Inkscape, each a line, from the top of its region on.

    Flowed text was planned for SVG 1.2 and came into no standard; browsers do not show it.
    """
    regions = [part for part in item.element.iter() if is_named(part, "rect")]
    if not regions:
        return
    left, top, width = (leading_number(regions[0].get(name, ""), 0.0) for name in ("x", "y", "width"))
    size = leading_number(item.style.values["font-size"], 16.0)
    for part in item.element.iter():
        if not is_named(part, "flowPara"):
            continue
        own = declarations(part.get("style", ""))
        size = leading_number(own.get("font-size", ""), size)
        align = own.get("text-anchor") or item.style.values["text-anchor"]
        x, anchored = {"middle": (left + width / 2.0, 0.0), "end": (left + width, -0.5)}.get(
            align, (left, 0.5)
        )
        yield Line(" ".join("".join(part.itertext()).split()), x, top + 0.5 * size, size, anchored)
        top += LINE_HEIGHT * size


def foreign_lines(item: Drawn) -> Iterator[Line]:
    """Read the lines of HTML inside a drawing, about the middle of their box."""
    element = item.element
    x, y, width, height = (
        leading_number(item.measures.get(name) or "0", 0.0) for name in ("x", "y", "width", "height")
    )
    size = leading_number(item.style.values["font-size"], 16.0)
    left, top, wide, centered = x, y, width, True
    for part in element.iter():
        own = declarations(part.get("style", ""))
        if "margin-left" in own and "padding-top" in own:  # draw.io
            left = x + leading_number(own["margin-left"], 0.0)
            top, height = y + leading_number(own["padding-top"], 0.0), 0.0
            wide = leading_number(own.get("width", ""), 0.0)
            centered = "center" in own.get("justify-content", "center")
        size = leading_number(own.get("font-size", ""), 0.0) or size
    lines = [words for words in html_lines(element) if words]
    for number, words in enumerate(lines):
        down = (number - (len(lines) - 1) / 2.0) * LINE_HEIGHT * size
        middle = left + wide / 2.0 if centered else left
        yield Line(words, middle, top + height / 2.0 + down, size, 0.0 if centered else 0.5)


def html_lines(element: Element) -> list[str]:
    """Join the words of HTML into lines."""
    lines = [""]
    for part, said in parts(element):
        if part is not None and any(is_named(part, name) for name in BLOCKS):
            lines.append("")
        lines[-1] += said
    return [" ".join(line.split()) for line in lines]


READERS = {"text": text_lines, "flowRoot": flowed_lines, "foreignObject": foreign_lines}
