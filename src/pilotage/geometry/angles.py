"""Angles in radians, counter-clockwise."""

import math
from typing import overload

import numpy as np

from pilotage.geometry.arrays import Array


@overload
def wrap_angle(angle: float) -> float: ...
@overload
def wrap_angle(angle: Array) -> Array: ...
def wrap_angle(angle: float | Array) -> float | Array:
    """Bring an angle, or an array of them, into (-pi, pi].

    >>> wrap_angle(-math.pi) == math.pi
    True
    >>> wrap_angle(np.array([0.5, -math.pi])).tolist() == [0.5, math.pi]
    True
    """
    if isinstance(angle, np.ndarray):
        return np.asarray(angle - math.tau * np.ceil(angle / math.tau - 0.5))
    wrapped = math.remainder(angle, math.tau)
    return math.pi if wrapped == -math.pi else wrapped
