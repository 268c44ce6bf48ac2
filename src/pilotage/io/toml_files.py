"""Read TOML files that people write: small ones, and not nested without end."""

import re
import tomllib
from pathlib import Path
from typing import Any

from pilotage.errors import FileError
from pilotage.io.files import check_regular, read_bytes

LARGEST = 1_000_000
"""The largest file that is read [bytes]."""

LONG_KEY = re.compile(r"(?:[\"'\w-]+[ \t]*\.[ \t]*){50}")
"""A key of so many parts would take the parser seconds and gigabytes."""


def read_toml(path: Path | str, what: str) -> dict[str, Any]:
    """Read a file into nested tables; `what` names it in messages, as in "a settings file".

    Raises FileError if it cannot be read.
    """
    check_regular(Path(path))
    try:
        content = read_bytes(path, LARGEST).decode()
    except UnicodeDecodeError as error:
        raise FileError(f"{what} must be UTF-8 text", path) from error
    if LONG_KEY.search(content):
        raise FileError(f"{what} must not be nested so deeply", path)
    try:
        return tomllib.loads(content)
    except tomllib.TOMLDecodeError as error:
        raise FileError(f"{what} must be TOML ({error})", path) from error
    except RecursionError as error:
        raise FileError(f"{what} must not be nested so deeply", path) from error
    except ValueError as error:  # a number of thousands of digits
        raise FileError(f"{what} holds a value that cannot be read ({error})", path) from error
