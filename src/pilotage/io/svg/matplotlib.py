"""What matplotlib tells of its shapes: words in comments, and frames of charts by what stands around them."""

import html
import re
from xml.etree import ElementTree as ET

from pilotage.io.svg.style import local_name
from pilotage.io.svg.tree import OUTLINED

TEXT = re.compile(r"text_\d+")
"""The id of a text, which holds the outlines line by line."""

AXIS = re.compile(r"matplotlib\.axis_\d+")
"""The id of an axis with its ticks, in the group of a chart."""

PATCH = re.compile(r"patch_\d+")
"""The id of a shape; one that is a straight line, beside axes, is a side of the chart's frame."""

STRAIGHT = re.compile(r"\s*M[^A-Za-z]*L[^A-Za-z]*")


class MatplotlibReader(ET.TreeBuilder):
    """Build a tree in which the outlines of a line of words bear the words, and frames of charts are axes."""

    def __init__(self) -> None:
        """Begin outside of all elements."""
        super().__init__()
        self.holders: list[str] = [""]  # the ids of the elements that are open
        self.said = ""  # by a comment, since which nothing began or ended
        self.depth_of_chart = 0  # how deep the shapes of the chart with axes stand; 0 outside of any

    def comment(self, text: str | None, /) -> ET.Element:
        """Keep what a comment says for the element that follows."""
        self.said = html.unescape(text or "").strip()
        return super().comment(text)

    def start(self, tag: str, attrs: dict[str, str], /) -> ET.Element:
        """Begin an element."""
        holder, depth = self.holders[-1], len(self.holders)
        if self.said and TEXT.fullmatch(holder):
            attrs = {OUTLINED: self.said, **attrs}
        elif depth == self.depth_of_chart + 1 and PATCH.fullmatch(holder) and is_straight(tag, attrs):
            attrs = {"class": "axis", **attrs}
        name = attrs.get("id", "")
        if AXIS.fullmatch(name):
            self.depth_of_chart = depth
        self.said = ""
        self.holders.append(name)
        return super().start(tag, attrs)

    def end(self, tag: str, /) -> ET.Element:
        """End an element."""
        self.said = ""
        self.holders.pop()
        if len(self.holders) < self.depth_of_chart:
            self.depth_of_chart = 0
        return super().end(tag)


def is_straight(tag: str, attrs: dict[str, str]) -> bool:
    """Tell whether an element draws a straight line.

    >>> is_straight("path", {"d": "M 1 2 L 3 2 "}), is_straight("path", {"d": "M 1 2 L 3 2 L 5 5"})
    (True, False)
    """
    return local_name(tag) == "path" and STRAIGHT.fullmatch(attrs.get("d", "")) is not None


def read_tree(written: bytes) -> ET.Element:
    """Parse XML; raises ParseError for what is none."""
    return ET.fromstring(written, ET.XMLParser(target=MatplotlibReader()))  # noqa: S314  # expat itself refuses entity bombs
