"""Slow, plain truths that the kernels are held against. They follow the text, not the code."""

import math

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
