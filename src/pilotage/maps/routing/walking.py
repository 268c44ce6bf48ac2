"""Ways inside one cell: straight from sight to sight, around corners that jut into it."""

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps.cells.graph import Cell

GRAZE = 2e-3
"""By what share of its size a cell is widened before sight is tested: ways may touch corners and gateways."""


def jutting_corners(cell: Cell) -> Array:
    """List the corners that one walks around: there the outline or a hole juts into free space, (k, 2)."""
    corners = []
    for ring in (cell.outline, *cell.holes):
        before, after = ring - np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0) - ring
        turns = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
        corners.append(ring[turns < 0.0])
    return np.concatenate(corners)


def room_of(cell: Cell) -> shapely.Polygon:
    """Widen a cell by a grain, ready for many questions about sight."""
    room = cell.polygon.buffer(GRAZE * np.sqrt(cell.polygon.area), join_style="mitre")
    shapely.prepare(room)
    return room


def find_sights(room: shapely.Polygon, here: Array, there: Array) -> NDArray[np.bool_]:
    """Tell which of the points `there` (n, 2) are in sight of `here` (2,) inside a room, (n,)."""
    lines = shapely.linestrings(np.stack([np.broadcast_to(here, there.shape), there], axis=1))
    return np.asarray(shapely.covers(room, lines))
