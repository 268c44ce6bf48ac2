"""A grid of square cells over segments, each cell with the segments that touch it: few are looked at."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit

MARGIN = 1e-6  # share of a cell by which segments are taken to be thicker: rounding leaves none out
MOST_CELLS = 1_000_000  # of a grid, however thinly the segments are spread


class SegmentGrid(NamedTuple):
    """Segments (n, 4), and which touch cell k = column * rows + row: members[starts[k]:starts[k + 1]]."""

    segments: NDArray[np.float64]
    left: float
    bottom: float
    cell: float
    columns: int
    rows: int
    starts: NDArray[np.int64]
    members: NDArray[np.int64]


@njit(cache=True)
def bounds(segments: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """Find left, bottom, right and top of segments (n, 4); all 0 if there are none."""
    if len(segments) == 0:
        return 0.0, 0.0, 0.0, 0.0
    left, bottom, right, top = np.inf, np.inf, -np.inf, -np.inf
    for j in range(len(segments)):
        for end in (0, 2):
            left, right = min(left, segments[j, end]), max(right, segments[j, end])
            bottom, top = min(bottom, segments[j, end + 1]), max(top, segments[j, end + 1])
    return left, bottom, right, top


@njit(cache=True)
def cell_size(count: int, width: float, height: float) -> float:
    """Choose cells of such a size that there are about as many as segments."""
    area = max(width, 1e-3 * height) * max(height, 1e-3 * width)
    size = math.sqrt(area / min(max(count, 1), MOST_CELLS))
    return size if size > 0.0 else 1.0


@njit(cache=True)
def build_grid(segments: NDArray[np.float64]) -> SegmentGrid:
    """Lay a grid over segments (n, 4), rows x1, y1, x2, y2."""
    left, bottom, right, top = bounds(segments)
    cell = cell_size(len(segments), right - left, top - bottom)
    margin = MARGIN * cell
    left, bottom = left - 2.0 * margin, bottom - 2.0 * margin
    columns = math.floor((right + 2.0 * margin - left) / cell) + 1
    rows = math.floor((top + 2.0 * margin - bottom) / cell) + 1
    starts = np.zeros(columns * rows + 1, np.int64)
    members = np.empty(0, np.int64)
    for fills in (False, True):  # once to count, once to write
        for j in range(len(segments)):
            x1, y1, x2, y2 = (
                segments[j, 0] - left,
                segments[j, 1] - bottom,
                segments[j, 2] - left,
                segments[j, 3] - bottom,
            )
            if x1 > x2:
                x1, y1, x2, y2 = x2, y2, x1, y1
            rise = (y2 - y1) / (x2 - x1) if x2 > x1 else 0.0
            for column in range(math.floor((x1 - margin) / cell), math.floor((x2 + margin) / cell) + 1):
                low, high = min(y1, y2), max(y1, y2)
                if x2 - x1 > margin:
                    first = y1 + rise * (max(column * cell - margin, x1) - x1)
                    last = y1 + rise * (min((column + 1) * cell + margin, x2) - x1)
                    low, high = max(low, min(first, last)), min(high, max(first, last))
                for row in range(math.floor((low - margin) / cell), math.floor((high + margin) / cell) + 1):
                    k = column * rows + row
                    if fills:
                        starts[k] -= 1
                        members[starts[k]] = j
                    else:
                        starts[k] += 1
        if not fills:
            starts = np.cumsum(starts)
            members = np.empty(starts[-1], np.int64)
    return SegmentGrid(segments, left, bottom, cell, columns, rows, starts, members)
