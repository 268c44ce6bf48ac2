"""Fit the points of a scan to the segments of the local map: search for starts, refine each, keep the best.

This is how step 3 of section 3.3 corrects the pose: point to segment instead of by shape (decision 0006).
"""

import math
from typing import NamedTuple

import numpy as np

from pilotage import kernels
from pilotage.geometry import Array, Pose2, segments_of
from pilotage.kernels.samples import Samples, Trials
from pilotage.scan_matching.local_map import LocalMap
from pilotage.scan_matching.odometry import MotionPrior, OdometryNoise
from pilotage.shape import PartialShape

SAMPLE_STEP = 0.05
"""[m] Distance between the points that stand for a shape."""

FULL_INCIDENCE = math.radians(25.0)
"""[rad] Walls seen at a smaller angle than this weigh less: few returns on much length."""

KERNEL_SCALES = np.array([0.5, 0.35, 0.25, 0.2, 0.15, 0.1, 0.08, 0.06, 0.05, 0.05, 0.05, 0.05])
"""[m] Scale of the robust kernel (Geman and McClure) in each step: it starts wide and ends at 5 cm."""

SIGMA = 0.14
"""[m] Standard deviation of one sampled point. Neighbors err alike, so it is more than that of a range."""

MIN_COSINE = 0.5
"""Lines less than 60 degrees apart may be the same."""

OVERHANG = 0.1
"""[m] A point may lie this far past the end of its segment."""

ROBUST_SCALE = 4.0
"""Squared Mahalanobis distance at which the prior loses half its hold: odometry is right or grossly wrong."""

PRIOR_WEIGHT = 0.03
"""Share of inliers that outweighs one unit of log(1 + squared distance / ROBUST_SCALE)."""

SEARCH_POINTS = 80
"""Number of points of the scan with which each pose is tried, about."""

TRIALS = Trials(
    turn_step=math.radians(2.0),
    stride=2,  # 20 cm
    scale=0.3,
    min_cosine=MIN_COSINE,
    prior_weight=PRIOR_WEIGHT,
    robust_scale=ROBUST_SCALE,
    kept=10,
)
"""Poses that are tried; refinement starts from the best."""

SEARCH_STDS = 3.0
"""Poses are tried within this many standard deviations of the prior ..."""

SEARCH_LIMITS = 1.6, math.pi / 2
"""[m, rad] ... but not farther than this from its mean."""

LOST_INLIERS = 0.3
"""With a smaller share of inliers, odometry is taken to be grossly wrong, and the search is widened:"""

LOST_DISTANCE = 0.2
"""[m] to this ..."""

LOST_DISTANCE_PER_METER = 2.2
"""[m/m] ... and this times the reported motion, as a robot may have gone back instead of on ..."""

LOST_LIMITS = 3.0, math.radians(60.0)
"""[m, rad] ... but not farther than this."""


class Fit(NamedTuple):
    """A refined pose."""

    pose: Array  # (3,) x, y, theta
    hessian: Array  # (3, 3)
    inlier_weight: float  # sum of weights of the points that lie on shapes of the map


def take_samples(shapes: tuple[PartialShape, ...]) -> Samples:
    """Place points along shapes in the base frame, near which the laser sits.

    A wall seen at a grazing angle shows few returns on much length, and where it lies along the line of sight
    is doubtful. So points weigh by the sine of the angle of incidence, up to `FULL_INCIDENCE`.
    """
    segments = segments_of([shape.polyline for shape in shapes])
    points, directions, weights, _ = kernels.segment_sampling.sample_segments(segments, SAMPLE_STEP)
    ranges = np.maximum(np.hypot(points[:, 0], points[:, 1]), np.finfo(float).tiny)
    sines = np.abs(points[:, 0] * directions[:, 1] - points[:, 1] * directions[:, 0]) / ranges
    return Samples(points, directions, weights * np.minimum(sines / math.sin(FULL_INCIDENCE), 1.0))


def find_best_fit(samples: Samples, local_map: LocalMap, prior: MotionPrior) -> Fit:
    """Refine the prior's pose and those found around it; take the one with most inliers, near odometry.

    If none has enough inliers, search as far as the robot can have gone.
    """
    total = float(samples.weights.sum())
    window = (
        min(SEARCH_STDS * prior.position_std, SEARCH_LIMITS[0]),
        min(SEARCH_STDS * prior.heading_std, SEARCH_LIMITS[1]),
    )
    starts = _search(samples, local_map, prior, window)
    fits = _refine(samples, local_map, prior, np.vstack([prior.pose, starts]))
    if max(fit.inlier_weight for fit in fits) < LOST_INLIERS * total:
        prior = _widened(prior)
        distance = LOST_DISTANCE + LOST_DISTANCE_PER_METER * math.hypot(prior.motion.x, prior.motion.y)
        distance = max(distance, SEARCH_STDS * prior.position_std)
        starts = _search(samples, local_map, prior, (min(distance, LOST_LIMITS[0]), LOST_LIMITS[1]))
        fits += _refine(samples, local_map, prior, starts)

    def quality(fit: Fit) -> float:
        surprise = math.log1p(prior.squared_distance(fit.pose) / ROBUST_SCALE)
        return fit.inlier_weight / total - PRIOR_WEIGHT * surprise

    return max(fits, key=quality)


def fit_at(samples: Samples, local_map: LocalMap, pose: Pose2) -> Fit:
    """Tell how well a pose that was found otherwise fits."""
    at = np.array([pose.x, pose.y, pose.theta])
    hessian, _, inlier_weight = kernels.point_to_segment.linearize(
        samples, local_map.segment_field, at, KERNEL_SCALES[-1], MIN_COSINE, OVERHANG
    )
    return Fit(at, hessian, inlier_weight)


def _widened(prior: MotionPrior) -> MotionPrior:
    """Trust odometry no more than that of a bad robot."""
    position, heading = OdometryNoise().stds(prior.motion)
    return prior._replace(
        position_std=max(position, prior.position_std), heading_std=max(heading, prior.heading_std)
    )


def _search(samples: Samples, local_map: LocalMap, prior: MotionPrior, window: tuple[float, float]) -> Array:
    """Find poses from which refinement may start, (n, 3)."""
    every = max(1, len(samples.points) // SEARCH_POINTS)
    chosen = slice(every // 2, None, every)
    poses: Array = kernels.pose_search.search_poses(
        Samples(*(np.ascontiguousarray(values[chosen]) for values in samples)),
        local_map.segment_field,
        prior.pose,
        np.array([prior.position_std, prior.heading_std]),
        np.array(window),
        TRIALS,
    )
    return poses


def _refine(samples: Samples, local_map: LocalMap, prior: MotionPrior, starts: Array) -> list[Fit]:
    """Refine each start, point to segment."""
    mean, information = prior.pose, prior.information * SIGMA**2
    return [
        Fit(
            *kernels.point_to_segment.refine_pose(
                samples,
                local_map.segment_field,
                start,
                mean,
                information,
                ROBUST_SCALE * SIGMA**2,
                KERNEL_SCALES,
                MIN_COSINE,
                OVERHANG,
            )
        )
        for start in starts
    ]
