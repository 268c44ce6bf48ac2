"""Find the robot's pose by shape alone, as the paper does (Wolter 2001, sections 3.2 and 3.3, steps 2 and 3).

Each perceived shape is matched with the known shapes near it. Each match induces a pose of the robot, and the
mean of these is taken. Kept for comparison: a pose from point to segment is more exact (decision 0006).
"""

import math
from dataclasses import dataclass, field

import numpy as np

from pilotage.contours import Matching, PartialMatch, match_partial_near
from pilotage.geometry import Array, Pose2
from pilotage.shape import PartialShape


@dataclass(frozen=True, slots=True)
class ShapeSettings:
    """Which matches tell the pose."""

    matching: Matching = field(default_factory=Matching)
    gate: float = 0.5  # [m] shapes farther apart than this, where odometry puts them, are not compared
    max_vertices: int = 12  # nor are longer ones: the time grows with the square of their numbers
    max_cost: float = -0.045  # [rad²] a meter of match: the threshold of step 2; the reward alone is -0.05


def find_pose_by_shape(
    shapes: tuple[PartialShape, ...],
    known: tuple[PartialShape, ...],
    odom_from_base: Pose2,
    settings: ShapeSettings,
) -> Pose2:
    """Average the poses that matches induce, by the length they match; without a match, believe the guess."""
    matches = [
        match
        for shape in shapes
        if len(shape.polyline) <= settings.max_vertices
        for match in _best_match(shape, known, odom_from_base, settings)
    ]
    if not matches:
        return odom_from_base
    lengths = np.array([match.length for match in matches])
    poses = [match.known_from_seen for match in matches]
    x, y, c, s = np.average(
        [(pose.x, pose.y, math.cos(pose.theta), math.sin(pose.theta)) for pose in poses],
        axis=0,
        weights=lengths,
    ).tolist()
    return Pose2(x, y, math.atan2(s, c))


def _best_match(
    shape: PartialShape, known: tuple[PartialShape, ...], odom_from_base: Pose2, settings: ShapeSettings
) -> tuple[PartialMatch, ...]:
    """Match a shape with each known one near it; return the cheapest, if there is any."""
    low, high = _bounds(odom_from_base @ shape.polyline.vertices)
    matches: list[PartialMatch] = []
    for other in known:
        other_low, other_high = _bounds(other.polyline.vertices)
        gap = np.maximum(np.maximum(other_low - high, low - other_high), 0.0)
        if len(other.polyline) <= settings.max_vertices and np.hypot(*gap) <= settings.gate:
            matches += match_partial_near(shape, other, odom_from_base, settings.matching)[:1]
    matches = [match for match in matches if match.cost <= settings.max_cost * match.length]
    return (min(matches, key=lambda match: match.cost),) if matches else ()


def _bounds(points: Array) -> tuple[Array, Array]:
    """Return the lower left and the upper right corner, (2,) each."""
    return points.min(axis=0), points.max(axis=0)
