"""The truth about rooms: where they are in the building, and where a drawing shows them."""

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import shapely

from pilotage.errors import FileError
from pilotage.geometry import Array

MALFORMED = (KeyError, TypeError, AttributeError, ValueError, shapely.errors.ShapelyError)


@dataclass(frozen=True, eq=False)
class Rooms:
    """Named polygons that share no more than their borders."""

    names: tuple[str, ...]
    polygons: tuple[shapely.Polygon, ...]

    @cached_property
    def tree(self) -> shapely.STRtree:
        """The polygons, indexed."""
        return shapely.STRtree(list(self.polygons))

    def names_at(self, points: Array) -> tuple[str, ...]:
        """Name the room of each point (n, 2); on a border the first, in none the empty name."""
        found = np.full(len(points), len(self.names))
        which, rooms = self.tree.query(shapely.points(points), predicate="intersects")
        np.minimum.at(found, which, rooms)
        return tuple((*self.names, "")[index] for index in found)


def read_world_rooms(path: Path) -> Rooms:
    """Read the rooms of a building from GeoJSON, in metres of the truth trajectory."""
    try:
        features = read_json(path)["features"]
        return Rooms(
            tuple(feature["properties"]["name"] for feature in features),
            tuple(shapely.Polygon(*feature["geometry"]["coordinates"][:1]) for feature in features),
        )
    except MALFORMED as error:
        raise FileError(f"rooms are features with a name and a polygon ({error!r})", path) from error


def read_drawn_rooms(path: Path) -> Rooms:
    """Read the rooms that a drawing shows, in the units and axes of its file."""
    try:
        rooms = read_json(path)["rooms"]
        return Rooms(tuple(rooms), tuple(shapely.Polygon(outline) for outline in rooms.values()))
    except MALFORMED as error:
        raise FileError(f"`rooms` holds an outline for each name ({error!r})", path) from error


def read_json(path: Path) -> dict:  # type: ignore[type-arg]  # of any shape
    """Read a JSON object."""
    try:
        return dict(json.loads(path.read_text()))
    except (OSError, ValueError, RecursionError, TypeError) as error:
        raise FileError(f"cannot be read as JSON ({error})", path) from error
