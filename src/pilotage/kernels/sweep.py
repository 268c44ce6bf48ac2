"""Ranges from many places in all directions at once: each segment is swept over the directions it spans.

Directions are compared by their pseudo-angle, the way along the unit diamond |x| + |y| = 1. It rises with the
angle and needs no trigonometry: -1 at -90 degrees, 0 at 0, 1 at 90, 2 at 180, and 3 where it begins again.
"""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit

BINS = 1024
"""Bins of pseudo-angles, in which the first direction is looked up."""


@njit(cache=True)
def pseudo_angle(x: float, y: float) -> float:
    """Return the pseudo-angle of a direction; 0 for none."""
    share = y / (abs(x) + abs(y) + 1e-300)
    return share if x >= 0.0 else 2.0 - share


@njit(cache=True)
def order_directions(directions: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """List cosine, sine and pseudo-angle of the directions from -90 degrees on, (3, directions), rising.

    The second is the first direction in or after each bin, (BINS + 1,), counted from -90 degrees.
    """
    ordered = np.empty((3, directions))
    begin = -(directions // 4)
    for m in range(directions):
        k = begin + m if 2 * (begin + m) <= directions else begin + m - directions
        angle = k * math.tau / directions
        ordered[0, m], ordered[1, m] = math.cos(angle), math.sin(angle)
        ordered[2, m] = pseudo_angle(ordered[0, m], ordered[1, m])
    first_in = np.empty(BINS + 1, np.int64)
    m = 0
    for bin_ in range(BINS + 1):
        while m < directions and ordered[2, m] < bin_ * 4.0 / BINS - 1.0:
            m += 1
        first_in[bin_] = m
    return ordered, first_in


@njit(cache=True)
def list_vertices(segments: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """List the ends of segments (n, 4), (2, m), and which are those of each, (n, 2).

    A segment that begins where the one before it ends shares that vertex.
    """
    vertices, ends = np.empty((2, 2 * len(segments))), np.empty((len(segments), 2), np.int64)
    count = 0
    for j in range(len(segments)):
        x, y = segments[j, 0], segments[j, 1]
        if count == 0 or vertices[0, count - 1] != x or vertices[1, count - 1] != y:
            vertices[0, count], vertices[1, count] = x, y
            count += 1
        vertices[0, count], vertices[1, count] = segments[j, 2], segments[j, 3]
        ends[j, 0], ends[j, 1] = count - 1, count
        count += 1
    return vertices[:, :count], ends


@njit(cache=True)
def sweep(
    places: NDArray[np.float64], segments: NDArray[np.float64], directions: int, farthest: float
) -> NDArray[np.float32]:
    """Measure from each place (n, 2) to the nearest segment in evenly spaced directions, (n, directions).

    Direction k points at 2 pi k / directions from the x axis. Segments are rows x1, y1, x2, y2, (m, 4).
    Where there is none within `farthest`, that is the range.
    """
    ordered, first_in = order_directions(directions)
    cosines, sines, angles = ordered[0], ordered[1], ordered[2]
    begin = directions - directions // 4  # the direction at -90 degrees, or the first after it
    vertices, ends = list_vertices(segments)
    count = vertices.shape[1]
    xs, ys, turns, nexts = np.empty(count), np.empty(count), np.empty(count), np.empty(count, np.int64)
    nearest = np.empty(directions, np.float32)
    ranges = np.empty((len(places), directions), np.float32)
    for i in range(len(places)):
        for v in range(count):  # has no branch: the processor takes several at once
            xs[v], ys[v] = vertices[0, v] - places[i, 0], vertices[1, v] - places[i, 1]
            turns[v] = pseudo_angle(xs[v], ys[v])
        for v in range(count):
            m = first_in[int((turns[v] + 1.0) * (BINS / 4.0))]
            while m < directions and angles[m] < turns[v]:
                m += 1
            nexts[v] = m
        nearest[:] = np.float32(farthest)
        for j in range(len(segments)):
            first, last = ends[j, 0], ends[j, 1]
            span = turns[last] - turns[first]
            if -2.0 <= span < 0.0 or span > 2.0:
                first, last = last, first  # counter-clockwise, a segment spans no more than half a turn
            start, stop, is_past_the_end = nexts[first], nexts[last], turns[last] < turns[first]
            if stop < directions and angles[stop] == turns[last]:
                stop += 1
            if stop <= start and not is_past_the_end:
                continue  # it lies between two directions
            # all points of the segment's line have the same product with its normal
            normal_x, normal_y = ys[first] - ys[last], xs[last] - xs[first]
            offset = normal_x * xs[first] + normal_y * ys[first]
            for m in range(start, directions if is_past_the_end else stop):
                nearest[m] = nearer(nearest[m], offset, normal_x * cosines[m] + normal_y * sines[m])
            for m in range(stop if is_past_the_end else 0):
                nearest[m] = nearer(nearest[m], offset, normal_x * cosines[m] + normal_y * sines[m])
        for m in range(directions):
            k = begin + m
            ranges[i, k - directions if k >= directions else k] = nearest[m]
    return ranges


@njit(cache=True)
def nearer(nearest: float, offset: float, along: float) -> np.float32:
    """Return the range to a line at this offset, if it is the nearer one; `along` is the ray's part of it."""
    reach = np.float32(offset / along) if along != 0.0 else np.float32(math.inf)
    return reach if 0.0 <= reach < nearest else np.float32(nearest)
