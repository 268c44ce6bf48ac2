"""Order-keeping correspondence of arcs (Latecki and Lakämper 2000; Wolter 2001, section 3)."""

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.any_start import any_start_dissimilarity
from pilotage.kernels.compiling import njit
from pilotage.kernels.segment_correspondence import combined_dissimilarity
from pilotage.kernels.steps import ArcSteps, Steps
from pilotage.kernels.tangent import ROUNDING, arc_dissimilarity

EQUATION_2, COMBINED = 0, 1  # the measures of two stretches


@njit(cache=True)
def stretch_dissimilarity(
    c: Steps,
    c_first: int,
    c_last: int,
    d: Steps,
    d_first: int,
    d_last: int,
    measure: int,
    largest_run: int,
) -> float:
    """Compare two stretches by one of the measures."""
    if measure == COMBINED:
        return combined_dissimilarity(c, c_first, c_last, d, d_first, d_last, largest_run)
    return arc_dissimilarity(c, c_first, c_last, d, d_first, d_last)


@njit(cache=True)
def group_sizes(largest: int) -> NDArray[np.int64]:
    """List how many arcs of c may answer to how many of d: 1-1, 1-3, 3-1, 1-5 ... up to `largest`, (g, 2).

    Odd groups begin and end with the same bend, so that convex answers to convex all along.
    """
    sizes = np.ones((largest, 2), dtype=np.int64)
    for g in range(1, largest):
        sizes[g, g % 2] = 2 * ((g + 1) // 2) + 1
    return sizes


@njit(cache=True)
def group_costs(
    c: ArcSteps, d: ArcSteps, sizes: NDArray[np.int64], measure: int, largest_run: int
) -> NDArray[np.float64]:
    """Compare each group of arcs of c, from arc i on, with each of d, from arc j on, (g, k, m).

    What must not answer to each other costs infinity: unlike bends, and groups longer than their contour.
    """
    k, m = len(c.bends), len(d.bends)
    costs = np.full((len(sizes), k, m), np.inf)
    for g in range(len(sizes)):
        c_size, d_size = sizes[g, 0], sizes[g, 1]
        if c_size > k or d_size > m:
            continue
        for i in range(min(k, len(c.arc_starts) - c_size)):
            for j in range(min(m, len(d.arc_starts) - d_size)):
                if c.bends[i] * d.bends[j] >= 0:
                    costs[g, i, j] = stretch_dissimilarity(
                        c.steps,
                        c.arc_starts[i],
                        c.arc_starts[i + c_size],
                        d.steps,
                        d.arc_starts[j],
                        d.arc_starts[j + d_size],
                        measure,
                        largest_run,
                    )
    return costs


@njit(cache=True)
def cheapest_sequence(
    costs: NDArray[np.float64],
    sizes: NDArray[np.int64],
    i0: int,
    j0: int,
    bound: float,
    best: NDArray[np.float64],
) -> float:
    """Sum up the cheapest sequence of groups that uses up all arcs, of c from i0 and of d from j0 on.

    Sums that are not below `bound` are not followed. `best` (k + 1, m + 1) is room to work in.
    """
    k, m = costs.shape[1], costs.shape[2]
    best[:] = np.inf
    best[0, 0] = 0.0
    for i in range(k):
        for j in range(i % 2, m, 2):  # groups are odd on both sides: i + j stays even
            so_far, first_c, first_d = best[i, j], (i0 + i) % k, (j0 + j) % m
            if so_far < bound:
                for g in range(len(sizes)):
                    i1, j1 = i + sizes[g, 0], j + sizes[g, 1]
                    if i1 <= k and j1 <= m:  # section 3: order-keeping correspondence of arcs
                        best[i1, j1] = min(best[i1, j1], so_far + costs[g, first_c, first_d])
    return float(best[k, m])


@njit(cache=True)
def open_dissimilarity(c: ArcSteps, d: ArcSteps, largest_group: int, measure: int, largest_run: int) -> float:
    """Compare two open lines: arcs against arcs in order, or all of one against all of the other."""
    sizes = group_sizes(largest_group)
    costs = group_costs(c, d, sizes, measure, largest_run)
    room = np.empty((len(c.bends) + 1, len(d.bends) + 1))
    n, m = len(c.steps.directions), len(d.steps.directions)
    c_first, d_first = c.arc_starts[0], d.arc_starts[0]
    first = int(np.int64(0))  # a literal 0 has a type of its own
    whole = stretch_dissimilarity(c.steps, c_first, n, d.steps, d_first, m, measure, largest_run)
    return min(whole, cheapest_sequence(costs, sizes, first, first, whole, room))


@njit(cache=True)
def closed_dissimilarity(
    c: ArcSteps, d: ArcSteps, largest_group: int, measure: int, largest_run: int
) -> float:
    """Compare two closed contours: arcs against arcs in cyclic order, or all against all from any vertex.

    A correspondence is found whatever its start, if one of its groups starts where we start. One of any
    `largest_group` arcs in a row starts a group: as many starts of c and all of d are enough.
    """
    sizes = group_sizes(largest_group)
    costs = group_costs(c, d, sizes, measure, largest_run)
    k, m = len(c.bends), len(d.bends)
    room = np.empty((k + 1, m + 1))
    least = whole_dissimilarity(c, d, measure, largest_run)
    for i0 in range(min(largest_group, k)):
        for j0 in range(m):
            if c.bends[i0] * d.bends[j0] >= 0:
                least = min(least, cheapest_sequence(costs, sizes, i0, j0, least, room))
    return least


@njit(cache=True)
def whole_dissimilarity(c: ArcSteps, d: ArcSteps, measure: int, largest_run: int) -> float:
    """Compare all of a closed contour with all of another, each started at any vertex.

    By eq. (2), unless both are single arcs: only then is a correspondence of their segments worth its price.
    """
    n, m = len(c.steps.directions) // 2, len(d.steps.directions) // 2
    single = len(c.bends) == 1 and len(d.bends) == 1
    c_turn = c.steps.directions[n] - c.steps.directions[0]
    d_turn = d.steps.directions[m] - d.steps.directions[0]
    if abs(c_turn - d_turn) < ROUNDING and not (single and measure == COMBINED):
        return any_start_dissimilarity(c.steps, d.steps)
    by = measure if single else EQUATION_2
    least = np.inf
    for p in range(n):
        for q in range(m):
            least = min(least, stretch_dissimilarity(c.steps, p, p + n, d.steps, q, q + m, by, largest_run))
    return least
