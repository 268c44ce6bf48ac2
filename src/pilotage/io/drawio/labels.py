"""Labels of draw.io's cells: HTML stripped, placed as the style says."""

import html
import math
import re
from collections.abc import Iterator

import numpy as np

from pilotage.interpretation.sheet import Text
from pilotage.io.drawio.cells import Box, number
from pilotage.io.drawio.floorplan import Style

LINE_END = re.compile(r"<br\b[^>]*>|</(?:div|p|li|h\d|tr)\s*>|<(?:div|p|h\d)\b[^>]*>", re.IGNORECASE)
TAG = re.compile(r"<[^<>]*>")

LETTER_WIDTH = 0.5
"""Mean width of a letter, as a share of the size of the font."""

LINE_STEP = 1.2
"""Distance of two base lines, as a share of the size of the font."""

CAPITAL = 0.72
"""Height of a capital, as a share of the size of the font."""

LONGEST = 20_000
"""Letters of a label that are read."""


def lines_of(value: str) -> list[str]:
    """Return the lines of a label without tags.

    >>> lines_of("<b>Bed</b>&nbsp;room<br><div>2.5 m&sup2;</div>")
    ['Bed room', '2.5 m²']
    """
    text = TAG.sub("", LINE_END.sub("\n", value[:LONGEST]))
    lines = (" ".join(html.unescape(line).split()) for line in text.split("\n"))
    return [line for line in lines if line]


def read_label(
    value: str, box: Box, style: Style, names: tuple[str, ...], groups: tuple[int, ...]
) -> Iterator[Text]:
    """Place the lines of a label on the page, y up."""
    lines = lines_of(value)
    if not lines:
        return
    size = number(style.get("fontSize", ""), 12.0)
    height = LINE_STEP * size * len(lines)
    outside = {"left": -1.0, "right": 1.0, "top": -1.0, "bottom": 1.0}
    side = outside.get(style.get("labelPosition", ""), 0.0)
    level = outside.get(style.get("verticalLabelPosition", ""), 0.0)
    align = outside.get(style.get("align", ""), 0.0)
    vertical = outside.get(style.get("verticalAlign", ""), 0.0)
    sideways = 90.0 if style.get("horizontal") == "0" else 0.0
    turn = math.radians(number(style.get("rotation", ""), 0.0) - sideways)
    cosine, sine = math.cos(turn), math.sin(turn)
    for k, line in enumerate(lines):
        width = LETTER_WIDTH * size * len(line)
        across = side * box.width + align * (box.width - width) / 2.0
        down = level * box.height + vertical * (box.height - height) / 2.0
        down += (k + 0.5) * LINE_STEP * size - height / 2.0
        x, y = box.middle + np.array([cosine * across - sine * down, sine * across + cosine * down])
        yield Text(line, (float(x), float(-y)), CAPITAL * size, -turn, names, groups, f'"{line}"')
