"""Beams against segments: how far each beam goes before it meets one."""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray


@njit(cache=True)
def cast(
    origins: NDArray[np.float64], directions: NDArray[np.float64], segments: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Measure from each origin (n, 2) along its direction (n,) [rad] to the nearest segment, (n,).

    Segments are rows x1, y1, x2, y2, (m, 4), their ends included. A beam that meets none goes on to inf; one
    that runs along a segment passes it.
    """
    ranges = np.full(len(directions), np.inf)
    for i in range(len(directions)):
        beam_x, beam_y = math.cos(directions[i]), math.sin(directions[i])
        nearest = np.inf
        for j in range(len(segments)):
            start_x, start_y = segments[j, 0] - origins[i, 0], segments[j, 1] - origins[i, 1]
            along_x, along_y = segments[j, 2] - segments[j, 0], segments[j, 3] - segments[j, 1]
            # origin + distance * beam = start + share * along, solved by Cramer's rule
            determinant = beam_x * along_y - beam_y * along_x
            if determinant == 0.0:
                continue
            distance = (start_x * along_y - start_y * along_x) / determinant
            if not 0.0 <= distance < nearest:
                continue
            share = (start_x * beam_y - start_y * beam_x) / determinant
            if 0.0 <= share <= 1.0:
                nearest = distance
        ranges[i] = nearest
    return ranges
