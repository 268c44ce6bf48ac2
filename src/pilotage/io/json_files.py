"""Read JSON files of others, which may hold anything."""

import json
import math
from pathlib import Path

from pilotage.errors import FileError
from pilotage.io.files import check_regular, read_bytes

Json = dict[str, object]

LARGEST = 100_000_000
"""The largest file that is read [bytes]."""


def read_json(path: Path, kind: str) -> Json:
    """Read a JSON file that holds an object.

    Raises FileError if it is missing or damaged.
    """
    check_regular(path)
    content = read_bytes(path, LARGEST)
    try:
        found = json.loads(content.decode("utf-8-sig"))
    except (ValueError, RecursionError) as error:
        reason = "it is nested too deeply" if isinstance(error, RecursionError) else f"{error}"
        raise FileError(f"{kind} cannot be read ({reason[:100]})", path) from error
    if not isinstance(found, dict):
        raise FileError(f"{kind} must hold an object", path)
    return found


def number(value: object, otherwise: float = 0.0) -> float:
    """Return a finite number, another one if a value is none."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        try:
            found = float(value)
        except OverflowError:
            return otherwise
        return found if math.isfinite(found) else otherwise
    return otherwise


def words(value: object) -> str:
    """Return a text; empty if a value is none."""
    return value if isinstance(value, str) else ""


def items(value: object) -> list[object]:
    """Return a list; empty if a value is none."""
    return value if isinstance(value, list) else []


def objects(value: object) -> list[Json]:
    """Return the objects of a list."""
    return [item for item in items(value) if isinstance(item, dict)]


def points(value: object) -> list[tuple[float, float]]:
    """Return the points of a list of lists; what is no point is passed over."""
    found = []
    for item in items(value):
        pair = items(item)[:2]
        if len(pair) == 2 and all(isinstance(part, int | float) for part in pair):
            found.append((number(pair[0], math.nan), number(pair[1], math.nan)))
    return found
