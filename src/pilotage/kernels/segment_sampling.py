"""Points at even distances along segments, so that a shape weighs by its length and not by its beams."""

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit


@njit(cache=True)
def sample_segments(
    segments: NDArray[np.float64], step: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Place points about one `step` apart along segments (m, 4), at least one on each.

    Returns
    -------
    points, directions, weights, owners
        (n, 2), unit vectors (n, 2), the length in steps that each point stands for (n,), and the index of its
        segment (n,).
    """
    m = len(segments)
    lengths = np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1])
    counts = np.zeros(m, dtype=np.int64)
    for k in range(m):
        if lengths[k] > 0.0:
            counts[k] = max(1, round(lengths[k] / step))
    n = counts.sum()
    points, directions = np.empty((n, 2)), np.empty((n, 2))
    weights, owners = np.empty(n), np.empty(n, dtype=np.int64)
    at = 0
    for k in range(m):
        dx, dy = segments[k, 2] - segments[k, 0], segments[k, 3] - segments[k, 1]
        for j in range(counts[k]):
            share = (j + 0.5) / counts[k]
            points[at, 0], points[at, 1] = segments[k, 0] + share * dx, segments[k, 1] + share * dy
            directions[at, 0], directions[at, 1] = dx / lengths[k], dy / lengths[k]
            weights[at] = lengths[k] / (counts[k] * step)
            owners[at] = k
            at += 1
    return points, directions, weights, owners
