"""Read files of JSON Lines that we wrote: estimates, and journals of drives."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pilotage.errors import FileError
from pilotage.io.files import read_bytes

Record = Mapping[str, Any]
NEEDED = ("stamp", "scale", "hypotheses")


def is_records(path: Path) -> bool:
    """Tell whether a file looks like JSON Lines."""
    if not path.is_file():
        return False
    with path.open("rb") as file:
        return file.read(1) == b"{"


def read_records(path: Path) -> list[Record]:
    """Read all lines; raise FileError at the first that is none of ours."""
    records: list[Record] = []
    for number, line in enumerate(read_bytes(path).decode("utf-8", errors="replace").splitlines(), start=1):
        try:
            record = json.loads(line)
        except ValueError as error:
            raise FileError(f"line {number} must be a JSON object ({error})", path) from error
        if not isinstance(record, dict) or not all(record.get(name) for name in NEEDED[1:]):
            raise FileError(f"line {number} must be an estimate with {', '.join(NEEDED)}", path)
        records.append(record)
    return records
