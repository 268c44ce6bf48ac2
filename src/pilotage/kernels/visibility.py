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
    scan: tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]],
    log_ranges: NDArray[np.uint8],
    grid: tuple[float, float, float, int, int],
    tables: tuple[NDArray[np.int16], NDArray[np.int16]],
    values: NDArray[np.float32],
    no_return: tuple[int, float],
    outside: float,
) -> NDArray[np.float64]:
    """Sum over beams a value of the measured and the predicted range, for each particle, (n,).

    `scan` holds, each (m,): directions in the robot's frame, 0 .. HEADINGS - 1 steps; measured ranges as log
    metres in steps of LOG_STEP, or NO_RETURN; and classes of ranges. `log_ranges` (columns * rows,
    directions) is the drawing's range table on the grid (left, bottom, cell size, columns, rows).
    `values` (classes, 2 k + 1) is indexed by the class and by k + log(predicted / measured) in steps of
    LOG_STEP. A beam that did not return counts `no_return[1]` where a wall is predicted nearer than level
    `no_return[0]`, else 0. A particle off the grid gets `outside` for each beam.
    """
    beams, levels, classes = scan
    left, bottom, cell, columns, rows = grid
    turned, lengthened = tables
    sums = np.empty(states.shape[1])
    widest = np.int32((values.shape[1] - 1) // 2)
    log_cell = math.log(cell)
    for i in range(states.shape[1]):
        column = math.floor((states[0, i] - left) / cell)
        row = math.floor((states[1, i] - bottom) / cell)
        if not (0 <= column < columns and 0 <= row < rows):
            sums[i] = outside * len(beams)
            continue
        ranges = log_ranges[column * rows + row]
        level_p, level_q = stretch_level(states[4, i]), stretch_level(states[5, i])
        directions, lengths = turned[level_p, level_q], lengthened[level_p, level_q]
        heading = math.floor(states[2, i] / math.tau * HEADINGS + 0.5) % HEADINGS
        shift = np.int32(round((log_cell - states[3, i]) / LOG_STEP) - LOG_ZERO)
        total = np.float32(0.0)
        for j in range(len(beams)):
            direction = heading + beams[j]
            predicted = np.int32(ranges[directions[direction]]) + shift - np.int32(lengths[direction])
            if levels[j] == NO_RETURN:
                if predicted < no_return[0]:
                    total += no_return[1]
            else:
                total += values[classes[j], min(max(predicted - levels[j], -widest), widest) + widest]
        sums[i] = total
    return sums


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
    crossing = np.zeros(starts.shape[1], np.bool_)
    directions = log_ranges.shape[1]
    for i in range(starts.shape[1]):
        column = math.floor((starts[0, i] - left) / cell)
        row = math.floor((starts[1, i] - bottom) / cell)
        length = math.hypot(steps[0, i], steps[1, i])
        if not (0 <= column < columns and 0 <= row < rows):
            crossing[i] = True
        elif length > 0.0:
            direction = round(math.atan2(steps[1, i], steps[0, i]) / math.tau * directions) % directions
            way = int(log_ranges[column * rows + row, direction]) - LOG_ZERO + tolerance
            crossing[i] = math.log(length / cell) > way * LOG_STEP
    return crossing
