"""Beams against segments and discs: how far each beam goes before it meets one."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit
from pilotage.kernels.segment_grid import SegmentGrid


@njit(cache=True)
def distance_along(x: float, y: float, beam_x: float, beam_y: float, segment: NDArray[np.float64]) -> float:
    """Measure from (x, y) along a beam to a segment (4,), its ends included; inf if they do not meet."""
    start_x, start_y = segment[0] - x, segment[1] - y
    along_x, along_y = segment[2] - segment[0], segment[3] - segment[1]
    # origin + distance * beam = start + share * along, solved by Cramer's rule
    determinant = beam_x * along_y - beam_y * along_x
    if determinant == 0.0:
        return np.inf
    distance = (start_x * along_y - start_y * along_x) / determinant
    share = (start_x * beam_y - start_y * beam_x) / determinant
    return distance if distance >= 0.0 and 0.0 <= share <= 1.0 else np.inf


@njit(cache=True)
def first_met(
    origins: NDArray[np.float64], directions: NDArray[np.float64], segments: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Tell how far the nearest segment is from each origin (n, 2) along its direction (n,) [rad], and which.

    Returns ranges and row numbers, both (n,). Segments are rows x1, y1, x2, y2, (m, 4), their ends included.
    A beam that meets none goes on to inf, and its number is -1; one that runs along a segment passes it.
    """
    ranges = np.full(len(directions), np.inf)
    numbers = np.full(len(directions), -1)
    for i in range(len(directions)):
        beam_x, beam_y = math.cos(directions[i]), math.sin(directions[i])
        for j in range(len(segments)):
            distance = distance_along(origins[i, 0], origins[i, 1], beam_x, beam_y, segments[j])
            if distance < ranges[i]:
                ranges[i], numbers[i] = distance, j
    return ranges, numbers


@njit(cache=True)
def cast(
    origins: NDArray[np.float64], directions: NDArray[np.float64], segments: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Measure how far `first_met` goes from each origin, (n,)."""
    return first_met(origins, directions, segments)[0]


@njit(cache=True)
def cast_through(
    origins: NDArray[np.float64], directions: NDArray[np.float64], grid: SegmentGrid
) -> NDArray[np.float64]:
    """Measure what `cast` does, looking only at segments in the cells that a beam goes through."""
    ranges = np.full(len(directions), np.inf)
    right, top = grid.left + grid.columns * grid.cell, grid.bottom + grid.rows * grid.cell
    for i in range(len(directions)):
        x, y = origins[i, 0], origins[i, 1]
        beam_x, beam_y = math.cos(directions[i]), math.sin(directions[i])
        enter, leave = 0.0, np.inf  # where the beam is over the grid
        for place, beam, low, high in ((x, beam_x, grid.left, right), (y, beam_y, grid.bottom, top)):
            if beam != 0.0:
                one, other = (low - place) / beam, (high - place) / beam
                enter, leave = max(enter, min(one, other)), min(leave, max(one, other))
            elif not low <= place <= high:
                leave = -np.inf
        if enter > leave:
            continue
        column = math.floor((x + enter * beam_x - grid.left) / grid.cell)
        row = math.floor((y + enter * beam_y - grid.bottom) / grid.cell)
        column, row = min(max(column, 0), grid.columns - 1), min(max(row, 0), grid.rows - 1)
        step_x, step_y = (1 if beam_x > 0.0 else -1), (1 if beam_y > 0.0 else -1)
        while 0 <= column < grid.columns and 0 <= row < grid.rows:
            k = column * grid.rows + row
            for member in range(grid.starts[k], grid.starts[k + 1]):
                distance = distance_along(x, y, beam_x, beam_y, grid.segments[grid.members[member]])
                ranges[i] = min(ranges[i], distance)
            # computed from each border again, so that errors do not add up
            border_x = grid.left + (column + (step_x > 0)) * grid.cell
            border_y = grid.bottom + (row + (step_y > 0)) * grid.cell
            leave_x = (border_x - x) / beam_x if beam_x != 0.0 else np.inf
            leave_y = (border_y - y) / beam_y if beam_y != 0.0 else np.inf
            if ranges[i] <= min(leave_x, leave_y):
                break
            if leave_x < leave_y:
                column += step_x
            else:
                row += step_y
    return ranges


@njit(cache=True)
def cast_on_panes(
    origins: NDArray[np.float64],
    directions: NDArray[np.float64],
    panes: NDArray[np.float64],
    steepest: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Measure what `cast` does, but a beam passes panes that it meets too far off their normal.

    `steepest` (n,) says for each beam what is too far [rad], from 0 (it passes nearly all) to a right angle.
    """
    ranges = np.full(len(directions), np.inf)
    for i in range(len(directions)):
        beam_x, beam_y = math.cos(directions[i]), math.sin(directions[i])
        for j in range(len(panes)):
            along_x, along_y = panes[j, 2] - panes[j, 0], panes[j, 3] - panes[j, 1]
            across = abs(beam_x * along_y - beam_y * along_x)
            if across >= math.cos(steepest[i]) * math.hypot(along_x, along_y):
                distance = distance_along(origins[i, 0], origins[i, 1], beam_x, beam_y, panes[j])
                ranges[i] = min(ranges[i], distance)
    return ranges


@njit(cache=True)
def cast_on_discs(
    origins: NDArray[np.float64], directions: NDArray[np.float64], discs: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Measure from each origin (n, 2) along its direction (n,) [rad] to the nearest disc, (n,); inf if none.

    Discs are rows x, y, radius, (m, 3). One that holds the origin is not seen.
    """
    ranges = np.full(len(directions), np.inf)
    for i in range(len(directions)):
        beam_x, beam_y = math.cos(directions[i]), math.sin(directions[i])
        for j in range(len(discs)):
            x, y = discs[j, 0] - origins[i, 0], discs[j, 1] - origins[i, 1]
            ahead, across = x * beam_x + y * beam_y, x * beam_y - y * beam_x
            if ahead > 0.0 and abs(across) <= discs[j, 2]:
                distance = ahead - math.sqrt(discs[j, 2] ** 2 - across**2)
                if distance >= 0.0:
                    ranges[i] = min(ranges[i], distance)
    return ranges
