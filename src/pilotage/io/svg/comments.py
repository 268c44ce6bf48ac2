"""Words that matplotlib writes in a comment before the outlines of their letters."""

import html
import re
from xml.etree import ElementTree as ET

LABEL = "aria-label"
"""Where Inkscape keeps the words of a text that was turned into outlines; here those of matplotlib, too."""

TEXT = re.compile(r"text_\d+")
"""The id of a text of matplotlib, which holds the outlines line by line."""


class CommentReader(ET.TreeBuilder):
    """Build a tree in which the outlines of a line of words bear the words."""

    def __init__(self) -> None:
        """Begin outside of all elements."""
        super().__init__()
        self.holders: list[str] = []  # the ids of the elements that are open
        self.said = ""  # by a comment, since which nothing began or ended

    def comment(self, text: str | None, /) -> ET.Element:
        """Keep what a comment says for the element that follows."""
        self.said = html.unescape(text or "").strip()
        return super().comment(text)

    def start(self, tag: str, attrs: dict[str, str], /) -> ET.Element:
        """Begin an element."""
        if self.said and self.holders and TEXT.fullmatch(self.holders[-1]):
            attrs = {LABEL: self.said, **attrs}
        self.said = ""
        self.holders.append(attrs.get("id", ""))
        return super().start(tag, attrs)

    def end(self, tag: str, /) -> ET.Element:
        """End an element."""
        self.said = ""
        self.holders.pop()
        return super().end(tag)


def read_tree(written: bytes) -> ET.Element:
    """Parse XML; raises ParseError for what is none."""
    return ET.fromstring(written, ET.XMLParser(target=CommentReader()))  # noqa: S314  # expat itself refuses entity bombs
