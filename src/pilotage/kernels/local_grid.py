"""A grid of what was seen around the robot: free, occupied, or not seen; and the paths over it.

Evidence is a whole number for each grid cell (i, j), i along x: 0 not seen, below it free, above it
occupied; it fades when beams pass, so that what walked away is gone soon.
"""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit

STEP = 0.5  # [cells] between the points of a beam that are entered: none of its cells is jumped over for long
SHORT = 0.7  # [cells] by which a beam ends before its return: half the diagonal of the cell of that
HIT = 3  # evidence that one return adds
MOST = 4  # evidence of a wall that was seen often: as many scans must pass through to clear it
STRAIGHT, DIAGONAL = 10, 14  # costs of a step at full clearance
DEAREST = 6  # factor on the cost of a step where the robot just fits through
UNREACHED = 2**31 - 1


@njit(cache=True)
def mark(
    evidence: NDArray[np.int8],
    origin: tuple[float, float],
    directions: NDArray[np.float64],
    ranges: NDArray[np.float64],
    returned: NDArray[np.bool_],
) -> None:
    """Enter beams from `origin` along `directions` (n,) [rad] that are free for `ranges` (n,), in cells.

    Where a beam `returned` something stands at its end. What stands there is never cleared by the same scan.
    """
    width, height = evidence.shape
    passed = np.zeros((width, height), np.bool_)
    for k in range(len(ranges)):
        cosine, sine = math.cos(directions[k]), math.sin(directions[k])
        steps = int((ranges[k] - SHORT) / STEP)
        for step in range(max(steps, 0)):
            i = math.floor(origin[0] + STEP * step * cosine)
            j = math.floor(origin[1] + STEP * step * sine)
            if not (0 <= i < width and 0 <= j < height):
                break
            if passed[i, j]:
                continue
            passed[i, j] = True
            if evidence[i, j] > 1:
                evidence[i, j] -= 1
            else:
                evidence[i, j] = -1
    for k in range(len(ranges)):
        if returned[k]:
            i = math.floor(origin[0] + ranges[k] * math.cos(directions[k]))
            j = math.floor(origin[1] + ranges[k] * math.sin(directions[k]))
            if 0 <= i < width and 0 <= j < height:
                evidence[i, j] = min(max(evidence[i, j], 0) + HIT, MOST)


@njit(cache=True)
def clearances(evidence: NDArray[np.int8], farthest: int) -> NDArray[np.float32]:
    """Measure from each cell to the nearest occupied one, in cells, at most `farthest`: exact up to there."""
    width, height = evidence.shape
    along = np.empty((width, height), np.int32)  # to the nearest occupied cell of the same i
    for i in range(width):
        gap = farthest
        for j in range(height):
            gap = 0 if evidence[i, j] > 0 else min(gap + 1, farthest)
            along[i, j] = gap
        gap = farthest
        for j in range(height - 1, -1, -1):
            gap = 0 if evidence[i, j] > 0 else min(gap + 1, farthest)
            along[i, j] = min(along[i, j], gap)
    result = np.full((width, height), farthest, np.float32)
    squared = np.empty(height, np.int32)
    for i in range(width):
        squared[:] = farthest * farthest
        for k in range(max(0, i - farthest + 1), min(width, i + farthest)):
            aside = (k - i) * (k - i)
            for j in range(height):
                squared[j] = min(squared[j], along[k, j] * along[k, j] + aside)
        for j in range(height):
            result[i, j] = math.sqrt(squared[j])
    return result


@njit(cache=True)
def flood(
    evidence: NDArray[np.int8],
    clearance: NDArray[np.float32],
    start: tuple[int, int],
    tight: float,
    easy: float,
    freed: float,
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Find the cheapest paths from `start` to all cells that were seen free: costs, and what is before each.

    A robot fits where the clearance is `tight` cells, and moves at ease where it is `easy`; in between a step
    costs more. Within `freed` cells of the start it may also move to where the clearance grows, to get away
    from a wall that it stands too near to. Costs are in STRAIGHT a cell, UNREACHED if there is no path;
    before (width, height) is i * height + j, -1 at the start. Dijkstra with buckets (Dial 1969).
    """
    width, height = evidence.shape
    costs = np.full((width, height), UNREACHED, np.int32)
    before = np.full((width, height), -1, np.int32)
    buckets = DIAGONAL * DEAREST + 1
    heads = np.full(buckets, -1, np.int32)
    capacity = 8 * width * height + 8
    nexts = np.empty(capacity, np.int32)
    cells = np.empty(capacity, np.int32)
    entered = np.empty(capacity, np.int32)
    count = 1
    costs[start] = 0
    cells[0], entered[0], nexts[0], heads[0] = start[0] * height + start[1], 0, -1, 0
    waiting, cost = 1, 0
    while waiting > 0:
        entry = heads[cost % buckets]
        if entry < 0:
            cost += 1
            continue
        heads[cost % buckets] = nexts[entry]
        waiting -= 1
        i, j = cells[entry] // height, cells[entry] % height
        if costs[i, j] != entered[entry]:
            continue
        for di in range(-1, 2):
            for dj in range(-1, 2):
                a, b = i + di, j + dj
                if (di == 0 and dj == 0) or not (0 <= a < width and 0 <= b < height):
                    continue
                room = clearance[a, b]
                near = (a - start[0]) ** 2 + (b - start[1]) ** 2 <= freed * freed
                escaping = near and evidence[a, b] <= 0 and room >= clearance[i, j]
                if not escaping and (evidence[a, b] >= 0 or room < tight):
                    continue
                share = min(max((easy - room) / (easy - tight), 0.0), 1.0)
                step = DIAGONAL if di != 0 and dj != 0 else STRAIGHT
                further = cost + int(step * (1.0 + (DEAREST - 1) * share * share))
                if further < costs[a, b] and count < capacity:
                    costs[a, b] = further
                    before[a, b] = i * height + j
                    slot = further % buckets
                    cells[count], entered[count], nexts[count] = a * height + b, further, heads[slot]
                    heads[slot] = count
                    count += 1
                    waiting += 1
    return costs, before
