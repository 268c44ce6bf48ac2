"""Areas of rings and circles through points."""

import numpy as np

from pilotage.geometry.arrays import Array


def signed_area(ring: Array) -> float:
    """Return the area within vertices (n, 2), the first not repeated; > 0 if they turn counter-clockwise.

    >>> signed_area(np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]]))
    1.0
    """
    x, y = (ring - ring[0]).T  # the first and the last edge meet in 0, and add nothing
    return float(np.sum(x[:-1] * y[1:] - y[:-1] * x[1:])) / 2.0


def fit_circle(points: Array) -> tuple[Array, float]:
    """Fit a circle to points (n, 2) by Kasa's least squares; its center (2,) and radius.

    Points on a line give a circle that is too large to mean anything, or none of finite size.

    >>> center, radius = fit_circle(np.array([[3.0, 1.0], [1.0, 3.0], [-1.0, 1.0]]))
    >>> center.round(9).tolist(), round(radius, 9)
    ([1.0, 1.0], 2.0)
    """
    middle = points.mean(axis=0)
    shifted = points - middle
    matrix = np.column_stack([2.0 * shifted, np.ones(len(points))])
    solution, *_ = np.linalg.lstsq(matrix, (shifted**2).sum(axis=1), rcond=None)
    offset = solution[:2]
    return middle + offset, float(np.sqrt(max(solution[2] + offset @ offset, 0.0)))
