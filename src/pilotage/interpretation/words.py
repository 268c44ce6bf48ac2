"""Join lines of words to names, and set areas and measures apart."""

import math
import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.geometry import Polyline, segments_of
from pilotage.interpretation.names import meaning_of, name_words
from pilotage.interpretation.sheet import Role, Text

LEADING = 2.1
"""Lines of one name are no farther apart than so many heights of their letters."""

GLYPH_WIDTH = 0.5
"""Mean width of a letter in heights of a line."""

EAST_ASIAN = {"CJK", "HIRAGANA", "KATAKANA", "KATAKANA-HIRAGANA", "HANGUL", "FULLWIDTH", "HALFWIDTH"}
"""First words of the names of letters that are written side by side."""

ALIKE = 1.35
"""Lines of one name differ in height by no more than this factor."""

UNITS = frozenset({
    "mm", "cm", "m", "ft", "feet", "in", "inch", "inches", "sq", "sqm", "sqft", "sf", "qm", "mq", "m²", "ft²",
    "㎡", "坪", "평", "畳", "帖", "米", "平米", "平方米", "metres", "meters", "x", "кв", "м", "м²",
    "см", "мм", "م", "م²", "متر", "مربع", "מ", "ר", "τ", "μ", "kvm",
    "area", "fläche", "superficie", "surface", "площадь", "面积",
    "°c", "°f", "kw", "kwh", "lx", "lux", "ppm", "hpa",
})  # fmt: skip
"""Words of areas and lengths, and of what dashboards show; with numbers and nothing else they are no name."""

AROUND = frozenset({
    "a", "s", "h", "ch", "lh", "rh", "ca", "approx", "total", "net", "gross", "netto",
    "brutto", "约", "净", "約", "약",
})  # fmt: skip
"""What may stand by a measure and is none itself: A = 13.3 m², h 2.50 m, ca. 12 qm, 净4.0m."""

SIGNS = (
    "%'\"\N{RIGHT SINGLE QUOTATION MARK}\N{RIGHT DOUBLE QUOTATION MARK}\N{PRIME}\N{DOUBLE PRIME}"
    "\N{MULTIPLICATION SIGN}"
)
"""Feet, inches, shares, and what stands between two sides."""

TOKEN = re.compile(r"°?[^\W\d_]+|[\d²³]+|\S")

COMMA = re.compile(r"\d+,\d+")
"""A number with a comma is a length, though without a unit; with a point it may be that of a room."""

SPACED = 4
"""So many letters that stand alone are a word that is spaced out or stacked; fewer may be names of places."""

FLIGHT = re.compile(
    r"\W*(?:up|dn|down|上|下)\W*(?:\d+\W*(?:r|rs|risers?|steps?|treads?|级|步|段)\b.*)?", re.IGNORECASE
)
"""Where stairs lead, and by how many steps: UP, DN 14R, 上20级."""

LEVEL = re.compile(
    r"(?:(?:ffl|ssl|fl|lvl|level|el|elev|rl|ok|okff|okrf|cota|niv|npt)\W{0,2})?"
    r"(?:±\s*\d+(?:[.,]\d+)?|\+\s*\d+[.,]\d{2,3}|[-\N{MINUS SIGN}]\s*0[.,]\d{2,3})\s*m?",
    re.IGNORECASE,
)
"""The height of a floor, maybe after what it is called: ±0.00, FFL +0.15. A room may be called -1.05."""

MARK_OF_NOTHING = re.compile(r"\W*")
"""Words without a letter or a digit."""


@dataclass(frozen=True, slots=True)
class Name:
    """A name of a place, of one line or several."""

    words: str
    position: tuple[float, float]
    members: tuple[int, ...]  # numbers of its texts


