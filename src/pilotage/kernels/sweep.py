"""Ranges from many places in all directions at once: each segment is swept over the directions it spans."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit


@njit(cache=True)
def sweep(
    places: NDArray[np.float64], segments: NDArray[np.float64], directions: int, farthest: float
) -> NDArray[np.float32]:
    """Measure from each place (n, 2) to the nearest segment in evenly spaced directions, (n, directions).

    Direction k points at 2 pi k / directions from the x axis. Segments are rows x1, y1, x2, y2, (m, 4).
    Where there is none within `farthest`, that is the range.
    """
    step = math.tau / directions
    cosines, sines = np.empty(3 * directions), np.empty(3 * directions)
    for k in range(3 * directions):  # a segment lies between -2 pi and 2 pi
        cosines[k] = math.cos((k - directions) * step)
        sines[k] = math.sin((k - directions) * step)
    ranges = np.full((len(places), directions), np.float32(farthest))
    for i in range(len(places)):
        x, y, angle = math.nan, math.nan, math.nan  # the end of the segment before, where the next may begin
        for j in range(len(segments)):
            first_x, first_y = segments[j, 0] - places[i, 0], segments[j, 1] - places[i, 1]
            last_x, last_y = segments[j, 2] - places[i, 0], segments[j, 3] - places[i, 1]
            first = angle if first_x == x and first_y == y else math.atan2(first_y, first_x)
            x, y, angle = last_x, last_y, math.atan2(last_y, last_x)
            width = angle - first
            if width > math.pi:
                width -= math.tau
            elif width < -math.pi:
                width += math.tau
            low = min(first, first + width)
            # all points of the segment's line have the same product with its normal
            normal_x, normal_y = first_y - last_y, last_x - first_x
            offset = normal_x * first_x + normal_y * first_y
            for k in range(math.ceil(low / step), math.floor((low + abs(width)) / step) + 1):
                along = normal_x * cosines[k + directions] + normal_y * sines[k + directions]
                if along != 0.0:
                    reach = np.float32(offset / along)
                    around = k - directions if k >= directions else k + directions if k < 0 else k
                    if 0.0 <= reach < ranges[i, around]:
                        ranges[i, around] = reach
    return ranges
