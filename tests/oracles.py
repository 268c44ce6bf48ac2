"""Slow, plain truths that the kernels are held against. They follow the text, not the code."""

import cmath
import math
from functools import cache
from itertools import pairwise

import numpy as np
from shapely.geometry import LineString, Point, Polygon


def relevance(a, b, c):
    """Eq. (1) with the turn as its angle, by complex numbers."""
    s1, s2 = complex(*b) - complex(*a), complex(*c) - complex(*b)
    if s1 == 0 or s2 == 0:
        return 0.0
    turn = abs(math.atan2((s2 * s1.conjugate()).imag, (s2 * s1.conjugate()).real))
    return turn * abs(s1) * abs(s2) / (abs(s1) + abs(s2))


def evolve_runs(runs, closed, min_relevance):
    """Look at all vertices again before each deletion. Runs are lists of points; returns the lists left."""
    runs = [[tuple(point) for point in run] for run in runs]
    while True:
        candidates = []
        for k, run in enumerate(runs):
            if closed[k] and len(run) <= 3:
                continue
            for i in range(len(run)) if closed[k] else range(1, len(run) - 1):
                a, b, c = run[i - 1], run[i], run[(i + 1) % len(run)]
                others = [point for run in runs for point in run]
                others.remove(b)
                if relevance(a, b, c) < min_relevance and not _is_in_the_way(a, b, c, others):
                    candidates.append((relevance(a, b, c), k, i))
        if not candidates:
            return runs
        _, k, i = min(candidates)
        del runs[k][i]


def _is_in_the_way(a, b, c, others):
    if LineString([a, c]).distance(Point(b)) == 0.0:
        return False
    triangle = Polygon([a, b, c])
    return any(triangle.intersects(Point(point)) for point in others if point not in (a, c))


def tangent_function(vertices):
    """Lengths and unwrapped directions of the segments that have a length."""
    steps = [complex(*b) - complex(*a) for a, b in pairwise(vertices) if tuple(a) != tuple(b)]
    directions = [cmath.phase(steps[0])]
    for before, after in pairwise(steps):
        directions.append(directions[-1] + cmath.phase(after / before))
    return [abs(step) for step in steps], directions


def differences_of_directions(c, d, samples=20000):
    """T(c)(s) - T(d)(s) in the middle of so many equal parts of [0, 1]; c and d are (lengths, directions)."""
    s = (np.arange(samples) + 0.5) / samples
    values = []
    for lengths, directions in (c, d):
        stops = np.cumsum(lengths) / sum(lengths)
        values.append(np.array(directions)[np.searchsorted(stops, s).clip(max=len(directions) - 1)])
    return values[0] - values[1]


def arc_dissimilarity(c, d):
    """Eq. (2), the integral by sampling and the rotation by calculus."""
    lc, ld = sum(c[0]), sum(d[0])
    return differences_of_directions(c, d).var() * max(lc, ld) * max(lc / ld, ld / lc)


def segment_dissimilarity(c, d, rotation, largest_run):
    """Try all order-keeping correspondences, one segment to one or many."""
    runs = [(1, 1)] + [run for k in range(2, largest_run + 1) for run in ((k, 1), (1, k))]

    @cache
    def rest(i, j):
        if (i, j) == (len(c[0]), len(d[0])):
            return 0.0
        fitting = [(k, m) for k, m in runs if i + k <= len(c[0]) and j + m <= len(d[0])]
        return min((pair(i, j, k, m) + rest(i + k, j + m) for k, m in fitting), default=math.inf)

    def pair(i, j, k, m):
        lengths_c, lengths_d = c[0][i : i + k], d[0][j : j + m]
        lc, ld = sum(lengths_c), sum(lengths_d)
        weights = np.outer(lengths_c, lengths_d) / (lc * ld)  # one of both is a single segment
        differences = np.subtract.outer(c[1][i : i + k], d[1][j : j + m]) - rotation
        return (weights * differences**2).sum() * max(lc, ld) * max(lc / ld, ld / lc)

    return rest(0, 0)