def is_measure(words: str) -> bool:
    r"""Tell areas and lengths from names.

    >>> [is_measure(words) for words in ("11.2 m²", "3.50 x 4.20", "12'-0\" x 10'-6\"", "Room 7", "201")]
    [True, True, True, False, False]
    >>> [is_measure(words) for words in ("A: 13.30 m²", "21.5 °C", "15.96 m² (4.83 坪)", "A 12", "C 3")]
    [True, True, True, False, False]
    >>> [is_measure(words) for words in ("16,9 м²", "S = 8.5 кв.м", "6帖", "面积 12 平方米", "洋室 6帖")]
    [True, True, True, True, False]
    >>> [is_measure(words) for words in ("15 م²", "12 τ.μ.", "غرفة النوم 1")]
    [True, True, False]
    >>> is_measure("2,55"), is_measure("2.55"), is_measure("13.9㎡"), is_measure("净4.0m")
    (True, False, True, True)
    """
    if COMMA.fullmatch(words.strip()):
        return True
    tokens = TOKEN.findall(words.casefold())
    letters = [token for token in tokens if token.lstrip("°")[:1].isalpha() and token not in AROUND]
    has_number = any(token[0].isdecimal() for token in tokens)
    has_unit = bool(letters) or any(token in SIGNS or token in UNITS for token in tokens)
    return has_number and has_unit and all(word in UNITS for word in letters)


def role_of_words(words: str) -> tuple[Role, str]:
    """Tell names of places from what is written at doors and windows, upon stairs, and of levels.

    The last word at a door is one for doors.

    >>> [role_of_words(words)[0].value for words in ("Front door", "Badtür (60 cm)", "Outdoor", "Door 2 bar")]
    ['ignore', 'ignore', 'label', 'label']
    >>> [role_of_words(words)[0].value for words in ("UP 14R", "dn.", "Upper hall", "Up 3")]
    ['ignore', 'ignore', 'label', 'label']
    >>> [role_of_words(words)[0].value for words in ("±0.00", "FFL +0.15", "-0,45", "-1.05", "Hall +1")]
    ['ignore', 'ignore', 'ignore', 'label', 'label']
    """
    if FLIGHT.fullmatch(words.strip()):
        return Role.IGNORE, "where stairs lead"
    if LEVEL.fullmatch(words.strip()):
        return Role.IGNORE, "the level of a floor"
    spoken = [word for word in name_words(re.sub(r"\(.*?\)", " ", words)) if word not in UNITS]
    if spoken and meaning_of(spoken[-1]) in (Role.DOOR, Role.WINDOW):
        return Role.IGNORE, "the name of a door or a window"
    return Role.LABEL, "words"


def closed_up(words: str) -> str:
    """Close up a word that is spaced out, or written a letter a line.

    >>> closed_up("K I T C H E N"), closed_up("W C"), closed_up("Room A B C"), closed_up("1 2 3 4")
    ('KITCHEN', 'W C', 'Room A B C', '1 2 3 4')
    """
    letters = words.split()
    is_spaced = len(letters) >= SPACED and all(len(letter) == 1 and letter.isalpha() for letter in letters)
    return "".join(letters) if is_spaced else words


def find_names(texts: Sequence[tuple[int, Text]], walls: Sequence[Polyline] = ()) -> list[Name]:
    """Join the lines of each name, the upper first; words without a letter, and measures, are left out.

    Lines with a wall between them are two names. What is written larger comes first: of the words in a room
    its name is, and not that of its furniture.
    """
    kept = [
        (n, text)
        for n, text in texts
        if not is_measure(text.text) and not MARK_OF_NOTHING.fullmatch(text.text)
    ]
    following: dict[int, int] = {}
    taken: set[int] = set()
    segments = shapely.STRtree(shapely.linestrings(segments_of(walls).reshape(-1, 2, 2)))
    for place, others in enumerate(near_lines([text for _, text in kept])):
        upper = kept[place][1]
        below = [
            (distance, other)
            for other in others
            if (distance := step_down(upper, kept[other][1])) is not None
            and not are_parted(upper, kept[other][1], segments)
        ]
        if below and (nearest := min(below)[1]) not in taken:
            following[place] = nearest
            taken.add(nearest)
    names = []
    for start in sorted(set(range(len(kept))) - taken):
        chain = [start]
        while chain[-1] in following:
            chain.append(following[chain[-1]])
        lines = [kept[place][1] for place in chain]
        x, y = np.mean([line.position for line in lines], axis=0).tolist()
        words = closed_up(" ".join(without_echoes([line.text for line in lines])))
        names.append(Name(words, (x, y), tuple(kept[place][0] for place in chain)))
    heights = {number: text.height for number, text in kept}
    return sorted(names, key=lambda name: -max(heights[number] for number in name.members))


