"""Open a drawing of any kind that can be read."""

import os
from pathlib import Path

from pilotage.errors import FileError
from pilotage.interpretation import NoWallsError, interpret
from pilotage.io.raster import SUFFIXES, read_map_server, read_raster
from pilotage.io.svg import read_svg_sheet
from pilotage.maps import SchematicMap


def open_map(path: str | os.PathLike[str]) -> SchematicMap:
    """Read a drawing: SVG (also gzipped), a picture (PNG, PGM, JPEG, ...) or a ROS map_server YAML file.

    Raises FileError if the file is missing, of another kind, or shows no stroke.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix in SUFFIXES:
        return read_raster(file)
    if suffix in (".yaml", ".yml"):
        return read_map_server(file)
    try:
        return interpret(read_svg_sheet(file)).sketch
    except NoWallsError as error:
        raise FileError(str(error), file) from error
