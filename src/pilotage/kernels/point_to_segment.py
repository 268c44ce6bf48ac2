"""Refine a pose by the distances of points to segments (Chen and Medioni 1991), robustly, with a prior."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit
from pilotage.kernels.samples import Samples
from pilotage.kernels.segment_field import NONE, SegmentField

CUTOFF = 3.0
"""Points farther from their segment than this many scales of the kernel do not count."""


@njit(cache=True)
def solve_symmetric(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Solve a @ x = b for symmetric (3, 3) and (3,), by cofactors; a singular one moves nothing."""
    c00 = a[1, 1] * a[2, 2] - a[1, 2] * a[1, 2]
    c01 = a[0, 2] * a[1, 2] - a[0, 1] * a[2, 2]
    c02 = a[0, 1] * a[1, 2] - a[0, 2] * a[1, 1]
    c11 = a[0, 0] * a[2, 2] - a[0, 2] * a[0, 2]
    c12 = a[0, 1] * a[0, 2] - a[0, 0] * a[1, 2]
    c22 = a[0, 0] * a[1, 1] - a[0, 1] * a[0, 1]
    determinant = a[0, 0] * c00 + a[0, 1] * c01 + a[0, 2] * c02
    x = np.zeros(3)
    if determinant > 0.0:
        x[0] = (c00 * b[0] + c01 * b[1] + c02 * b[2]) / determinant
        x[1] = (c01 * b[0] + c11 * b[1] + c12 * b[2]) / determinant
        x[2] = (c02 * b[0] + c12 * b[1] + c22 * b[2]) / determinant
    return x


@njit(cache=True)
def linearize(
    samples: Samples,
    field: SegmentField,
    pose: NDArray[np.float64],
    scale: float,
    min_cosine: float,
    overhang: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Build the normal equations of all samples at a pose (x, y, theta).

    A point counts with the weight of Geman and McClure, 1 / (1 + (e / scale)^2)^2, up to an error e of
    `CUTOFF` scales, if its own contour runs the same way as the nearest segment and it lies no more than
    `overhang` past its end.

    Returns
    -------
    hessian, gradient, inlier_weight
        (3, 3), (3,), and the sum of weights.
    """
    points, directions, weights = samples
    hessian, gradient = np.zeros((3, 3)), np.zeros(3)
    inlier_weight = 0.0
    c, s = math.cos(pose[2]), math.sin(pose[2])
    rows, columns = field.nearest.shape
    for i in range(len(points)):
        rx, ry = c * points[i, 0] - s * points[i, 1], s * points[i, 0] + c * points[i, 1]
        x, y = pose[0] + rx, pose[1] + ry
        column, row = math.floor((x - field.left) / field.cell), math.floor((y - field.bottom) / field.cell)
        if column < 0 or row < 0 or column >= columns or row >= rows:
            continue
        k = field.nearest[row, column]
        if k == NONE:
            continue
        ux, uy = field.directions[k, 0], field.directions[k, 1]
        vx, vy = c * directions[i, 0] - s * directions[i, 1], s * directions[i, 0] + c * directions[i, 1]
        if (vx != 0.0 or vy != 0.0) and ux * vx + uy * vy < min_cosine:
            continue
        px, py = x - field.segments[k, 0], y - field.segments[k, 1]
        along = ux * px + uy * py
        if along < -overhang or along > field.lengths[k] + overhang:
            continue
        e = ux * py - uy * px
        if abs(e) > CUTOFF * scale:
            continue
        ratio = e / scale
        w = weights[i] / (1.0 + ratio * ratio) ** 2
        j0, j1, j2 = -uy, ux, ux * rx + uy * ry
        hessian[0, 0] += w * j0 * j0
        hessian[0, 1] += w * j0 * j1
        hessian[0, 2] += w * j0 * j2
        hessian[1, 1] += w * j1 * j1
        hessian[1, 2] += w * j1 * j2
        hessian[2, 2] += w * j2 * j2
        gradient[0] += w * j0 * e
        gradient[1] += w * j1 * e
        gradient[2] += w * j2 * e
        inlier_weight += w
    hessian[1, 0], hessian[2, 0], hessian[2, 1] = hessian[0, 1], hessian[0, 2], hessian[1, 2]
    return hessian, gradient, inlier_weight


@njit(cache=True)
def refine_pose(
    samples: Samples,
    field: SegmentField,
    start: NDArray[np.float64],
    prior: NDArray[np.float64],
    information: NDArray[np.float64],
    robust_scale: float,
    scales: NDArray[np.float64],
    min_cosine: float,
    overhang: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Take one Gauss-Newton step for each scale of the kernel, wide to narrow, from a pose (x, y, theta).

    `information` (3, 3) holds the pose near `prior`, in units of the information of one point; its hold
    loosens with the distance m^2 in these units as 1 / (1 + m^2 / robust_scale), since odometry is either
    right or grossly wrong.

    Returns
    -------
    pose, hessian, inlier_weight
        As `linearize` has them at the last scale.
    """
    pose = start.copy()
    for scale in scales:
        hessian, gradient, _ = linearize(samples, field, pose, scale, min_cosine, overhang)
        delta = pose - prior
        delta[2] -= math.tau * round(delta[2] / math.tau)
        hold = information / (1.0 + delta @ (information @ delta) / robust_scale)
        pose -= solve_symmetric(hessian + hold, gradient + hold @ delta)
    hessian, _, inlier_weight = linearize(samples, field, pose, scales[-1], min_cosine, overhang)
    return pose, hessian, inlier_weight
