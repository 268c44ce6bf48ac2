"""Match parts of two open polylines, their ends free (Wolter 2001, sections 3.1 and 3.2).

At a given pose of one polyline on the other, dynamic programming over vertex pairs finds the cheapest match
of all. A match is a path of vertex pairs; each step of it pairs one segment with one, or with a run of them.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit
from pilotage.kernels.tangent import length_factor

START = -1  # no vertex before: here a match starts


class Chain(NamedTuple):
    """An open polyline; an end that goes on lies somewhere inside a longer segment."""

    vertices: NDArray[np.float64]  # (n + 1, 2)
    lengths: NDArray[np.float64]  # (n,) positive
    directions: NDArray[np.float64]  # (n,) [rad]
    first_goes_on: bool
    last_goes_on: bool


class Prices(NamedTuple):
    """What a match costs and earns, beside eq. (2)."""

    displacement: float  # alpha [rad²/m²] a metre of match and squared metre of displacement
    reward: float  # lambda [rad²] a metre of match
    largest_run: int  # segments that may answer to a single one


class Matches(NamedTuple):
    """The cheapest match at each of h poses; one that costs nothing is empty."""

    costs: NDArray[np.float64]  # (h,) negative, or 0 [rad² m]
    paths: NDArray[np.int64]  # vertex pairs (seen, known) in order, (h, n + m + 2, 2)
    sizes: NDArray[np.int64]  # how many of the pairs there are, (h,)
    cuts: NDArray[np.bool_]  # whether the longer of the first, of the last two segments is cut, (h, 2)


@njit(cache=True)
def squared_turn(angle: float) -> float:
    """Wrap an angle, and square it."""
    wrapped = angle - math.tau * math.floor(angle / math.tau + 0.5)
    return wrapped * wrapped


@njit(cache=True)
def squared_distances(seen: Chain, known: Chain, pose: tuple[float, float, float]) -> NDArray[np.float64]:
    """Measure how far each vertex seen, carried by a pose, is from each known: |d-T|², (n + 1, m + 1)."""
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    squares = np.empty((len(seen.vertices), len(known.vertices)))
    for i in range(len(seen.vertices)):
        moved_x = x + c * seen.vertices[i, 0] - s * seen.vertices[i, 1]
        moved_y = y + s * seen.vertices[i, 0] + c * seen.vertices[i, 1]
        for j in range(len(known.vertices)):
            dx, dy = moved_x - known.vertices[j, 0], moved_y - known.vertices[j, 1]
            squares[i, j] = dx * dx + dy * dy
    return squares


@njit(cache=True)
def step_cost(
    square: float, seen_length: float, known_length: float, displacement: float, prices: Prices
) -> float:
    """Price a step of a match: S + E - lambda, each for the length matched [rad² m].

    `square` is the mean squared difference of directions [rad²], `displacement` is |d-T|² [m²]. d-T is here
    the distance of paired vertices; in the paper it is the distance of two poses (decision 0004).
    """
    dissimilarity = square * length_factor(seen_length, known_length)  # eq. (2) at the given rotation
    displacement_error = prices.displacement * displacement  # section 3.2: E(d-omega, d-T) = alpha |d-T|²
    shared = min(seen_length, known_length)
    return dissimilarity + shared * (displacement_error - prices.reward)


@njit(cache=True)
def trace_back(
    before: NDArray[np.int64], is_cut: NDArray[np.bool_], i: int, j: int, path: NDArray[np.int64], size: int
) -> tuple[int, bool]:
    """Write the vertex pairs of the match that ends at i, j to `path`, before the `size` that stand there.

    Returns how many pairs there are then, and whether the first segment is cut.
    """
    first_cut = False
    while i != START:
        path[size, 0], path[size, 1], size = i, j, size + 1
        if first_cut:
            break
        first_cut = is_cut[i, j]
        i, j = before[i, j, 0], before[i, j, 1]
    for k in range(size // 2):
        for side in range(2):
            path[k, side], path[size - 1 - k, side] = path[size - 1 - k, side], path[k, side]
    return size, first_cut


@njit(cache=True)
def cheapest_match(
    seen: Chain, known: Chain, pose: tuple[float, float, float], prices: Prices, path: NDArray[np.int64]
) -> tuple[float, int, bool, bool]:
    """Find the cheapest match with seen carried onto known by a pose (x, y, theta) (section 3.1).

    It may start and end at any pair of vertices. Where an end of one polyline goes on unseen, a longer
    segment of the other may be cut to the length of the end segment, and the ends there may lie apart.

    Writes the vertex pairs to `path` and returns the cost, their number, and whether a segment is cut at the
    first and at the last end.
    """
    n, m = len(seen.lengths), len(known.lengths)
    apart = squared_distances(seen, known, pose)
    best = np.zeros((n + 1, m + 1))  # cheapest match that ends at vertices i, j; 0 is the empty one
    before = np.full((n + 1, m + 1, 2), START)  # the pair of vertices before i, j
    is_cut = np.zeros((n + 1, m + 1), dtype=np.bool_)  # whether the match starts with a cut just before i, j
    least, last_cut = 0.0, False
    end_i = end_j = int(np.int64(0))  # a literal 0 has a type of its own
    for i in range(n + 1):
        for j in range(m + 1):
            so_far = best[i, j]
            if so_far < least:
                least, end_i, end_j, last_cut = so_far, i, j, False
            if i == n or j == m:
                continue

            length, square = 0.0, 0.0
            for k in range(min(prices.largest_run, n - i)):  # segments i .. i + k seen, j known
                turn = squared_turn(known.directions[j] - seen.directions[i + k] - pose[2])
                length, square = length + seen.lengths[i + k], square + turn * seen.lengths[i + k]
                if so_far + square >= prices.reward * known.lengths[j]:
                    break  # worse than the empty match, and the worse the longer
                distance = 0.5 * (apart[i, j] + apart[i + k + 1, j + 1])
                cost = so_far + step_cost(square / length, length, known.lengths[j], distance, prices)
                if cost < best[i + k + 1, j + 1]:
                    best[i + k + 1, j + 1], is_cut[i + k + 1, j + 1] = cost, False
                    before[i + k + 1, j + 1, 0], before[i + k + 1, j + 1, 1] = i, j

            length, square = 0.0, 0.0
            for k in range(min(prices.largest_run, m - j)):  # segment i seen, j .. j + k known
                turn = squared_turn(known.directions[j + k] - seen.directions[i] - pose[2])
                length, square = length + known.lengths[j + k], square + turn * known.lengths[j + k]
                if so_far + square >= prices.reward * seen.lengths[i]:
                    break
                distance = 0.5 * (apart[i, j] + apart[i + 1, j + k + 1])
                cost = so_far + step_cost(square / length, seen.lengths[i], length, distance, prices)
                if cost < best[i + 1, j + k + 1]:
                    best[i + 1, j + k + 1], is_cut[i + 1, j + k + 1] = cost, False
                    before[i + 1, j + k + 1, 0], before[i + 1, j + k + 1, 1] = i, j

            turn = squared_turn(known.directions[j] - seen.directions[i] - pose[2])
            a, b = seen.lengths[i], known.lengths[j]
            if (i == 0 and seen.first_goes_on and a <= b) or (j == 0 and known.first_goes_on and b <= a):
                cost = step_cost(turn, min(a, b), min(a, b), apart[i + 1, j + 1], prices)
                if cost < best[i + 1, j + 1]:
                    best[i + 1, j + 1], is_cut[i + 1, j + 1] = cost, True
                    before[i + 1, j + 1, 0], before[i + 1, j + 1, 1] = i, j
            if (i == n - 1 and seen.last_goes_on and a <= b) or (
                j == m - 1 and known.last_goes_on and b <= a
            ):
                cost = so_far + step_cost(turn, min(a, b), min(a, b), apart[i, j], prices)
                if cost < least:
                    least, end_i, end_j, last_cut = cost, i, j, True

    if last_cut:
        path[0, 0], path[0, 1] = end_i + 1, end_j + 1
    size, first_cut = trace_back(before, is_cut, end_i, end_j, path, 1 if last_cut else 0)
    return least, size, first_cut, last_cut


@njit(cache=True)
def match_at_poses(seen: Chain, known: Chain, poses: NDArray[np.float64], prices: Prices) -> Matches:
    """Find the cheapest match at each of several poses (h, 3)."""
    count, pairs = len(poses), len(seen.vertices) + len(known.vertices)
    matches = Matches(
        np.zeros(count),
        np.zeros((count, pairs, 2), dtype=np.int64),
        np.zeros(count, dtype=np.int64),
        np.zeros((count, 2), dtype=np.bool_),
    )
    for h in range(count):
        pose = (poses[h, 0], poses[h, 1], poses[h, 2])
        cost, size, first_cut, last_cut = cheapest_match(seen, known, pose, prices, matches.paths[h])
        matches.costs[h], matches.sizes[h] = cost, size
        matches.cuts[h, 0], matches.cuts[h, 1] = first_cut, last_cut
    return matches
