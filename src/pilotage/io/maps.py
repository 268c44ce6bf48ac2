"""Open a drawing of any kind that can be read."""

import os
from pathlib import Path

from pilotage.io.svg import read_svg
from pilotage.maps import SchematicMap


def open_map(path: str | os.PathLike[str]) -> SchematicMap:
    """Read a drawing: SVG (also gzipped).

    Raises FileError if the file is missing, of another kind, or shows no stroke.
    """
    return read_svg(Path(path))
