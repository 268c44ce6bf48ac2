"""Read a ROS map_server map: a YAML file that names a picture and says which shades are free.

As a drawing it has no scale; `io/world` believes its resolution and its origin, too.
"""

from pathlib import Path, PureWindowsPath

import numpy as np

from pilotage.errors import FileError
from pilotage.io.files import check_regular
from pilotage.io.raster import Mask, from_free_space, read_picture
from pilotage.maps import SchematicMap

FREE_BELOW = 0.196
"""Occupancy below which map_server takes a cell for free, if the file does not say."""

UNKNOWN, HALF = 205.0 / 255.0, 0.5 / 255.0
"""The shade of cells that no one has seen, and half of one; by the threshold of ROS 2 they would be free."""

YES, NO = ("true", "yes", "on"), ("false", "no", "off")
"""How YAML answers, beside by 1 and 0."""


def read_map_server(path: Path) -> SchematicMap:
    """Read a map as a drawing in cells, y up and so below 0: the contours of free space.

    Raises FileError if either file cannot be read, or no cell is free.
    """
    return from_free_space(free_cells(read_entries(path), path), path)


def read_entries(path: Path) -> dict[str, str]:
    """Read the plain `key: value` lines and the lists of the YAML file; one of them names an image.

    Raises FileError if it cannot be read, or names no image.
    """
    check_regular(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError as error:
        raise FileError("there is no such file", path) from error
    except (OSError, ValueError) as error:
        raise FileError(f"a map_server file cannot be read ({error})", path) from error
    entries: dict[str, str] = {}
    name = ""
    for line in text.splitlines():
        plain = line.split("#")[0]
        if ":" in plain:
            name, value = (part.strip() for part in plain.split(":", 1))
            entries[name] = value.strip("'\"")
        elif name and plain.strip().startswith("- "):  # a list, an item a line
            entries[name] += f" {plain.strip()[2:]}"
    if "image" not in entries:
        raise FileError("a map_server file must name an image; of other YAML, give the drawing itself", path)
    return entries


def free_cells(entries: dict[str, str], path: Path) -> Mask:
    """Tell which cells are free, (height, width), the upper row first; `path` is the YAML file's.

    Raises FileError if the picture cannot be read, or an entry is no number.
    """
    free_below = number(entries, "free_thresh", path, FREE_BELOW)
    is_told = entries.get("negate", "").lower()
    negated = is_told in YES or (is_told not in NO and bool(number(entries, "negate", path, 0.0)))
    gray = read_picture(picture_of(entries["image"], path)).colors.mean(axis=2)
    free = (gray if negated else 1.0 - gray) < free_below
    if not negated and (gray > UNKNOWN + HALF).any():  # else it is what free cells were painted in
        free &= np.abs(gray - UNKNOWN) > HALF
    return np.asarray(free)


def picture_of(image: str, path: Path) -> Path:
    """Return where the picture of a map is: where the file says, or beside it if the map was moved."""
    named, beside = path.parent / image, path.parent / PureWindowsPath(image).name
    return beside if beside.is_file() and not named.exists() else named


def number(entries: dict[str, str], name: str, path: Path, otherwise: float | None = None) -> float:
    """Read an entry that must be a number; `otherwise` stands for a missing one.

    Raises FileError that names the entry and its value.
    """
    if name not in entries and otherwise is not None:
        return otherwise
    try:
        return float(entries.get(name, ""))
    except ValueError as error:
        raise FileError(
            f"a map_server file must give {name} as a number, got {entries.get(name)!r}", path
        ) from error
