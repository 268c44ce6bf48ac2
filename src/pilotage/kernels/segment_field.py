"""A grid that knows the nearest segment of each of its cells: nearest-segment queries in constant time."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit
from pilotage.kernels.segment_grid import bounds

NONE = -1  # no segment within reach


class SegmentField(NamedTuple):
    """Segments and, for each cell of a grid round them, which is nearest."""

    segments: NDArray[np.float64]  # (m, 4) x1, y1, x2, y2
    directions: NDArray[np.float64]  # (m, 2) unit vectors; free space on their left
    lengths: NDArray[np.float64]  # (m,)
    left: float  # x of the grid's corner
    bottom: float  # y of the grid's corner
    cell: float  # side of a cell
    nearest: NDArray[np.int32]  # (rows, columns) index of a segment, or NONE
    distance: NDArray[np.float32]  # (rows, columns) from the cell's center to that segment; inf where NONE


@njit(cache=True)
def build_segment_field(segments: NDArray[np.float64], cell: float, reach: float) -> SegmentField:
    """Enter segments (m, 4) into a grid; cells farther than `reach` from all of them stay empty."""
    m = len(segments)
    directions, lengths = np.zeros((m, 2)), np.zeros(m)
    left, bottom, right, top = bounds(segments)
    if m > 0:
        left, bottom, right, top = left - reach, bottom - reach, right + reach, top + reach
    columns, rows = int((right - left) / cell) + 1, int((top - bottom) / cell) + 1
    nearest = np.full((rows, columns), NONE, dtype=np.int32)
    squared = np.full((rows, columns), np.inf, dtype=np.float32)
    for k in range(m):
        ax, ay, bx, by = segments[k, 0], segments[k, 1], segments[k, 2], segments[k, 3]
        length = math.hypot(bx - ax, by - ay)
        lengths[k] = length
        if length == 0.0:
            continue
        ux, uy = (bx - ax) / length, (by - ay) / length
        directions[k, 0], directions[k, 1] = ux, uy
        first_row = max(0, int((min(ay, by) - reach - bottom) / cell))
        last_row = min(rows - 1, int((max(ay, by) + reach - bottom) / cell))
        for row in range(first_row, last_row + 1):
            y = bottom + (row + 0.5) * cell
            # where the line leaves this row's reach, so that slanted segments do not visit their whole bounds
            low, high = min(ax, bx), max(ax, bx)
            if abs(uy) > 0.1:
                at, half = ax + (y - ay) * ux / uy, reach / abs(uy)
                low, high = max(low, at - half), min(high, at + half)
            first = max(0, int((low - reach - left) / cell))
            last = min(columns - 1, int((high + reach - left) / cell))
            squares, owners = squared[row], nearest[row]
            for place in range(first, last + 1):
                column = np.uint64(place)  # an unsigned index is not asked whether it counts from the end
                px, py = left + (place + 0.5) * cell - ax, y - ay
                along = min(max(px * ux + py * uy, 0.0), length)
                ex, ey = px - along * ux, py - along * uy
                d = ex * ex + ey * ey
                if d < squares[column] and d <= reach * reach:
                    squares[column] = d
                    owners[column] = k
    return SegmentField(segments, directions, lengths, left, bottom, cell, nearest, np.sqrt(squared))


@njit(cache=True)
def find_nearest(
    points: NDArray[np.float64], directions: NDArray[np.float64], field: SegmentField, min_cosine: float
) -> NDArray[np.int64]:
    """Find for each point the nearest segment that runs its way, or NONE, (n,)."""
    rows, columns = field.nearest.shape
    found = np.full(len(points), NONE)
    for i in range(len(points)):
        row = math.floor((points[i, 1] - field.bottom) / field.cell)
        column = math.floor((points[i, 0] - field.left) / field.cell)
        if 0 <= row < rows and 0 <= column < columns:
            k = field.nearest[row, column]
            if k != NONE:
                cosine = directions[i, 0] * field.directions[k, 0] + directions[i, 1] * field.directions[k, 1]
                if cosine >= min_cosine:
                    found[i] = k
    return found
