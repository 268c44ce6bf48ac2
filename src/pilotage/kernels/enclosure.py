"""Which points contours enclose: an odd number of them, whichever way they run.

From outside, the way to such a point crosses an odd number of segments. It leads along the rows of a grid's
corners, which are counted once and for all, and then through one cell: up its left side and on to the point.

Whatever lies on the border of two cells belongs to the upper right one, in all that follows; so the ways fit
together even for the walls of a map, which lie on such borders.
"""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit
from pilotage.kernels.segment_grid import SegmentGrid


@njit(cache=True)
def enclosed_corners(grid: SegmentGrid) -> NDArray[np.bool_]:
    """Tell which lower left corners of the cells of a grid are enclosed, (columns, rows)."""
    odd = np.zeros((grid.columns, grid.rows), np.bool_)
    for row in range(grid.rows):
        y = grid.bottom + row * grid.cell
        inside = False
        for column in range(grid.columns):
            odd[column, row] = inside
            k = column * grid.rows + row
            for member in range(grid.starts[k], grid.starts[k + 1]):
                x1, y1, x2, y2 = grid.segments[grid.members[member]]
                first, last = (
                    math.floor((y1 - grid.bottom) / grid.cell),
                    math.floor((y2 - grid.bottom) / grid.cell),
                )
                if (first < row) != (last < row):
                    crossing = x1 + (y - y1) * (x2 - x1) / (y2 - y1)
                    # in the cell that it lies in, so that a segment of many cells counts once
                    inside ^= math.floor((crossing - grid.left) / grid.cell) == column
    return odd


@njit(cache=True)
def enclosed(points: NDArray[np.float64], grid: SegmentGrid, corners: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Tell which points (n, 2) contours enclose, (n,); `corners` are those that they enclose."""
    odd = np.zeros(len(points), np.bool_)
    for i in range(len(points)):
        x, y = points[i, 0], points[i, 1]
        column, row = math.floor((x - grid.left) / grid.cell), math.floor((y - grid.bottom) / grid.cell)
        if not (0 <= column < grid.columns and 0 <= row < grid.rows):
            continue
        inside, side = corners[column, row], grid.left + column * grid.cell
        k = column * grid.rows + row
        for member in range(grid.starts[k], grid.starts[k + 1]):
            x1, y1, x2, y2 = grid.segments[grid.members[member]]
            first, last = math.floor((x1 - grid.left) / grid.cell), math.floor((x2 - grid.left) / grid.cell)
            if (first < column) != (last < column):
                height = y1 + (side - x1) * (y2 - y1) / (x2 - x1)
                inside ^= height <= y and math.floor((height - grid.bottom) / grid.cell) == row
            if (y1 <= y) != (y2 <= y):
                crossing = x1 + (y - y1) * (x2 - x1) / (y2 - y1)
                inside ^= crossing <= x and math.floor((crossing - grid.left) / grid.cell) == column
        odd[i] = inside
    return odd
