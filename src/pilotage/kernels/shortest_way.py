"""The shortest way of a disc between segments: Dijkstra 1959 over a grid of points, then pulled taut."""

import heapq
import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit
from pilotage.kernels.contact import share_before_grid
from pilotage.kernels.segment_grid import SegmentGrid

HALF = np.array([(1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2)])
STEPS = np.concatenate((HALF, -HALF))
"""To which points of the grid a step leads: lengths along these are at most 2.8 % too long."""

LONGEST_STEP = math.sqrt(5.0)
"""[grid steps]"""


@njit(cache=True)
def find_way(
    is_free: NDArray[np.bool_], sources: NDArray[np.float64], targets: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Find the shortest way over free points of a grid (columns, rows), from a source to a target.

    What it costs to begin at a point and to end there stands in `sources` and `targets` (columns, rows), in
    grid steps; inf where that is impossible.

    Returns
    -------
    way
        Column * rows + row of each point on the way, (n,), from the target to the source; (0,) if none.
    """
    columns, rows = is_free.shape
    costs = np.full(columns * rows + 1, np.inf)  # the last is the end itself, beyond any target
    before = np.full(columns * rows + 1, -1)
    end = columns * rows
    waiting = [(0.0, -1)]
    waiting.pop()
    for column in range(columns):
        for row in range(rows):
            if is_free[column, row] and sources[column, row] < np.inf:
                costs[column * rows + row] = sources[column, row]
                waiting.append((sources[column, row], column * rows + row))
    heapq.heapify(waiting)
    while len(waiting) > 0:
        cost, place = heapq.heappop(waiting)
        if place == end:
            break
        if cost > costs[place]:
            continue
        column, row = place // rows, place % rows
        if cost + targets[column, row] < costs[end]:
            costs[end], before[end] = cost + targets[column, row], place
            heapq.heappush(waiting, (costs[end], end))
        for k in range(len(STEPS)):
            to_column, to_row = column + STEPS[k, 0], row + STEPS[k, 1]
            if 0 <= to_column < columns and 0 <= to_row < rows and is_free[to_column, to_row]:
                there = to_column * rows + to_row
                further = cost + math.hypot(STEPS[k, 0], STEPS[k, 1])
                if further < costs[there]:
                    costs[there], before[there] = further, place
                    heapq.heappush(waiting, (further, there))
    way = np.empty(columns * rows, np.int64)
    count, place = 0, before[end]
    while place >= 0:
        way[count] = place
        count, place = count + 1, before[place]
    return way[:count]


@njit(cache=True)
def pull_taut(points: NDArray[np.float64], radius: float, grid: SegmentGrid) -> NDArray[np.int64]:
    """Choose which points (n, 2) of a way a disc needs so that it can go straight from one to the next, (m,).

    Of all choices it is the shortest; from each point of the way to the next one the disc can go.
    """
    n = len(points)
    costs, before = np.full(n, np.inf), np.full(n, -1)
    costs[0] = 0.0
    for i in range(n):
        for j in range(n - 1, i, -1):
            x, y = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1]
            cost = costs[i] + math.hypot(x, y)
            if cost < costs[j] and (
                j == i + 1 or share_before_grid(points[i, 0], points[i, 1], x, y, radius, grid) == 1.0
            ):
                costs[j], before[j] = cost, i
    chosen = np.empty(n, np.int64)
    count, place = 0, n - 1
    while place >= 0:
        chosen[count] = place
        count, place = count + 1, before[place]
    return chosen[:count][::-1]
