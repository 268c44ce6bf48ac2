"""Discrete curve evolution (Latecki and Lakämper 1998; Wolter 2001, section 2.2), topology kept.

Plain Python that the compiler accepts as it stands: import `evolve_runs` from here where a command must start
quickly, and from `evolution_compiled` where it must run quickly. The result is the same.
"""

import heapq
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

NONE = -1  # no such vertex
NO_ENTRY = -1.0  # the heap holds no valid entry of this vertex


class Grid(NamedTuple):
    """Vertices sorted by the cells of a square grid, about one a cell."""

    side: int  # cells a row
    column: NDArray[np.int64]  # of each vertex, (n,)
    row: NDArray[np.int64]  # of each vertex, (n,)
    by_cell: NDArray[np.int64]  # vertices in order of cells, row by row, (n,)
    starts: NDArray[np.int64]  # where each cell starts in `by_cell`, and n at the end, (side * side + 1,)


def relevance(xy: NDArray[np.float64], a: int, b: int, c: int) -> float:
    """Tell how much vertex b, between a and c, contributes to the shape, eq. (1) [rad times unit of `xy`].

    The angle is the turn at b: a straight run has none and is irrelevant. So is a repeated vertex.
    """
    ab_x, ab_y = xy[b, 0] - xy[a, 0], xy[b, 1] - xy[a, 1]
    bc_x, bc_y = xy[c, 0] - xy[b, 0], xy[c, 1] - xy[b, 1]
    l1, l2 = math.hypot(ab_x, ab_y), math.hypot(bc_x, bc_y)
    if l1 + l2 == 0.0:
        return 0.0
    beta = abs(math.atan2(ab_x * bc_y - ab_y * bc_x, ab_x * bc_x + ab_y * bc_y))
    return beta * l1 * l2 / (l1 + l2)  # eq. (1)


def is_between(xy: NDArray[np.float64], a: int, b: int, c: int) -> bool:
    """Tell whether b lies exactly on the segment from a to c."""
    ab_x, ab_y = xy[b, 0] - xy[a, 0], xy[b, 1] - xy[a, 1]
    bc_x, bc_y = xy[c, 0] - xy[b, 0], xy[c, 1] - xy[b, 1]
    return bool(ab_x * bc_y == ab_y * bc_x and ab_x * bc_x + ab_y * bc_y >= 0.0)


def is_in_triangle(xy: NDArray[np.float64], p: int, a: int, b: int, c: int) -> bool:
    """Tell whether p lies in the triangle a, b, c or on its border, the corners a and c excepted."""
    x, y = xy[p, 0], xy[p, 1]
    ax, ay, bx, by, cx, cy = xy[a, 0], xy[a, 1], xy[b, 0], xy[b, 1], xy[c, 0], xy[c, 1]
    if x < min(ax, bx, cx) or x > max(ax, bx, cx) or y < min(ay, by, cy) or y > max(ay, by, cy):
        return False
    if (x == ax and y == ay) or (x == cx and y == cy):
        return False
    side_ab = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
    side_bc = (cx - bx) * (y - by) - (cy - by) * (x - bx)
    side_ca = (ax - cx) * (y - cy) - (ay - cy) * (x - cx)
    return not min(side_ab, side_bc, side_ca) < 0.0 < max(side_ab, side_bc, side_ca)


def sort_into_grid(xy: NDArray[np.float64]) -> Grid:
    """Sort vertices (n, 2) into a square grid of n cells over their bounds."""
    n = len(xy)
    side = max(1, int(math.sqrt(n)))
    left, bottom, right, top = xy[0, 0], xy[0, 1], xy[0, 0], xy[0, 1]
    for p in range(1, n):
        left, right = min(left, xy[p, 0]), max(right, xy[p, 0])
        bottom, top = min(bottom, xy[p, 1]), max(top, xy[p, 1])
    extent = max(right - left, top - bottom)
    cells_a_unit = side / extent if extent > 0.0 else 0.0
    column, row, by_cell = np.empty(n, np.int64), np.empty(n, np.int64), np.empty(n, np.int64)
    starts = np.zeros(side * side + 1, np.int64)
    for p in range(n):
        column[p] = min(int((xy[p, 0] - left) * cells_a_unit), side - 1)
        row[p] = min(int((xy[p, 1] - bottom) * cells_a_unit), side - 1)
        starts[row[p] * side + column[p]] += 1
    for k in range(side * side):
        starts[k + 1] += starts[k]  # where each cell ends
    for p in range(n - 1, -1, -1):
        k = row[p] * side + column[p]
        starts[k] -= 1
        by_cell[starts[k]] = p
    return Grid(side, column, row, by_cell, starts)


