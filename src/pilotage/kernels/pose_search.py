"""Find poses from which a scan may have been taken, by trial of headings and places.

Correlative scan matching (Olson 2009) on the nearest-segment field. All headings within reach are tried: the
best by direction histogram (Weiss et al. 1994) alone miss the right one in clutter (decision 0006).
"""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit
from pilotage.kernels.samples import Samples, Trials
from pilotage.kernels.segment_field import NONE, SegmentField


@njit(cache=True)
def add_place_scores(
    scores: NDArray[np.float64],
    samples: Samples,
    field: SegmentField,
    corner: NDArray[np.float64],
    heading: float,
    stride: int,
    scale: float,
    min_cosine: float,
) -> None:
    """Add, for places (rows, columns), the weights of the samples near a segment that runs their way.

    The places start at a `corner` (x, y) and lie `stride` cells of the field apart. A point at distance d
    counts 1 / (1 + (d / scale)^2).
    """
    points, directions, weights = samples
    rows, columns = field.nearest.shape
    c, s = math.cos(heading), math.sin(heading)
    for i in range(len(points)):
        x = corner[0] + c * points[i, 0] - s * points[i, 1]
        y = corner[1] + s * points[i, 0] + c * points[i, 1]
        vx, vy = c * directions[i, 0] - s * directions[i, 1], s * directions[i, 0] + c * directions[i, 1]
        first_row, first_column = (
            math.floor((y - field.bottom) / field.cell),
            math.floor((x - field.left) / field.cell),
        )
        for iy in range(scores.shape[0]):
            row = first_row + iy * stride
            if row < 0 or row >= rows:
                continue
            for ix in range(scores.shape[1]):
                column = first_column + ix * stride
                if column < 0 or column >= columns:
                    continue
                k = field.nearest[row, column]
                if k == NONE or vx * field.directions[k, 0] + vy * field.directions[k, 1] < min_cosine:
                    continue
                ratio = field.distance[row, column] / scale
                scores[iy, ix] += weights[i] / (1.0 + ratio * ratio)


@njit(cache=True)
def take_peak(scores: NDArray[np.float64]) -> tuple[int, int, int]:
    """Find the best of all scores (turns, rows, columns), and wipe it out with those around it.

    If all are wiped out it is the middle one.
    """
    turns, rows, columns = scores.shape
    best, h, iy, ix = -np.inf, turns // 2, rows // 2, columns // 2
    for i in range(turns):
        for j in range(rows):
            for k in range(columns):
                if scores[i, j, k] > best:
                    best, h, iy, ix = scores[i, j, k], i, j, k
    scores[max(0, h - 1) : h + 2, max(0, iy - 2) : iy + 3, max(0, ix - 2) : ix + 3] = -np.inf
    return h, iy, ix


@njit(cache=True)
def search_poses(
    samples: Samples,
    field: SegmentField,
    prior: NDArray[np.float64],
    stds: NDArray[np.float64],
    window: NDArray[np.float64],
    trials: Trials,
) -> NDArray[np.float64]:
    """Try headings and places around a pose (x, y, theta) and return the best, (n, 3).

    `stds` and `window` are the standard deviations of the prior, and how far from it to look: place [m] and
    heading [rad], (2,) each.
    """
    step, turn_step = trials.stride * field.cell, trials.turn_step
    half, half_turns = math.ceil(window[0] / step), math.ceil(window[1] / turn_step)
    side, turns = 2 * half + 1, 2 * half_turns + 1
    corner = prior[:2] - half * step
    scores = np.zeros((turns, side, side))
    total = max(samples.weights.sum(), 1.0)
    for h in range(turns):
        turn = (h - half_turns) * turn_step
        heading = prior[2] + turn
        add_place_scores(
            scores[h], samples, field, corner, heading, trials.stride, trials.scale, trials.min_cosine
        )
        for iy in range(side):
            for ix in range(side):
                place = ((ix - half) ** 2 + (iy - half) ** 2) * (step / stds[0]) ** 2
                m = place + (turn / stds[1]) ** 2
                penalty = trials.prior_weight * math.log(1.0 + m / trials.robust_scale)
                scores[h, iy, ix] = scores[h, iy, ix] / total - penalty
    poses = np.empty((trials.kept, 3))
    for n in range(trials.kept):
        h, iy, ix = take_peak(scores)
        poses[n, 0], poses[n, 1] = corner[0] + ix * step, corner[1] + iy * step
        poses[n, 2] = prior[2] + (h - half_turns) * turn_step
    return poses
