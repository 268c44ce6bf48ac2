"""Read files of JSON Lines that we wrote: estimates, and journals of drives."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pilotage.errors import FileError
from pilotage.io.files import read_bytes, reading
from pilotage.io.json_files import number, objects

Record = Mapping[str, Any]


def is_records(path: Path) -> bool:
    """Tell whether a file looks like JSON Lines.

    Raises FileError if it cannot be opened.
    """
    if not path.is_file():
        return False
    with reading(path), path.open("rb") as file:
        return file.read(1) == b"{"


def read_records(path: Path) -> list[Record]:
    """Read all lines; raise FileError at the first that is none of ours."""
    records: list[Record] = []
    for count, line in enumerate(read_bytes(path).decode("utf-8", errors="replace").splitlines(), start=1):
        try:
            record = json.loads(line)
        except ValueError as error:
            raise FileError(f"line {count} must be a JSON object ({error})", path) from error
        except RecursionError as error:
            raise FileError(f"line {count} must not be nested so deeply", path) from error
        if not is_estimate(record):
            raise FileError(f"line {count} must be an estimate with stamp, scale, hypotheses", path)
        records.append(record)
    return records


def is_estimate(record: object) -> bool:
    """Tell whether a line holds what every estimate has: a stamp, a positive scale, and a hypothesis."""
    return (
        isinstance(record, dict)
        and math.isfinite(number(record.get("stamp"), math.nan))
        and number(record.get("scale")) > 0.0
        and bool(objects(record.get("hypotheses")))
    )
