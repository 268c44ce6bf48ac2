"""Words of a PDF page: letters joined into lines."""

import ctypes
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pypdfium2.raw as pdfium

from pilotage.geometry import Affine2
from pilotage.interpretation.sheet import Text

if TYPE_CHECKING:
    import pypdfium2

CAPITAL = 0.72
"""Height of a capital, as a share of the size of a font."""

WIDEST_SPACE = 1.5
"""A wider gap along the line than this many font sizes begins other words."""

SPACE = 0.2
"""A gap of this many font sizes is a space."""

HIGHEST_STEP = 0.5
"""A letter this many font sizes off the base line begins another line."""

MOST_LETTERS = 200_000
"""Letters of a page that are read."""


@dataclass(frozen=True, slots=True)
class Letter:
    """A letter on the page as it is shown [points]."""

    letter: str
    start: complex  # on the base line
    end: complex
    size: float  # of its font
    angle: float  # of the base line [rad]


def read_texts(page: "pypdfium2.PdfPage", shown_from_content: Affine2) -> Iterator[Text]:
    """Read the words of a page, line by line."""
    line: list[Letter] = []
    painted: set[Letter] = set()
    for letter in letters_of(page, shown_from_content):
        if letter in painted:
            continue  # first its halo was painted
        if letter is not None:
            painted.add(letter)
        if letter is None or (line and not follows(line[-1], letter)):
            yield from joined(line)
            line = []
        if letter is not None:
            line.append(letter)
    yield from joined(line)


def letters_of(page: "pypdfium2.PdfPage", shown_from_content: Affine2) -> Iterator[Letter | None]:
    """Read the letters of a page in the order of its content; None where a line ends."""
    words = page.get_textpage()
    x, y, left, right, bottom, top = (ctypes.c_double() for _ in range(6))
    matrix = pdfium.FS_MATRIX()
    for k in range(min(words.count_chars(), MOST_LETTERS)):
        code = pdfium.FPDFText_GetUnicode(words, k)
        if pdfium.FPDFText_IsGenerated(words, k) == 1 or code in (0, 10, 13):
            if code in (10, 13):
                yield None
            continue
        pdfium.FPDFText_GetCharOrigin(words, k, x, y)
        pdfium.FPDFText_GetCharBox(words, k, left, right, bottom, top)
        pdfium.FPDFText_GetMatrix(words, k, matrix)
        scale = math.hypot(matrix.c, matrix.d)
        along = shown_from_content.linear @ np.array([matrix.a, matrix.b])
        angle = math.atan2(along[1], along[0])
        box = np.array([[left.value, bottom.value], [right.value, top.value], [x.value, y.value]])
        low, high, origin = (complex(*point) for point in shown_from_content @ box)
        direction = complex(math.cos(angle), math.sin(angle))
        corners = [low, high, complex(low.real, high.imag), complex(high.real, low.imag)]
        reach = max(((corner - origin) / direction).real for corner in corners)
        yield Letter(
            chr(code),
            origin,
            origin + direction * reach,
            pdfium.FPDFText_GetFontSize(words, k) * scale,
            angle,
        )
    words.close()


def follows(before: Letter, letter: Letter) -> bool:
    """Tell whether a letter continues the line of another."""
    turn = math.remainder(letter.angle - before.angle, 2.0 * math.pi)
    step = step_between(before, letter)
    size = max(before.size, letter.size)
    return (
        abs(turn) < 0.1
        and abs(step.imag) <= HIGHEST_STEP * size
        and -WIDEST_SPACE * size <= step.real <= WIDEST_SPACE * size
    )


def step_between(before: Letter, letter: Letter) -> complex:
    """Return how far a letter begins behind the end of another, and above its base line.

    Letters of a ligature begin where it does, so this may be less than nothing.
    """
    return (letter.start - before.end) * complex(math.cos(before.angle), -math.sin(before.angle))


def joined(line: list[Letter]) -> Iterator[Text]:
    """Join letters of one line; a gap is measured from the farthest letter, for some stand on others."""
    letters = [letter for letter in line if letter.letter.strip()]
    if not letters:
        return
    words, last = "", line[0]
    direction = complex(math.cos(line[0].angle), math.sin(line[0].angle))
    for letter in line:
        if words and not words.endswith(" ") and step_between(last, letter).real > SPACE * letter.size:
            words += " "
        words += letter.letter
        last = letter if ((letter.end - last.end) / direction).real > 0.0 else last
    size = float(np.median([letter.size for letter in letters]))
    angle = letters[0].angle
    upright = complex(-math.sin(angle), math.cos(angle))
    middle = (letters[0].start + letters[-1].end) / 2.0 + upright * CAPITAL * size / 2.0
    yield Text(words.strip(), (middle.real, middle.imag), CAPITAL * size, angle, source=f'"{words.strip()}"')
