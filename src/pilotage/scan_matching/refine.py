"""Fit the points of a scan to the segments of the map: search for starts, refine each, keep the best."""

import math
from typing import NamedTuple

import numpy as np

from pilotage.geometry import Array, Pose2
from pilotage.scan_matching.local_map import PerceptionMap, segments_of
from pilotage.scan_matching.motion_prior import Guess
from pilotage.scan_matching.odometry_noise import OdometryNoise
from pilotage.scan_matching.settings import RegistrationSettings
from pilotage.shape.partial import PartialShape


class Samples(NamedTuple):
    """Points along the shapes of a scan, in the base frame."""

    points: Array  # (n, 2)
    directions: Array  # (n, 2)
    weights: Array  # (n,)


def take_samples(shapes: tuple[PartialShape, ...], settings: RegistrationSettings) -> Samples:
    """Place points along shapes in the base frame, near which the laser sits.

    A wall seen at a grazing angle shows few returns on much length, and where it lies along the line of sight
    is doubtful: it weighs by the sine of the angle, up to the angle from which all weigh by their length.
    """
    from pilotage.kernels.segment_sampling import sample_segments

    points, directions, weights, _ = sample_segments(segments_of(shapes), settings.sample_step)
    ranges = np.maximum(np.hypot(points[:, 0], points[:, 1]), np.finfo(float).tiny)
    sines = np.abs(points[:, 0] * directions[:, 1] - points[:, 1] * directions[:, 0]) / ranges
    return Samples(points, directions, weights * np.minimum(sines / math.sin(settings.full_incidence), 1.0))


class Fit(NamedTuple):
    """A refined pose."""

    pose: Array  # (3,) x, y, theta
    hessian: Array  # (3, 3)
    support: float  # sum of weights of the points that lie on known shapes
    error: float  # weighted sum of their squared distances [m^2]


def find_best_fit(
    samples: Samples, perception_map: PerceptionMap, guess: Guess, settings: RegistrationSettings
) -> Fit:
    """Refine the guess and the poses found round it; take the one best supported, and least against odometry.

    If none is well supported, search as far as the robot can have gone.
    """
    total = float(samples.weights.sum())
    search = settings.search
    window = (
        min(search.reach * guess.place, search.max_place),
        min(search.reach * guess.turn, search.max_turn),
    )
    starts = _search(samples, perception_map, guess, window, settings)
    fits = _refine(samples, perception_map, guess, np.vstack([guess.pose, starts]), settings)
    if max(fit.support for fit in fits) < search.lost_support * total:
        distance = math.hypot(guess.motion.x, guess.motion.y)
        place, turn = OdometryNoise().deviations(guess.motion)
        guess = guess._replace(place=max(place, guess.place), turn=max(turn, guess.turn))
        far = search.lost_place + search.lost_place_per_meter * distance
        window = (min(far, search.lost_max_place), search.lost_turn)
        starts = _search(samples, perception_map, guess, window, settings)
        fits += _refine(samples, perception_map, guess, starts, settings)

    def quality(fit: Fit) -> float:
        surprise = math.log1p(guess.distance(fit.pose) / settings.tail)
        return fit.support / total - settings.penalty * surprise

    return max(fits, key=quality)


def fit_at(
    samples: Samples, perception_map: PerceptionMap, pose: Pose2, settings: RegistrationSettings
) -> Fit:
    """Tell how well a pose found otherwise fits."""
    from pilotage.kernels.point_to_segment import linearize

    at = np.array([pose.x, pose.y, pose.theta])
    hessian, _, support, error = linearize(
        *samples,
        perception_map.segment_field,
        at,
        settings.widths[-1],
        settings.min_cosine,
        settings.overhang,
    )
    return Fit(at, hessian, support, error)


def _search(
    samples: Samples,
    perception_map: PerceptionMap,
    guess: Guess,
    window: tuple[float, float],
    settings: RegistrationSettings,
) -> Array:
    """Find poses from which refinement may start, (n, 3)."""
    from pilotage.kernels.pose_search import search_poses

    search = settings.search
    every = max(1, len(samples.points) // search.points)
    chosen = slice(every // 2, None, every)
    points, directions, weights = (np.ascontiguousarray(values[chosen]) for values in samples)
    poses: Array = search_poses(
        points,
        directions,
        weights,
        perception_map.segment_field,
        guess.pose,
        np.array([guess.place, guess.turn]),
        np.array(window),
        search.turn_step,
        search.stride,
        search.width,
        settings.min_cosine,
        settings.penalty,
        settings.tail,
        search.count,
    )
    return poses


def _refine(
    samples: Samples,
    perception_map: PerceptionMap,
    guess: Guess,
    starts: Array,
    settings: RegistrationSettings,
) -> list[Fit]:
    """Refine each start, point to segment."""
    from pilotage.kernels.point_to_segment import refine_pose

    return [
        Fit(
            *refine_pose(
                *samples,
                perception_map.segment_field,
                start,
                guess.pose,
                guess.information * settings.deviation**2,
                settings.tail * settings.deviation**2,
                np.array(settings.widths),
                settings.min_cosine,
                settings.overhang,
            )
        )
        for start in starts
    ]
