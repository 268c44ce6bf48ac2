"""Angles in radians, counter-clockwise."""

import math


def wrap_angle(angle: float) -> float:
    """Bring an angle into (-pi, pi].

    >>> wrap_angle(-math.pi) == math.pi
    True
    """
    wrapped = math.remainder(angle, math.tau)
    return math.pi if wrapped == -math.pi else wrapped
