"""Find the robot's pose by shape alone, as the paper does (Wolter 2001, sections 3.2 and 3.3, steps 2 and 3).

Each perceived shape is matched with the shapes of the map near it. Each match induces a pose of the robot,
and their mean is taken. This is `Method.SHAPES`, an option: a pose from point to segment is more exact and
faster (decision 0006).
"""

import math

import numpy as np

from pilotage.contours import Matching, PartialMatch, match_partial_near
from pilotage.geometry import Array, Pose2
from pilotage.shape import PartialShape

MATCHING = Matching()

GATE = 0.5
"""[m] Shapes farther apart than this, where odometry puts them, are not compared."""

MAX_VERTICES = 12
"""Longer shapes are not compared either: the time grows with the square of their numbers."""

MAX_COST = -0.045
"""[rad²] a metre of match: the threshold of step 2; the reward for length alone is -0.05."""


def find_pose_by_shape(
    shapes: tuple[PartialShape, ...], known: tuple[PartialShape, ...], odom_from_base: Pose2
) -> Pose2:
    """Average the poses that matches induce, weighted by matched length; without a match, keep the prior."""
    matches = [
        match
        for shape in shapes
        if len(shape.polyline) <= MAX_VERTICES
        for match in _best_match(shape, known, odom_from_base)
    ]
    if not matches:
        return odom_from_base
    lengths = np.array([match.length for match in matches])
    poses = [match.known_from_seen for match in matches]
    x, y, c, s = np.average(  # section 3.3, step 3: the mean of the poses that matches induce
        [(pose.x, pose.y, math.cos(pose.theta), math.sin(pose.theta)) for pose in poses],
        axis=0,
        weights=lengths,
    ).tolist()
    return Pose2(x, y, math.atan2(s, c))


def _best_match(
    shape: PartialShape, known: tuple[PartialShape, ...], odom_from_base: Pose2
) -> tuple[PartialMatch, ...]:
    """Match a shape with each known one near it; return the cheapest match, if there is any (3.3, step 2)."""
    low, high = _bounds(odom_from_base @ shape.polyline.vertices)
    matches: list[PartialMatch] = []
    for other in known:
        other_low, other_high = _bounds(other.polyline.vertices)
        gap = np.maximum(np.maximum(other_low - high, low - other_high), 0.0)
        if len(other.polyline) <= MAX_VERTICES and np.hypot(*gap) <= GATE:
            matches += match_partial_near(shape, other, odom_from_base, MATCHING)[:1]
    matches = [match for match in matches if match.cost <= MAX_COST * match.length]
    return (min(matches, key=lambda match: match.cost),) if matches else ()


def _bounds(points: Array) -> tuple[Array, Array]:
    """Return the lower left and the upper right corner, (2,) each."""
    return points.min(axis=0), points.max(axis=0)
