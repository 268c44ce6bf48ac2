"""The integral of eq. (2) (Latecki and Lakämper 2000; Wolter 2001, section 3)."""

import numpy as np

from pilotage.kernels.compiling import njit
from pilotage.kernels.steps import Steps

ROUNDING = 1e-9  # shares of length and sums of turns that differ by less are equal


@njit(cache=True)
def length_factor(c_length: float, d_length: float) -> float:
    """Return what eq. (2) multiplies its integral by: long arcs count more, and so do unequal ones."""
    return max(c_length, d_length) * max(c_length / d_length, d_length / c_length)


@njit(cache=True)
def mean_and_variance(
    c: Steps, c_first: int, c_last: int, d: Steps, d_first: int, d_last: int
) -> tuple[float, float]:
    """Return the mean [rad] and the variance [rad²] of T(c)(s) - T(d)(s) over s in [0, 1].

    Of c only the pieces from c_first to before c_last count, and so with d. The two step functions are merged
    at all their stops, so that both integrals are exact: O(n + m).
    """
    c_start, c_scale = c.stops[c_first], 1.0 / (c.stops[c_last] - c.stops[c_first])
    d_start, d_scale = d.stops[d_first], 1.0 / (d.stops[d_last] - d.stops[d_first])
    c_stop = (c.stops[c_first + 1] - c_start) * c_scale
    d_stop = (d.stops[d_first + 1] - d_start) * d_scale
    offset = c.directions[c_first] - d.directions[d_first]  # keeps the squares small, and so their sum exact
    p, q, s = c_first, d_first, 0.0
    mean, square = 0.0, 0.0
    while True:
        difference = c.directions[p] - d.directions[q] - offset
        if c_stop <= d_stop:
            mean += difference * (c_stop - s)
            square += difference * difference * (c_stop - s)
            p, s = p + 1, c_stop
            if p == c_last:
                break
            c_stop = (c.stops[p + 1] - c_start) * c_scale
        else:
            mean += difference * (d_stop - s)
            square += difference * difference * (d_stop - s)
            q, s = q + 1, d_stop
            if q == d_last:
                break
            d_stop = (d.stops[q + 1] - d_start) * d_scale
    return mean + offset, max(square - mean * mean, 0.0)


@njit(cache=True)
def median(c: Steps, c_first: int, c_last: int, d: Steps, d_first: int, d_last: int) -> float:
    """Return the median of T(c)(s) - T(d)(s) over s in [0, 1] [rad]; the middle of all medians if many.

    While the mean is drawn along by a notch, the median is not, as long as the notch is short.
    """
    count = c_last - c_first + d_last - d_first
    differences, widths = np.empty(count), np.zeros(count)
    c_length, d_length = c.stops[c_last] - c.stops[c_first], d.stops[d_last] - d.stops[d_first]
    p, q, s, k = c_first, d_first, 0.0, 0
    while p < c_last and q < d_last:
        c_stop = (c.stops[p + 1] - c.stops[c_first]) / c_length
        d_stop = (d.stops[q + 1] - d.stops[d_first]) / d_length
        stop = min(c_stop, d_stop)
        differences[k], widths[k] = c.directions[p] - d.directions[q], stop - s
        p, q, s, k = p + (c_stop <= stop), q + (d_stop <= stop), stop, k + 1
    order = np.argsort(differences[:k])
    share = np.cumsum(widths[order])
    low, high = np.searchsorted(share, 0.5 - ROUNDING), np.searchsorted(share, 0.5 + ROUNDING)
    return float(0.5 * (differences[order[low]] + differences[order[high]]))


@njit(cache=True)
def arc_dissimilarity(c: Steps, c_first: int, c_last: int, d: Steps, d_first: int, d_last: int) -> float:
    """Compute S(c, d), eq. (2), of two stretches as they are [rad² times unit of length].

    The best rotation is minus the mean difference of directions; what the integral leaves is the variance.
    """
    _, variance = mean_and_variance(c, c_first, c_last, d, d_first, d_last)
    c_length, d_length = c.stops[c_last] - c.stops[c_first], d.stops[d_last] - d.stops[d_first]
    return variance * length_factor(c_length, d_length)  # eq. (2)