def cheapest_match(seen, known, pose, prices):  # noqa: C901 (one closure over one problem)
    """Try every match of parts of two chains at a pose: each start, each way on, each end, cut or not.

    `seen` and `known` are (vertices, first_goes_on, last_goes_on), `prices` (alpha, lambda, largest run).
    """
    (s, s_first, s_last), (k, k_first, k_last) = seen, known
    alpha, reward, largest_run = prices
    theta = pose[2]
    moved = [complex(pose[0], pose[1]) + complex(*point) * cmath.rect(1.0, theta) for point in s]
    fixed = [complex(*point) for point in k]
    n, m = len(s) - 1, len(k) - 1

    def apart(i, j):
        return abs(moved[i] - fixed[j]) ** 2

    def square(i, j):
        return cmath.phase((fixed[j + 1] - fixed[j]) / (moved[i + 1] - moved[i])) ** 2

    def length(vertices, first, last):
        return sum(math.dist(a, b) for a, b in pairwise(vertices[first : last + 1]))

    def price(mean_square, ls, lk, distance):
        return mean_square * max(ls, lk) * max(ls / lk, lk / ls) + min(ls, lk) * (alpha * distance - reward)

    def whole(i, j, i1, j1):
        """Cost of a step from vertices i, j to i1, j1: one segment against a run."""
        ls, lk = length(s, i, i1), length(k, j, j1)
        squares = [
            (length(s, p, p + 1) * length(k, q, q + 1), square(p, q))
            for p in range(i, i1)
            for q in range(j, j1)
        ]
        mean = sum(weight * value for weight, value in squares) / sum(weight for weight, _ in squares)
        return price(mean, ls, lk, (apart(i, j) + apart(i1, j1)) / 2)

    def cut(i, j, distance):
        shorter = min(length(s, i, i + 1), length(k, j, j + 1))
        return price(square(i, j), shorter, shorter, distance)

    def may_cut(i, j, *, at_seen_end, at_known_end):
        ls, lk = length(s, i, i + 1), length(k, j, j + 1)
        return (at_seen_end and ls <= lk) or (at_known_end and lk <= ls)

    def costs_from(i, j):
        """Costs of all ways to go on from vertices i, j, with stopping there among them."""
        yield 0.0
        for di, dj in {
            (1, 1),
            *((r, 1) for r in range(1, largest_run + 1)),
            *((1, r) for r in range(1, largest_run + 1)),
        }:
            if i + di <= n and j + dj <= m:
                first = whole(i, j, i + di, j + dj)
                yield from (first + rest for rest in costs_from(i + di, j + dj))
        if i < n and j < m:
            at_ends = {"at_seen_end": i == n - 1 and s_last, "at_known_end": j == m - 1 and k_last}
            if may_cut(i, j, **at_ends):
                yield cut(i, j, apart(i, j))

    best = 0.0
    for i in range(n + 1):
        for j in range(m + 1):
            best = min(best, *costs_from(i, j))
            if i < n and j < m:
                at_ends = {"at_seen_end": i == 0 and s_first, "at_known_end": j == 0 and k_first}
                if may_cut(i, j, **at_ends):
                    first = cut(i, j, apart(i + 1, j + 1))
                    best = min(best, *(first + rest for rest in costs_from(i + 1, j + 1)))
    return best


def cheapest_sequence(costs, sizes, i0, j0):
    """Try all sequences of groups that use up the arcs of both sides, from i0 and j0 on."""
    _, k, m = costs.shape

    @cache
    def rest(i, j):
        if (i, j) == (k, m):
            return 0.0
        following = [
            costs[g, (i0 + i) % k, (j0 + j) % m] + rest(i + size[0], j + size[1])
            for g, size in enumerate(sizes.tolist())
            if i + size[0] <= k and j + size[1] <= m
        ]
        return min(following, default=math.inf)

    return rest(0, 0)
