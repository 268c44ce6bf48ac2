"""Order-keeping correspondence of segments inside arcs (Basri et al. 1998; Wolter 2001, section 3)."""

import numpy as np

from pilotage.kernels.compiling import njit
from pilotage.kernels.steps import Steps
from pilotage.kernels.tangent import arc_dissimilarity, length_factor, mean_and_variance, median


@njit(cache=True)
def segment_dissimilarity(
    c: Steps,
    c_first: int,
    c_last: int,
    d: Steps,
    d_first: int,
    d_last: int,
    rotation: float,
    largest_run: int,
) -> float:
    """Sum up S over the cheapest correspondence of segments, all of d turned by the same `rotation` [rad].

    One piece of c answers to one to `largest_run` pieces of d in a row, or the reverse. With a rotation of
    its own each single pair would fit exactly: any two arcs with equally many segments would then be alike.
    """
    n, m = c_last - c_first, d_last - d_first
    best = np.full((n + 1, m + 1), np.inf)
    best[0, 0] = 0.0
    for i in range(n):
        p = c_first + i
        for j in range(m):
            q = d_first + j
            if best[i, j] == np.inf:  # section 3: order-keeping correspondence of segments
                continue
            c_length, square = 0.0, 0.0
            d_length = d.stops[q + 1] - d.stops[q]
            for k in range(min(largest_run, n - i)):  # pieces p .. p + k against piece q
                length = c.stops[p + k + 1] - c.stops[p + k]
                difference = c.directions[p + k] - d.directions[q] - rotation
                c_length, square = c_length + length, square + difference * difference * length
                cost = best[i, j] + square / c_length * length_factor(c_length, d_length)
                best[i + k + 1, j + 1] = min(best[i + k + 1, j + 1], cost)
            d_length, square = 0.0, 0.0
            c_length = c.stops[p + 1] - c.stops[p]
            for k in range(min(largest_run, m - j)):  # piece p against pieces q .. q + k
                length = d.stops[q + k + 1] - d.stops[q + k]
                difference = c.directions[p] - d.directions[q + k] - rotation
                d_length, square = d_length + length, square + difference * difference * length
                cost = best[i, j] + square / d_length * length_factor(c_length, d_length)
                best[i + 1, j + k + 1] = min(best[i + 1, j + k + 1], cost)
    return float(best[n, m])


@njit(cache=True)
def combined_dissimilarity(
    c: Steps, c_first: int, c_last: int, d: Steps, d_first: int, d_last: int, largest_run: int
) -> float:
    """Take the lesser of eq. (2) and the correspondence of segments, the paper's own measure of two arcs.

    The one rotation of the segments is the mean or the median difference of directions, the better of both.
    """
    simple = arc_dissimilarity(c, c_first, c_last, d, d_first, d_last)
    mean, _ = mean_and_variance(c, c_first, c_last, d, d_first, d_last)
    middle = median(c, c_first, c_last, d, d_first, d_last)
    at_mean = segment_dissimilarity(c, c_first, c_last, d, d_first, d_last, mean, largest_run)
    at_median = segment_dissimilarity(c, c_first, c_last, d, d_first, d_last, middle, largest_run)
    return min(simple, at_mean, at_median)  # section 3: the minimum with eq. (2)
