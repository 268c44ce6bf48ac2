"""Register a scan to the local map (Wolter 2001, section 3.3, steps 1 to 3; decision 0006).

register(shapes, local_map, prior) -> Registration
    One scan, as the shapes that `perceive` returned, near the pose that odometry tells.
find_unmatched(shapes, local_map, odom_from_base) -> indices
    Which of them the map does not hold yet, at the pose that was found.
"""

from enum import Enum
from typing import NamedTuple

import numpy as np

from pilotage import kernels
from pilotage.geometry import Array, Pose2, segments_of
from pilotage.scan_matching.by_shape import find_pose_by_shape
from pilotage.scan_matching.local_map import LocalMap, owners_of_segments
from pilotage.scan_matching.odometry import MotionPrior
from pilotage.scan_matching.refine import Fit, find_best_fit, fit_at, take_samples
from pilotage.shape import PartialShape

KNOWN_DISTANCE = 0.1
"""[m] A part of a shape is known if it lies this close to a shape of the map that runs the same way."""

KNOWN_SHARE = 0.95
"""A shape is known if this share of its length is; less is new, and worth entering."""

SAME_WAY = 0.7
"""Cosine: lines less than 45 degrees apart run the same way."""

SAMPLE_STEP = 0.1
"""[m] Distance between the points at which shapes are compared with the map."""


class Method(Enum):
    """How the pose is found."""

    SEGMENTS = "segments"  # samples of the shapes against segments of the map, from many starts
    SHAPES = "shapes"  # the mean of the poses that matches of shapes induce, as in the paper


class Registration(NamedTuple):
    """Where a scan was taken in the frame of the local map, and how well it fits there."""

    odom_from_base: Pose2
    fit: Fit | None  # None if there was nothing to compare, and the pose is that of the prior
    inlier_share: float  # [0..1] share of the length of all shapes that lies on the local map


def register(
    shapes: tuple[PartialShape, ...],
    local_map: LocalMap,
    prior: MotionPrior,
    method: Method = Method.SEGMENTS,
) -> Registration:
    """Find where a scan was taken, from its shapes, the map and what odometry tells (3.3, steps 1 and 3).

    With an empty map, or without shapes, the pose is that of the prior.
    """
    samples = take_samples(shapes)
    if not samples.weights.any() or len(local_map.segments) == 0:
        return Registration(prior.odom_from_base, None, 0.0)
    if method is Method.SHAPES:  # the paper's own pose: sections 3.2 and 3.3, steps 2 and 3
        fit = fit_at(samples, local_map, find_pose_by_shape(shapes, local_map.shapes, prior.odom_from_base))
    else:
        fit = find_best_fit(samples, local_map, prior)  # section 3.3, step 3, by decision 0006
    return Registration(Pose2(*fit.pose.tolist()), fit, fit.inlier_weight / float(samples.weights.sum()))


def find_unmatched(
    shapes: tuple[PartialShape, ...], local_map: LocalMap, odom_from_base: Pose2
) -> tuple[int, ...]:
    """Return the indices of the perceived shapes that shapes of the map do not cover (3.3, step 2)."""
    if not shapes or len(local_map.segments) == 0:
        return tuple(range(len(shapes)))
    known = local_map.segment_field
    segments = segments_of([shape.polyline for shape in shapes])
    points, directions, weights, owners = kernels.segment_sampling.sample_segments(segments, SAMPLE_STEP)
    points, directions = odom_from_base @ points, directions @ odom_from_base.rotation.T
    nearest = kernels.segment_field.find_nearest(points, directions, known, SAME_WAY)
    distances = np.where(
        nearest == kernels.segment_field.NONE, np.inf, _distances(points, known.segments[nearest])
    )
    hit = distances <= KNOWN_DISTANCE
    shape_of_point = owners_of_segments(shapes)[owners]
    whole = np.bincount(shape_of_point, weights, len(shapes))
    covered = np.bincount(shape_of_point[hit], weights[hit], len(shapes))
    is_known = (covered > 0.0) & (covered >= KNOWN_SHARE * whole)
    return tuple(np.flatnonzero(~is_known).tolist())


def _distances(points: Array, segments: Array) -> Array:
    """Return the distance of each point (n, 2) from its segment (n, 4), (n,) [m]."""
    along = segments[:, 2:] - segments[:, :2]
    offsets = points - segments[:, :2]
    squared_lengths = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
    share = np.clip((offsets * along).sum(axis=1) / squared_lengths, 0.0, 1.0)
    gaps = offsets - share[:, None] * along
    distances: Array = np.hypot(gaps[:, 0], gaps[:, 1])
    return distances
