"""Ways inside one cell: straight from sight to sight, around corners that jut into it."""

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps.cells import Cell

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


def find_sights(cell: Cell, stops: Array) -> NDArray[np.int64]:
    """Find the pairs of stops (n, 2) that see each other inside a cell, (k, 2)."""
    first, second = np.triu_indices(len(stops), 1)
    room = cell.polygon.buffer(GRAZE * np.sqrt(cell.polygon.area), join_style="mitre")
    shapely.prepare(room)
    lines = shapely.linestrings(np.stack([stops[first], stops[second]], axis=1))
    sees = shapely.covers(room, lines)
    return np.column_stack([first[sees], second[sees]])
