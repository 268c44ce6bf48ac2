"""Displacements of the robot carried to the sketch, for many particles at once."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit


@njit(cache=True)
def displace(
    states: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Turn, stretch and scale displacements (n,), (n,) in the robot's frame [m], (2, n) [drawing units].

    Columns of `states` (6, n) are as in kernels/visibility.py.
    """
    carried = np.empty((2, states.shape[1]))
    for i in range(states.shape[1]):
        cosine, sine = math.cos(states[2, i]), math.sin(states[2, i])
        turned_x, turned_y = cosine * x[i] - sine * y[i], sine * x[i] + cosine * y[i]
        scale, p, q = math.exp(states[3, i]), states[4, i], states[5, i]
        size = math.hypot(p, q)
        # exp([[p, q], [q, -p]]) = cosh(size) I + sinh(size) / size [[p, q], [q, -p]]
        even = math.cosh(size)
        share = math.sinh(size) / size if size > 0.0 else 1.0
        carried[0, i] = scale * ((even + share * p) * turned_x + share * q * turned_y)
        carried[1, i] = scale * (share * q * turned_x + (even - share * p) * turned_y)
    return carried
