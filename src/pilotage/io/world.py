"""Read a world to drive in: a ROS map_server map, or an SVG drawing in metres.

Here, and only here, the resolution and the origin of a map_server map are believed.
"""

import math
import os
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from pilotage.errors import FileError
from pilotage.geometry import Array, Pose2
from pilotage.io.map_server import free_cells, number, read_entries
from pilotage.io.raster import Mask
from pilotage.io.svg import read_svg_world
from pilotage.simulation import World

LEAST_ROOM = 0.1
"""Radius of the smallest robot that a world must have room for [m]."""

WIDEST = 2_000.0
"""Largest diagonal of a world [m]: a larger one was drawn in other units, and needs too much memory."""

COARSEST = 100.0
"""Largest resolution of a map that is accepted [m]."""

FARTHEST = 1e9
"""Largest coordinate of a map's origin that is accepted [m]."""

MESH = 1000
"""Room is looked for at places this share of a world's diagonal apart, or LEAST_ROOM if that is more."""


def open_world(path: str | os.PathLike[str]) -> World:
    """Read a world: a ROS map_server YAML file, or SVG (also gzipped) whose unit is the metre.

    Raises FileError if the file is missing, of another kind, has no free space, or is larger than a building.
    """
    file = Path(path)
    is_map = file.suffix.lower() in (".yaml", ".yml")
    world = read_map_server_world(file) if is_map else read_svg_world(file)
    if size_of(world) > WIDEST:
        raise FileError(
            f"a world is in metres, at most {WIDEST:.0f} m across, this one would be {size_of(world):.0f} m",
            file,
        )
    if not has_room(world):
        raise FileError(f"a world in metres must have room for a disc of {LEAST_ROOM} m, found none", file)
    return world


def size_of(world: World) -> float:
    """Measure the diagonal of a world [m]."""
    left, bottom, right, top = world.bounds
    return math.hypot(right - left, top - bottom)


def has_room(world: World) -> bool:
    """Tell whether a small robot can stand anywhere between the outermost walls."""
    left, bottom, right, top = world.bounds
    step = max(LEAST_ROOM, size_of(world) / MESH)
    places = np.mgrid[left + step / 2.0 : right : step, bottom + step / 2.0 : top : step]
    return bool(world.is_free(places.reshape(2, -1).T, LEAST_ROOM).any())


def read_map_server_world(path: Path) -> World:
    """Read a map_server map as a world: occupied and unknown cells are solid, and so is all around it."""
    entries = read_entries(path)
    resolution = number(entries, "resolution", path)
    if not 0.0 < resolution <= COARSEST:
        raise FileError(
            f"a map_server file must give a resolution > 0 m and at most {COARSEST:g} m, got {resolution:g}",
            path,
        )
    world_from_map = origin(entries, path)
    free = free_cells(entries, path)
    if not free.any():
        raise FileError("a world must have free space, found no free cell", path)
    segments = borders(free[::-1]) * resolution  # rows of a map count from its lower edge
    ends = world_from_map @ segments.reshape(-1, 2)
    return World(ends.reshape(-1, 4), contours=True)


def origin(entries: dict[str, str], path: Path) -> Pose2:
    """Read the pose of the lower left corner of a map."""
    try:
        x, y, yaw = (float(value) for value in re.split(r"[\s,]+", entries.get("origin", "").strip("[] \t")))
        pose = Pose2(x, y, yaw)
    except ValueError as error:
        raise FileError(
            f"a map_server file must give origin as [x, y, yaw], got {entries.get('origin')!r}", path
        ) from error
    if max(abs(x), abs(y)) > FARTHEST:
        raise FileError(f"a map_server file must give origin as [x, y, yaw] within {FARTHEST:g} m", path)
    return pose


def borders(free: Mask) -> Array:
    """Draw the borders between free cells and all others, (n, 4) in cells; runs in a row are one segment."""
    padded = np.pad(free, 1)
    level = [(x1, y, x2, y) for y, x1, x2 in runs(padded[1:, 1:-1] != padded[:-1, 1:-1])]
    upright = [(x, y1, x, y2) for x, y1, y2 in runs((padded[1:-1, 1:] != padded[1:-1, :-1]).T)]
    return np.array(level + upright, dtype=np.float64)


def runs(marked: Mask) -> Iterator[tuple[int, int, int]]:
    """List the runs of marks in each line: its number, the first mark and the one after the last."""
    changes = np.diff(np.pad(marked, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    lines, first = np.nonzero(changes == 1)
    _, last = np.nonzero(changes == -1)
    yield from zip(lines.tolist(), first.tolist(), last.tolist(), strict=True)
