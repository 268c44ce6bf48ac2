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
