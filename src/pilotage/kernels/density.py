"""Where on the drawing particles stand most densely."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit


@njit(cache=True)
def gather_densest(
    states: NDArray[np.float64],
    weights: NDArray[np.float64],
    bounds: tuple[float, float, float, float],
    block: float,
    most_blocks: int,
    radius: float,
) -> NDArray[np.bool_]:
    """Tell which particles stand near the middle of the three by three blocks with the largest weight, (n,).

    Columns of `states` (6, n) are as in kernels/visibility.py; particles without weight are left out. The
    drawing has the `bounds` left, bottom, width and height; what stands beside it is taken to stand a block
    off. A `block` and the `radius` are in metres, by the mean scale of all particles and of those in the
    blocks. There are at most `most_blocks` along a side, and one particle at least is near.
    """
    n = states.shape[1]
    left, bottom, width, height = bounds
    total, log_scale = 0.0, 0.0
    for i in range(n):
        total += weights[i]
        log_scale += weights[i] * states[3, i]
    size = max(block * math.exp(log_scale / total), max(width, height) / most_blocks)
    # a block around the drawing for what stands beside it, and another so that all have neighbors
    columns, rows = math.floor(width / size) + 5, math.floor(height / size) + 5
    masses = np.zeros((columns, rows))
    column, row = np.zeros(n, np.int32), np.zeros(n, np.int32)
    for i in range(n):
        if weights[i] > 0.0:
            column[i] = math.floor(min(max(states[0, i] - left + size, 0.0), width + 2.0 * size) / size) + 1
            row[i] = math.floor(min(max(states[1, i] - bottom + size, 0.0), height + 2.0 * size) / size) + 1
            masses[column[i], row[i]] += weights[i]

    best, best_column, best_row = -1.0, 1, 1
    for j in range(1, columns - 1):
        for k in range(1, rows - 1):
            mass = 0.0
            for side in range(j - 1, j + 2):
                mass = mass + masses[side, k - 1] + masses[side, k] + masses[side, k + 1]
            if mass > best:
                best, best_column, best_row = mass, j, k

    total, x, y, log_scale = 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        if weights[i] > 0.0 and abs(column[i] - best_column) <= 1 and abs(row[i] - best_row) <= 1:
            total += weights[i]
            x += weights[i] * states[0, i]
            y += weights[i] * states[1, i]
            log_scale += weights[i] * states[3, i]
    x, y, scale = x / total, y / total, math.exp(log_scale / total)
    squares, least = np.full(n, np.inf), np.inf
    for i in range(n):
        if weights[i] > 0.0:
            squares[i] = ((states[0, i] - x) ** 2 + (states[1, i] - y) ** 2) / scale**2
            least = min(least, squares[i])
    return squares <= max(radius**2, least)  # scales may differ: never none
