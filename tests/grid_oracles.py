"""Slow, plain versions of what kernels/local_grid.py computes fast."""

import heapq
import itertools
import math

import numpy as np


def clearances(evidence, farthest):
    """Measure from each cell to every occupied one."""
    occupied = np.argwhere(evidence > 0)
    result = np.full(evidence.shape, float(farthest))
    for cell in np.ndindex(evidence.shape):
        for other in occupied:
            result[cell] = min(result[cell], math.dist(cell, other))
    return result


def cheapest_costs(evidence, clearance, start, *, tight, easy, freed, prices):
    """Find the cheapest ways by Dijkstra with a heap; `prices` are of a straight and a diagonal step."""
    straight, diagonal, dearest = prices
    costs, heap = {start: 0}, [(0, start)]
    while heap:
        cost, cell = heapq.heappop(heap)
        if cost > costs[cell]:
            continue
        for step in itertools.product((-1, 0, 1), repeat=2):
            other = cell[0] + step[0], cell[1] + step[1]
            if step == (0, 0) or not all(
                0 <= at < size for at, size in zip(other, evidence.shape, strict=True)
            ):
                continue
            room = float(clearance[other])
            fits = evidence[other] < 0 and room >= tight
            frees = math.dist(other, start) <= freed and evidence[other] <= 0 and room >= clearance[cell]
            if not (fits or frees):
                continue
            narrow = min(max((easy - room) / (easy - tight), 0.0), 1.0)
            price = diagonal if 0 not in step else straight
            further = cost + int(price * (1.0 + (dearest - 1) * narrow**2))
            if further < costs.get(other, math.inf):
                costs[other] = further
                heapq.heappush(heap, (further, other))
    return costs