def without_echoes(lines: Sequence[str]) -> list[str]:
    """Leave out lines that say what the line before them says: programs write a name and a label.

    >>> without_echoes(["Kitchen", "KITCHEN", "Living Room", "LivingRoom", "Bed", "Bath"])
    ['Kitchen', 'Living Room', 'Bed', 'Bath']
    """
    said = ["".join(filter(str.isalnum, line.casefold())) for line in lines]
    return [line for place, line in enumerate(lines) if place == 0 or said[place] != said[place - 1]]


def near_lines(texts: Sequence[Text]) -> list[list[int]]:
    """List for each line of words the others that are near enough to be of one name with it."""
    if not texts:
        return []
    points = np.array([text.position for text in texts])
    heights = np.array([text.height for text in texts])
    letters = np.array([len(text.text) for text in texts])
    reach = ALIKE * heights * (LEADING + GLYPH_WIDTH * letters) / 2.0  # of two lines, the sum is enough
    boxes = shapely.box(*np.hstack([points - reach[:, None], points + reach[:, None]]).T)
    found: list[list[int]] = [[] for _ in texts]
    for first, second in shapely.STRtree(boxes).query(boxes, predicate="intersects").T.tolist():
        if first != second:
            found[first].append(second)
    return found


def step_down(upper: Text, lower: Text) -> float | None:
    """Measure from one line to the next of the same name; None if it is none, as a translation is."""
    height = max(upper.height, lower.height)
    if min(upper.height, lower.height) <= 0.0 or height > ALIKE * min(upper.height, lower.height):
        return None
    if abs(math.remainder(upper.angle - lower.angle, 2.0 * math.pi)) > 0.1:
        return None
    c, s = math.cos(upper.angle), math.sin(upper.angle)
    dx, dy = lower.position[0] - upper.position[0], lower.position[1] - upper.position[1]
    along, down = c * dx + s * dy, s * dx - c * dy
    reach = GLYPH_WIDTH * height * (len(upper.text) + len(lower.text)) / 2.0
    if not 0.5 * height < down <= LEADING * height or abs(along) > reach:
        return None
    above, below = scripts(upper.text), scripts(lower.text)
    return None if above and below and not above & below else down


def are_parted(upper: Text, lower: Text, walls: shapely.STRtree) -> bool:
    """Tell whether a wall lies between the middles of two lines of words."""
    way = shapely.linestrings([upper.position, lower.position])
    return len(walls.query(way, predicate="intersects")) > 0


def scripts(words: str) -> set[str]:
    """Name the scripts that words are written in; a letter that stands alone is in any.

    >>> sorted(scripts("Main hall, الممر")), scripts("会議室 A"), scripts("トイレ"), scripts("B 2")
    (['ARABIC', 'LATIN'], {'CJK'}, {'CJK'}, set())
    """
    found = set()
    for word in words.split():
        letters = [unicodedata.name(letter, "").partition(" ")[0] for letter in word if letter.isalpha()]
        written = {"CJK" if script in EAST_ASIAN else script for script in letters}
        found |= written if len(letters) > 1 or "CJK" in written else set()
    return found
