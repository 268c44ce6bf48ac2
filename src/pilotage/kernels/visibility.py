"""How well what a scan shows agrees with what could be seen on the drawing, for many particles at once.

A particle is a column of `states` (6, n): x, y [drawing units], heading [rad], log scale [log drawing units
per metre], and the stretch (p, q): a point of the robot's frame is carried to the sketch by

    (x, y) + exp(log_scale) * exp([[p, q], [q, -p]]) @ R(heading) @ point.

All logarithms of lengths are whole numbers of `LOG_STEP`, so that one look-up replaces log, exp and atan2.
"""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit
from pilotage.kernels.displacement import linear_map

LOG_STEP = 0.03  # 3 % of a range, a fifth of the deviation that a careful drawing has
LOG_ZERO = 80  # level of a range of one grid cell; level 0 is an eleventh of that, 255 almost 200 cells
NO_RETURN = 32767  # level of a beam that did not come back
HEADINGS = 240  # directions before stretching: steps of 1.5 degrees
STRETCHES = 9  # levels of p and of q
MAX_STRETCH = 0.8  # of p and of q: lengths up to 2.2 times too long one way and too short the other


@njit(cache=True)
def stretch_tables(directions: int) -> tuple[NDArray[np.int16], NDArray[np.int16]]:
    """Tabulate where a stretch turns each direction and by what it lengthens it, each (p, q, 2 * HEADINGS).

    All directions stand there twice, so that heading and beam may be added without a division.
    The first counts in steps of 2 pi / directions, the second is a logarithm in steps of LOG_STEP.
    """
    turned = np.empty((STRETCHES, STRETCHES, 2 * HEADINGS), np.int16)
    lengthened = np.empty((STRETCHES, STRETCHES, 2 * HEADINGS), np.int16)
    middle = (STRETCHES - 1) / 2
    for i in range(STRETCHES):
        for j in range(STRETCHES):
            p, q = (i - middle) / middle * MAX_STRETCH, (j - middle) / middle * MAX_STRETCH
            size = math.hypot(p, q)
            share = math.sinh(size) / size if size > 0.0 else 1.0
            for k in range(2 * HEADINGS):
                cosine, sine = math.cos(math.tau * k / HEADINGS), math.sin(math.tau * k / HEADINGS)
                # exp([[p, q], [q, -p]]) = cosh(size) I + sinh(size) / size [[p, q], [q, -p]]
                x = (math.cosh(size) + share * p) * cosine + share * q * sine
                y = share * q * cosine + (math.cosh(size) - share * p) * sine
                turned[i, j, k] = round(math.atan2(y, x) / math.tau * directions) % directions
                lengthened[i, j, k] = round(math.log(math.hypot(x, y)) / LOG_STEP)
    return turned, lengthened


@njit(cache=True)
def stretch_level(stretch: float) -> int:
    """Return the nearest tabulated level of p or q."""
    middle = (STRETCHES - 1) / 2
    return min(max(int(stretch / MAX_STRETCH * middle + middle + 0.5), 0), STRETCHES - 1)


