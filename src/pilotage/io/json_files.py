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
    found = decoded(text_in(path, kind), path, kind)
    if not isinstance(found, dict):
        raise FileError(f"{kind} must hold an object", path)
    return found


def read_json_objects(path: Path, kind: str) -> list[Json]:
    """Read a JSON file that holds an object, a list of them, or one a line as they are streamed (RFC 8142).

    Raises FileError as `read_json` does.
    """
    text = text_in(path, kind).strip("\x1e \t\r\n")
    lines = [line.strip("\x1e \t\r") for line in text.split("\n")]
    if len(lines) > 1 and all(line.startswith("{") and line.endswith("}") for line in lines if line):
        text = f"[{','.join(filter(None, lines))}]"
    found = decoded(text, path, kind)
    listed = objects(found if isinstance(found, list) else [found])
    if not listed:
        raise FileError(f"{kind} must hold an object", path)
    return listed


def text_in(path: Path, kind: str) -> str:
    """Read a file in UTF-8; raises FileError if it cannot be."""
    check_regular(path)
    try:
        return read_bytes(path, LARGEST).decode("utf-8-sig")
    except ValueError as error:
        raise FileError(f"{kind} cannot be read ({str(error)[:100]})", path) from error


def decoded(text: str, path: Path, kind: str) -> object:
    """Decode JSON; raises FileError if it is none, or nested too deeply."""
    try:
        found: object = json.loads(text)
    except (ValueError, RecursionError) as error:
        reason = "it is nested too deeply" if isinstance(error, RecursionError) else f"{error}"
        raise FileError(f"{kind} cannot be read ({reason[:100]})", path) from error
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
