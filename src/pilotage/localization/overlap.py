"""Which perceived shapes lie on which known ones, once the pose is known."""

import math

import numpy as np

from pilotage.geometry import Array, Pose2
from pilotage.perception import Correspondence, PerceptionMap
from pilotage.perception.perception_map import segment_owners, segments_of
from pilotage.shape.partial import PartialShape


def find_correspondences(
    shapes: tuple[PartialShape, ...],
    perception_map: PerceptionMap,
    odom_from_base: Pose2,
    sample_step: float,
) -> tuple[Correspondence, ...]:
    """Pair each perceived shape with the known shape that most of it lies on, if any does.

    A part lies on a known shape that runs its way within the distance at which newer shapes cover older ones.
    """
    from pilotage.kernels.segment_field import NONE, find_nearest
    from pilotage.kernels.segment_sampling import sample_segments

    settings, known = perception_map.settings, perception_map.segment_field
    moved = tuple(shape.moved(odom_from_base) for shape in shapes)
    points, directions, weights, owners = sample_segments(segments_of(moved), sample_step)
    nearest = find_nearest(points, directions, known, settings.min_cosine)
    distance = _distance_from_line(points, known.segments[nearest], known.directions[nearest])
    hit = (nearest != NONE) & (distance <= settings.cover_distance)
    seen = segment_owners(shapes)[owners]
    columns = len(perception_map.shapes)
    pair = seen[hit] * columns + perception_map.shape_of_segment[nearest[hit]]
    pairs, inverse = np.unique(pair, return_inverse=True)
    overlap = np.bincount(inverse, weights[hit], len(pairs)) * sample_step
    squares = np.bincount(inverse, weights[hit] * distance[hit] ** 2, len(pairs)) * sample_step
    best: dict[int, Correspondence] = {}
    for key, length, square in zip(pairs.tolist(), overlap.tolist(), squares.tolist(), strict=True):
        found = Correspondence(key // columns, key % columns, length, math.sqrt(square / length))
        if found.seen not in best or best[found.seen].overlap < length:
            best[found.seen] = found
    return tuple(best[index] for index in sorted(best))


def _distance_from_line(points: Array, segments: Array, directions: Array) -> Array:
    """Return the distance of each point (n, 2) from the line of its segment (n, 4), (n,) [m]."""
    offsets = points - segments[:, :2]
    distance: Array = np.abs(directions[:, 0] * offsets[:, 1] - directions[:, 1] * offsets[:, 0])
    return distance
