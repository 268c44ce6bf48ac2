"""Contact of a rectangular robot with walls, doors and people."""

import math

import numpy as np

from pilotage.geometry import Array, Pose2

HALVINGS = 8
"""Times that a motion is halved to find where contact begins: from 8 cm to a third of a millimetre."""


MARGIN = 0.05
"""Distance [m] beyond the reach of a motion up to which segments are tried: rounding leaves none out."""


def touches(world_from_base: Pose2, size: tuple[float, float], segments: Array, discs: Array) -> bool:
    """Tell whether a rectangle of this length and width [m] meets segments (m, 4) or discs (k, 3)."""
    half = np.array(size) / 2.0
    base_from_world = world_from_base.inverse()
    ends = (base_from_world @ segments.reshape(-1, 2)).reshape(-1, 2, 2)
    if meets_box(ends[:, 0], ends[:, 1], half).any():
        return True
    middles = base_from_world @ discs[:, :2]
    away = np.maximum(np.abs(middles) - half, 0.0)
    return bool((np.hypot(away[:, 0], away[:, 1]) < discs[:, 2]).any())


def meets_box(first: Array, last: Array, half: Array) -> Array:
    """Tell which segments from (m, 2) to (m, 2) meet a box about the origin, (m,) (slab method)."""
    step = last - first
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (-half - first) / step, (half - first) / step
    still = step == 0.0
    between = np.abs(first) < half
    enter = np.where(still, np.where(between, -np.inf, np.inf), np.minimum(one, other))
    leave = np.where(still, np.where(between, np.inf, -np.inf), np.maximum(one, other))
    return np.asarray(np.maximum(enter.max(axis=1), 0.0) < np.minimum(leave.min(axis=1), 1.0))


def share_before_contact(
    world_from_base: Pose2, move: Pose2, size: tuple[float, float], segments: Array, discs: Array
) -> float:
    """Return what share of a small motion in the robot's frame it can make before it touches anything."""
    reach = math.hypot(move.x, move.y) + math.hypot(*size) / 2.0 + MARGIN
    near = segments[segment_distances(segments, world_from_base.position) < reach]
    if not touches(world_from_base @ move, size, near, discs):
        return 1.0
    free, taken = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = (free + taken) / 2.0
        part = Pose2(middle * move.x, middle * move.y, middle * move.theta)
        if touches(world_from_base @ part, size, near, discs):
            taken = middle
        else:
            free = middle
    return free


def segment_distances(segments: Array, point: Array) -> Array:
    """Measure from a point (2,) to segments (m, 4), (m,)."""
    first, step = segments[:, :2], segments[:, 2:] - segments[:, :2]
    square = np.maximum((step**2).sum(axis=1), 1e-18)
    share = np.clip(((point - first) * step).sum(axis=1) / square, 0.0, 1.0)
    gaps = first + share[:, np.newaxis] * step - point
    return np.asarray(np.hypot(gaps[:, 0], gaps[:, 1]))