@njit(cache=True)
def sum_over_beams(
    states: NDArray[np.float64],
    motions: NDArray[np.float64],
    weights: NDArray[np.float64],
    starts: NDArray[np.int64],
    scans: tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]],
    log_ranges: NDArray[np.uint8],
    grid: tuple[float, float, float, int, int],
    tables: tuple[NDArray[np.int16], NDArray[np.int16]],
    values: NDArray[np.float32],
    no_return: tuple[int, float],
    outside: float,
    tolerance: int,
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Sum over the beams of scans a value of the measured and the predicted range, for each particle.

    The first scan was taken at the `states`, scan k at `motions` (k, 3), x, y and theta in the robot's frame
    there, and counts with its weight. `scans` holds of all scans, one after the other: directions in the
    robot's frame, 0 .. HEADINGS - 1 steps; measured ranges as log metres in steps of LOG_STEP, or NO_RETURN;
    and classes of ranges. Scan k begins at `starts` (k + 1,). `log_ranges` (columns * rows, directions) is
    the drawing's range table on the grid (left, bottom, cell size, columns, rows).
    `values` (classes, 2 k + 1) is indexed by the class and by k + log(predicted / measured) in steps of
    LOG_STEP. A beam that did not return counts `no_return[1]` where a wall is predicted nearer than level
    `no_return[0]`, else 0. A particle off the grid gets `outside` for each beam.

    Returns
    -------
    sums, crossings
        (n,), and how many of the steps from where a scan was taken to where the one before it was run through
        a drawn wall, as in `cross_walls`, (n,).
    """
    beams, levels, classes = scans
    left, bottom, cell, columns, rows = grid
    turned, lengthened = tables
    sums, crossings = np.zeros(states.shape[1]), np.zeros(states.shape[1], np.int64)
    widest = np.int32((values.shape[1] - 1) // 2)
    log_cell = math.log(cell)
    for i in range(states.shape[1]):
        x, y = states[0, i], states[1, i]
        xx, xy, yx, yy = 0.0, 0.0, 0.0, 0.0
        if len(motions) > 1:
            xx, xy, yx, yy = linear_map(states[2, i], states[3, i], states[4, i], states[5, i])
        level_p, level_q = stretch_level(states[4, i]), stretch_level(states[5, i])
        directions, lengths = turned[level_p, level_q], lengthened[level_p, level_q]
        shift = np.int32(round((log_cell - states[3, i]) / LOG_STEP) - LOG_ZERO)
        for k in range(len(motions)):
            later_x, later_y = x, y
            if k > 0:
                x = states[0, i] + xx * motions[k, 0] + xy * motions[k, 1]
                y = states[1, i] + yx * motions[k, 0] + yy * motions[k, 1]
            column, row = math.floor((x - left) / cell), math.floor((y - bottom) / cell)
            if not (0 <= column < columns and 0 <= row < rows):
                sums[i] += weights[k] * (outside * (starts[k + 1] - starts[k]))
                crossings[i] += k > 0
                continue
            ranges = log_ranges[column * rows + row]
            if k > 0:
                crossings[i] += is_beyond_wall(later_x - x, later_y - y, ranges, cell, tolerance)
            heading = math.floor((states[2, i] + motions[k, 2]) / math.tau * HEADINGS + 0.5) % HEADINGS
            total = 0.0
            for place in range(starts[k], starts[k + 1]):
                j = np.uint64(place)  # an unsigned index is not asked whether it counts from the end
                direction = np.uint64(heading + beams[j])
                predicted = np.int32(ranges[np.uint64(directions[direction])]) + shift - lengths[direction]
                if levels[j] == NO_RETURN:
                    if predicted < no_return[0]:
                        total += no_return[1]
                else:
                    error = min(max(predicted - levels[j], -widest), widest)
                    total += values[np.uint64(classes[j]), np.uint64(error + widest)]
            sums[i] += weights[k] * total
    return sums, crossings


@njit(cache=True)
def is_beyond_wall(x: float, y: float, ranges: NDArray[np.uint8], cell: float, tolerance: int) -> bool:
    """Tell whether a step is longer than one of the `ranges` around its start, by more than the tolerance."""
    length = math.hypot(x, y)
    if length == 0.0:
        return False
    direction = round(math.atan2(y, x) / math.tau * len(ranges)) % len(ranges)
    return math.log(length / cell) > (int(ranges[direction]) - LOG_ZERO + tolerance) * LOG_STEP


@njit(cache=True)
def cross_walls(
    starts: NDArray[np.float64],
    steps: NDArray[np.float64],
    log_ranges: NDArray[np.uint8],
    grid: tuple[float, float, float, int, int],
    tolerance: int,
) -> NDArray[np.bool_]:
    """Tell which steps (2, n) from which starts (2, n) run through a drawn wall or begin off the grid, (n,).

    A step may be longer than the way to the wall by `tolerance` steps of LOG_STEP.
    """
    left, bottom, cell, columns, rows = grid
    crossing = np.ones(starts.shape[1], np.bool_)
    for i in range(starts.shape[1]):
        column = math.floor((starts[0, i] - left) / cell)
        row = math.floor((starts[1, i] - bottom) / cell)
        if 0 <= column < columns and 0 <= row < rows:
            ranges = log_ranges[column * rows + row]
            crossing[i] = is_beyond_wall(steps[0, i], steps[1, i], ranges, cell, tolerance)
    return crossing
