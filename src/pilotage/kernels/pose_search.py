"""Find poses from which a scan may have been taken: headings by histograms of directions, places by trial.

The correlation of direction histograms is that of Weiss, Wetzler and von Puttkamer (1994); here directions
count over the full turn, since free space lies left of every segment.
"""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from pilotage.kernels.segment_field import NONE, SegmentField
from pilotage.kernels.segment_sampling import direction_histogram


@njit(cache=True)
def likely_turns(
    directions: NDArray[np.float64],
    weights: NDArray[np.float64],
    field: SegmentField,
    heading: float,
    max_turn: float,
    bins: int,
    count: int,
) -> NDArray[np.float64]:
    """Find the turns from `heading` at which directions of scan and map agree best, 0 first, (<= count,)."""
    scan = direction_histogram(directions, weights, bins)
    known = direction_histogram(field.directions, field.lengths, bins)
    reach = int(max_turn / math.tau * bins)
    agreement = np.zeros(2 * reach + 3)
    offset = heading / math.tau * bins
    for k in range(len(agreement)):
        shift = offset + k - reach - 1
        low = math.floor(shift)
        share = shift - low
        for b in range(bins):
            at = (b + int(low)) % bins
            agreement[k] += scan[b] * ((1.0 - share) * known[at] + share * known[(at + 1) % bins])
    turns = np.zeros(count)
    found = 1
    for _ in range(count - 1):
        best, best_k = 0.0, -1
        for k in range(1, len(agreement) - 1):
            peak = agreement[k] >= agreement[k - 1] and agreement[k] >= agreement[k + 1]
            if peak and agreement[k] > best:
                best, best_k = agreement[k], k
        if best_k < 0:
            break
        turns[found] = (best_k - reach - 1) * math.tau / bins
        agreement[best_k] = 0.0
        found += 1
    return turns[:found]


@njit(cache=True)
def score_places(
    points: NDArray[np.float64],
    directions: NDArray[np.float64],
    weights: NDArray[np.float64],
    field: SegmentField,
    heading: float,
    xs: NDArray[np.float64],
    ys: NDArray[np.float64],
    width: float,
    min_cosine: float,
) -> NDArray[np.float64]:
    """Sum, for every x and y, the weights of the points near a segment that runs their way.

    A point at distance d counts 1 / (1 + (d / width)^2). Returns (ys, xs).
    """
    scores = np.zeros((len(ys), len(xs)))
    rows, columns = field.nearest.shape
    c, s = math.cos(heading), math.sin(heading)
    for i in range(len(points)):
        rx, ry = c * points[i, 0] - s * points[i, 1], s * points[i, 0] + c * points[i, 1]
        vx, vy = c * directions[i, 0] - s * directions[i, 1], s * directions[i, 0] + c * directions[i, 1]
        for iy in range(len(ys)):
            row = math.floor((ys[iy] + ry - field.bottom) / field.cell)
            if row < 0 or row >= rows:
                continue
            for ix in range(len(xs)):
                column = math.floor((xs[ix] + rx - field.left) / field.cell)
                if column < 0 or column >= columns:
                    continue
                k = field.nearest[row, column]
                if k == NONE or vx * field.directions[k, 0] + vy * field.directions[k, 1] < min_cosine:
                    continue
                ratio = field.distance[row, column] / width
                scores[iy, ix] += weights[i] / (1.0 + ratio * ratio)
    return scores


@njit(cache=True)
def search_poses(
    points: NDArray[np.float64],
    directions: NDArray[np.float64],
    weights: NDArray[np.float64],
    field: SegmentField,
    guess: NDArray[np.float64],
    turns: NDArray[np.float64],
    turn_deviation: float,
    place_deviation: float,
    radius: float,
    step: float,
    width: float,
    min_cosine: float,
    penalty: float,
    count: int,
) -> NDArray[np.float64]:
    """Try turns and places up to `radius` from a guess (x, y, theta) and return the best poses, (count, 3).

    A pose scores the share of points near their segments, less `penalty` for each squared deviation from the
    guess. Poses of one turn lie at least three steps apart.
    """
    side = 2 * math.ceil(radius / step) + 1
    offsets = (np.arange(side) - side // 2) * step
    total = max(weights.sum(), 1.0)
    scores = np.empty((len(turns), side, side))
    for h in range(len(turns)):
        scores[h] = (
            score_places(
                points,
                directions,
                weights,
                field,
                guess[2] + turns[h],
                guess[0] + offsets,
                guess[1] + offsets,
                width,
                min_cosine,
            )
            / total
        )
        for iy in range(side):
            for ix in range(side):
                place = (offsets[ix] ** 2 + offsets[iy] ** 2) / place_deviation**2
                scores[h, iy, ix] -= penalty * (place + (turns[h] / turn_deviation) ** 2)
    poses = np.empty((count, 3))
    for n in range(count):
        best, h, iy, ix = -np.inf, 0, side // 2, side // 2
        for i in range(len(turns)):
            for j in range(side):
                for k in range(side):
                    if scores[i, j, k] > best:
                        best, h, iy, ix = scores[i, j, k], i, j, k
        poses[n, 0], poses[n, 1], poses[n, 2] = (
            guess[0] + offsets[ix],
            guess[1] + offsets[iy],
            guess[2] + turns[h],
        )
        scores[h, max(0, iy - 2) : iy + 3, max(0, ix - 2) : ix + 3] = -np.inf
    return poses