def find_in_triangle(
    xy: NDArray[np.float64], keep: NDArray[np.bool_], grid: Grid, corners: tuple[int, int, int]
) -> int:
    """Find a kept vertex that lies in the triangle of three others, or NONE."""
    a, b, c = corners
    left = min(grid.column[a], grid.column[b], grid.column[c])
    right = max(grid.column[a], grid.column[b], grid.column[c])
    bottom, top = min(grid.row[a], grid.row[b], grid.row[c]), max(grid.row[a], grid.row[b], grid.row[c])
    for row in range(bottom, top + 1):
        first, last = grid.starts[row * grid.side + left], grid.starts[row * grid.side + right + 1]
        for p in grid.by_cell[first:last]:
            if keep[p] and p != b and is_in_triangle(xy, p, a, b, c):
                return int(p)
    return NONE


def link_vertices(
    starts: NDArray[np.int64], closed: NDArray[np.bool_]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Find the vertex before and after each, NONE at open ends, and the run that it is in, (n,) each."""
    n = starts[-1]
    previous, following, run_of = np.arange(-1, n - 1), np.arange(1, n + 1), np.zeros(n, dtype=np.int64)
    for run in range(len(closed)):
        first, last = starts[run], starts[run + 1] - 1
        if first <= last:
            run_of[first : last + 1] = run
            previous[first] = last if closed[run] else NONE
            following[last] = first if closed[run] else NONE
    return previous, following, run_of


def evolve_runs(
    xy: NDArray[np.float64],
    starts: NDArray[np.int64],
    closed: NDArray[np.bool_],
    min_relevance: float,
) -> NDArray[np.bool_]:
    """Delete the least relevant vertex of all runs, again and again, while it is below `min_relevance`.

    Parameters
    ----------
    xy
        Vertices of all runs, one after the other, (n, 2).
    starts
        Where each run starts in `xy`, and n at the end, (k + 1,).
    closed
        Which runs join their last vertex to their first, (k,). They keep three vertices at least; the ends of
        the others always stay.
    min_relevance
        [rad times the unit of `xy`]

    Returns
    -------
    keep
        Which vertices stay, (n,).

    Notes
    -----
    To go straight from a to c makes lines cross that did not before only if a vertex lies in the triangle
    a, b, c. Then b waits until that vertex is gone or its own neighbors have changed. Lines that cross from
    the start are no hindrance. What lies exactly between its neighbors may always go.

    A heap with lazy deletion holds the candidates, a grid finds the vertices in a triangle: O(n log n) on
    outlines as they come.
    """
    n = len(xy)
    keep = np.ones(n, dtype=np.bool_)
    if n == 0:
        return keep
    previous, following, run_of = link_vertices(starts, closed)
    left = starts[1:] - starts[:-1]  # vertices that each run has left
    grid = sort_into_grid(xy)
    blocker = np.full(n, NONE)  # the vertex that this one waits for
    has_waiting = np.zeros(n, dtype=np.bool_)  # whether another waits for this one
    entry = np.full(n, NO_ENTRY)  # priority of the one valid heap entry of each vertex
    heap = [(0.0, NONE) for _ in range(0)]  # so written, the compiler knows what the list will hold
    for b in range(n):
        a, c = previous[b], following[b]
        if NONE not in (a, c):
            entry[b] = relevance(xy, a, b, c)
            if entry[b] < min_relevance:
                heap.append((entry[b], b))
    heapq.heapify(heap)

    while len(heap) > 0:
        priority, b = heapq.heappop(heap)
        if not keep[b] or priority != entry[b]:
            continue
        entry[b] = NO_ENTRY
        if closed[run_of[b]] and left[run_of[b]] <= 3:
            continue
        a, c = previous[b], following[b]
        if not is_between(xy, a, b, c):
            blocker[b] = find_in_triangle(xy, keep, grid, (a, b, c))
            if blocker[b] != NONE:
                has_waiting[blocker[b]] = True
                continue

        keep[b] = False
        left[run_of[b]] -= 1
        following[a], previous[c] = c, a
        freed = np.flatnonzero(blocker == b) if has_waiting[b] else blocker[:0]
        for v in [a, c, *freed]:
            u, w = previous[v], following[v]
            if keep[v] and NONE not in (u, w):
                blocker[v] = NONE
                entry[v] = relevance(xy, u, v, w)
                if entry[v] < min_relevance:
                    heapq.heappush(heap, (entry[v], v))
    return keep
