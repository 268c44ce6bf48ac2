"""Displacements of the robot carried to the sketch, for many particles at once."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit


@njit(cache=True)
def linear_map(heading: float, log_scale: float, p: float, q: float) -> tuple[float, float, float, float]:
    """Return the matrix that turns, stretches and scales, row by row: scale * stretch @ rotation."""
    cosine, sine = math.cos(heading), math.sin(heading)
    size = math.sqrt(p * p + q * q)  # hypot, cosh and sinh take three times as long
    scale, growth = math.exp(log_scale), math.exp(size)
    # exp([[p, q], [q, -p]]) = cosh(size) I + sinh(size) / size [[p, q], [q, -p]]
    even = scale * 0.5 * (growth + 1.0 / growth)
    share = scale * (0.5 * (growth - 1.0 / growth) / size if size > 0.0 else 1.0)
    xx, xy, yy = even + share * p, share * q, even - share * p
    return xx * cosine + xy * sine, xy * cosine - xx * sine, xy * cosine + yy * sine, yy * cosine - xy * sine


@njit(cache=True)
def displace(
    states: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Turn, stretch and scale displacements (n,), (n,) in the robot's frame [m], (2, n) [drawing units].

    Columns of `states` (6, n) are as in kernels/visibility.py.
    """
    carried = np.empty((2, states.shape[1]))
    for i in range(states.shape[1]):
        xx, xy, yx, yy = linear_map(states[2, i], states[3, i], states[4, i], states[5, i])
        carried[0, i] = xx * x[i] + xy * y[i]
        carried[1, i] = yx * x[i] + yy * y[i]
    return carried
