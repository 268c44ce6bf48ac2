"""Scales as plans state them: "1:100", "Maßstab 1 : 50", `1/4" = 1'-0"`."""

import re
from collections import Counter
from collections.abc import Iterable

RATIO = re.compile(r"(?<![\d:.])1\s*:\s*(\d{1,4})(?![\d:.])")
INCHES = re.compile(r"(\d+)(?:\s*/\s*(\d+))?\s*(?:\"|\u201d|''|in)\s*=\s*1\s*(?:'|\u2019|ft)")
LENGTH = re.compile(r"\s*(\d{1,9}(?:[.,]\d{1,9})?)\s*(mm|cm|m|ft|in)?\b")
METRES = {"mm": 0.001, "cm": 0.01, "m": 1.0, "ft": 0.3048, "in": 0.0254}
LEAST, MOST = 5, 2000
"""Scales of plans of buildings: 1:5 to 1:2000."""


def find_scale(texts: Iterable[str]) -> float | None:
    """Return how many times larger the building is than the paper, by what most words say.

    >>> find_scale(["Kitchen", "Scale 1:50"]), find_scale(["1/4 in = 1 ft"]), find_scale(["12:30"])
    (50.0, 48.0, None)
    """
    found: Counter[float] = Counter()
    for text in texts:
        found.update(float(number) for number in RATIO.findall(text))
        for whole, part in INCHES.findall(text):
            if int(whole) and (not part or int(part)):
                found[12.0 * (int(part) if part else 1) / int(whole)] += 1
    likely = [scale for scale, _ in found.most_common() if LEAST <= scale <= MOST]
    return likely[0] if likely else None


def length_in_metres(text: str) -> float | None:
    """Return the length that a text tells, in metres if it names no unit; None if it tells none above 0.

    >>> [length_in_metres(text) for text in ("0.9", "90 cm", "0,9 m", "0", "wide")]
    [0.9, 0.9, 0.9, None, None]
    """
    match = LENGTH.match(text)
    return float(match[1].replace(",", ".")) * METRES[match[2] or "m"] or None if match else None
