"""Outlines of SVG shapes as vertices: curves cut into chords."""

import math
from collections.abc import Iterator

import numpy as np
from svgelements import Arc, Close, CubicBezier, Move, Path, PathSegment, Point, QuadraticBezier

from pilotage.geometry import Array, Polyline

GRAIN = 1e-6
"""Points closer than this share of the tolerance are one point: the rounding of a transform parts them."""


def flatten(path: Path, tolerance: float) -> Iterator[Polyline]:
    """Turn each subpath into a polyline that strays from it by no more than the tolerance.

    Subpaths without length are left out; one that ends where it began is closed.
    """
    points: list[Array] = []
    for segment in path:
        if isinstance(segment, Close):
            yield from joined(points, tolerance * GRAIN, closed=True)
            points = [position(segment.end)]
        elif isinstance(segment, Move):
            yield from joined(points, tolerance * GRAIN, closed=False)
            points = [position(segment.end)]
        else:
            points.append(chords(segment, tolerance))
    yield from joined(points, tolerance * GRAIN, closed=False)


def position(point: Point) -> Array:
    """Return one point as (1, 2)."""
    return np.array([tuple(point)], dtype=np.float64)


def joined(parts: list[Array], grain: float, *, closed: bool) -> Iterator[Polyline]:
    """Join parts, each (n, 2), into one polyline; none if no two points are farther apart than the grain."""
    if not parts:
        return
    vertices = np.vstack(parts)
    steps = np.abs(np.diff(vertices, axis=0)).max(axis=1)
    vertices = vertices[np.concatenate([[True], steps > grain])]
    if len(vertices) > 2 and np.abs(vertices[0] - vertices[-1]).max() <= grain:
        vertices, closed = vertices[:-1], True
    if len(vertices) >= 2:
        yield Polyline(vertices, closed and len(vertices) > 2)


def chords(segment: PathSegment, tolerance: float) -> Array:
    """Cut one segment into chords: the end of each, (k, 2)."""
    count = chord_count(segment, tolerance)
    if count == 1:
        return position(segment.end)
    inner = segment.npoint(np.arange(1, count) / count)
    return np.vstack([inner, position(segment.end)])


def chord_count(segment: PathSegment, tolerance: float) -> int:
    """Count the equal steps that keep every chord within the tolerance.

    A Bezier curve of degree d strays from a chord by at most d (d - 1) / 8 of the largest second
    difference of its control points over the square of the count; an arc by the sagitta of its wider radius.
    """
    if isinstance(segment, QuadraticBezier | CubicBezier):
        control = np.array([tuple(point) for point in segment])
        bends = np.diff(control, n=2, axis=0)
        degree = len(control) - 1
        bend = float(np.hypot(bends[:, 0], bends[:, 1]).max())
        return max(1, math.ceil(math.sqrt(degree * (degree - 1) / 8.0 * bend / tolerance)))
    if isinstance(segment, Arc):
        radius = float(max(segment.rx, segment.ry))
        if radius <= tolerance:
            return 1
        return max(1, math.ceil(abs(float(segment.sweep)) / (2.0 * math.acos(1.0 - tolerance / radius))))
    return 1
