"""A laser scan of ROS as one of ours."""

import math
from functools import lru_cache
from typing import Any

import numpy as np

from pilotage.geometry import Array
from pilotage.io.bags.frames import Mount
from pilotage.perception import LaserScan

RANGE_DIGITS = 4
"""Decimals of ranges [m] that are kept: no laser of a robot resolves a tenth of a millimetre, and ranges are
then the same numbers in a bag, which holds them in single precision, and in a text file."""


def laser_scan(
    message: Any,  # noqa: ANN401  # types of ROS are made at run time
    stamp: float,
    mount: Mount,
    beams: int | None = None,
) -> LaserScan:
    """Read a sensor_msgs/LaserScan, with special ranges as REP-117 has them; 0 counts as invalid.

    With `beams`, only so many are read. Raises ValueError if the message is no scan.
    """
    angle_min, increment = decimal(message.angle_min), decimal(message.angle_increment)
    if mount.is_mirrored:
        angle_min, increment = -angle_min, -increment
    range_min, range_max = decimal(message.range_min), decimal(message.range_max)
    return LaserScan(
        stamp,
        angle_min,
        increment,
        ranges_of(message.ranges[:beams]),
        range_min=max(range_min, 0.0),
        range_max=range_max if range_max > 0.0 else math.inf,
        base_from_laser=mount.base_from_laser,
    )


def ranges_of(values: Any) -> Array:  # noqa: ANN401  # an array, or a list where a message is written by hand
    """Return ranges in double precision, (n,) [m]."""
    ranges = np.asarray(values, dtype=np.float64).round(RANGE_DIGITS)
    ranges[ranges == 0.0] = np.nan
    return ranges


@lru_cache(maxsize=64)  # a laser has few of them
def decimal(value: float) -> float:
    """Return the shortest decimal number that a number of single precision stands for.

    >>> decimal(0.15000000596046448)
    0.15
    """
    return float(str(np.float32(value)))
