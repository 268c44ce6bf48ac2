"""Register a scan into the perception map (Wolter 2001, sections 3.2 and 3.3; decision 0006).

register(shapes, perception_map, odometry, RegistrationSettings()) -> Registration
    One scan, as the shapes that `perceive` returned. Then `perception_map.merged(registration)`.

A robot that moves calls both for every reading:

    perception_map = PerceptionMap()
    for reading in log:
        shapes = perceive(reading.scan, PerceptionSettings())
        registration = register(shapes, perception_map, reading.odometry, RegistrationSettings())
        perception_map = perception_map.merged(registration)
        registration.last_from_base   # the motion since the last reading
        perception_map.shapes         # the local map of the last 10 m, in `odom`
"""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from pilotage.geometry import Array, Pose2, frozen_array, wrap_angle
from pilotage.localization.overlap import OverlapSettings, find_correspondences
from pilotage.perception import Odometry, OdometryNoise, PerceptionMap, Registration
from pilotage.perception.perception_map import segments_of
from pilotage.shape.partial import PartialShape


@dataclass(frozen=True, slots=True)
class SearchSettings:
    """Where refinement starts: at the best of many poses, each tried with a part of the scan."""

    points: int = 80  # of the scan, at most
    count: int = 8  # poses returned
    turn_step: float = math.radians(3.0)  # [rad] between headings
    stride: int = 2  # cells of the map's field between places
    width: float = 0.3  # [m] at which a point counts half
    reach: float = 3.0  # deviations of odometry within which poses are tried
    max_place: float = 1.6  # [m] never search farther, unless lost
    max_turn: float = math.pi / 2  # [rad] never search farther
    lost_support: float = 0.3  # with less, odometry is taken to be grossly wrong and the search widened
    lost_place: float = 0.2  # [m] then search so far
    lost_place_per_meter: float = (
        2.2  # [m/m] and so much of the motion: a robot may have gone back instead of on
    )
    max_lost_place: float = 5.0  # [m] never search farther: the map ends soon, and odometry may jump by miles
    lost_turn: float = math.radians(60.0)  # [rad]


@dataclass(frozen=True, slots=True)
class RegistrationSettings:
    """How a scan is registered."""

    search: SearchSettings = field(default_factory=SearchSettings)
    overlap: OverlapSettings = field(default_factory=OverlapSettings)
    sample_step: float = 0.1  # [m] between the points that stand for a shape
    widths: tuple[float, ...] = (0.5, 0.35, 0.25, 0.2, 0.15, 0.1, 0.08, 0.06, 0.05, 0.05, 0.05, 0.05)  # [m]
    deviation: float = 0.07  # [m] of one sampled point; neighbors err alike, so it is more than a range's
    min_cosine: float = 0.5  # lines less than 60 degrees apart may be the same
    overhang: float = 0.1  # [m] a point may lie this far past the end of its segment
    tail: float = 4.0  # squared deviations at which odometry loses half its hold
    penalty: float = 0.03  # share of points that outweighs a unit of log(1 + m^2 / tail)
    learning_rate: float = 0.1  # largest relative change of the deviations of odometry a step
    learning_support: float = 0.25  # with less, registration is no judge of odometry


class _Guess(NamedTuple):
    """What odometry says."""

    motion: Pose2  # since the last reading
    odom_from_base: Pose2
    place: float  # [m] standard deviation
    turn: float  # [rad]

    @property
    def pose(self) -> Array:
        """As x, y, theta."""
        return np.array([self.odom_from_base.x, self.odom_from_base.y, self.odom_from_base.theta])

    @property
    def information(self) -> Array:
        """Inverse covariance, (3, 3)."""
        return np.diag([self.place**-2, self.place**-2, self.turn**-2])

    def distance(self, pose: Array) -> float:
        """Return the squared distance of a pose in deviations."""
        dx, dy, dtheta = (pose - self.pose).tolist()
        return float((dx**2 + dy**2) / self.place**2 + wrap_angle(dtheta) ** 2 / self.turn**2)


class _Samples(NamedTuple):
    """Points along the shapes of a scan, in the base frame."""

    points: Array  # (n, 2)
    directions: Array  # (n, 2)
    weights: Array  # (n,)


class _Fit(NamedTuple):
    """A refined pose."""

    pose: Array  # (3,) x, y, theta
    hessian: Array  # (3, 3)
    support: float  # sum of weights of the points that lie on known shapes
    error: float  # weighted sum of their squared distances [m^2]


def register(
    shapes: tuple[PartialShape, ...],
    perception_map: PerceptionMap,
    odometry: Odometry,
    settings: RegistrationSettings,
) -> Registration:
    """Find where a scan was taken, from its shapes, the map and the motion that odometry reports.

    With an empty map, or shapes that match nothing, the motion is that of odometry.
    """
    from pilotage.kernels.segment_sampling import sample_segments

    guess = _predict(perception_map, odometry)
    samples = _Samples(*sample_segments(segments_of(shapes), settings.sample_step)[:3])
    if len(samples.points) == 0 or len(perception_map.segments) == 0:
        return _unregistered(shapes, perception_map, odometry, guess)
    fit = _best_fit(samples, perception_map, guess, settings)
    odom_from_base = Pose2(*fit.pose.tolist())
    correspondences = find_correspondences(shapes, perception_map, odom_from_base, settings.overlap)
    matched = {correspondence.seen for correspondence in correspondences}
    information = fit.hessian / settings.deviation**2 + guess.information
    support = fit.support / float(samples.weights.sum())
    return Registration(
        odometry,
        odom_from_base,
        perception_map.odom_from_base.inverse() @ odom_from_base,
        shapes,
        correspondences,
        unmatched=tuple(index for index in range(len(shapes)) if index not in matched),
        support=support,
        residual=math.sqrt(fit.error / fit.support) if fit.support > 0.0 else 0.0,
        covariance=frozen_array(np.linalg.inv(information)),
        noise=_learn(perception_map.noise, guess, fit, settings)
        if support >= settings.learning_support
        else perception_map.noise,
    )


def _predict(perception_map: PerceptionMap, odometry: Odometry) -> _Guess:
    """Carry the last pose on by what odometry reports since."""
    before = perception_map.odometry
    motion = before.odom_from_base.inverse() @ odometry.odom_from_base if before else Pose2.identity()
    return _Guess(motion, perception_map.odom_from_base @ motion, *perception_map.noise.deviations(motion))


def _unregistered(
    shapes: tuple[PartialShape, ...], perception_map: PerceptionMap, odometry: Odometry, guess: _Guess
) -> Registration:
    """Believe odometry alone."""
    return Registration(
        odometry,
        guess.odom_from_base,
        guess.motion,
        shapes,
        correspondences=(),
        unmatched=tuple(range(len(shapes))),
        support=0.0,
        residual=0.0,
        covariance=frozen_array(np.linalg.inv(guess.information)),
        noise=perception_map.noise,
    )


def _best_fit(
    samples: _Samples, perception_map: PerceptionMap, guess: _Guess, settings: RegistrationSettings
) -> _Fit:
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
        window = (search.lost_place + search.lost_place_per_meter * distance, search.lost_turn)
        starts = _search(samples, perception_map, guess, window, settings)
        fits += _refine(samples, perception_map, guess, starts, settings)

    def quality(fit: _Fit) -> float:
        surprise = math.log1p(guess.distance(fit.pose) / settings.tail)
        return fit.support / total - settings.penalty * surprise

    return max(fits, key=quality)


def _search(
    samples: _Samples,
    perception_map: PerceptionMap,
    guess: _Guess,
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
    samples: _Samples,
    perception_map: PerceptionMap,
    guess: _Guess,
    starts: Array,
    settings: RegistrationSettings,
) -> list[_Fit]:
    """Refine each start, point to segment."""
    from pilotage.kernels.point_to_segment import refine_pose

    return [
        _Fit(
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


def _learn(noise: OdometryNoise, guess: _Guess, fit: _Fit, settings: RegistrationSettings) -> OdometryNoise:
    """Judge odometry where the scan does: across the walls, that is, and not along a corridor."""
    hessian = fit.hessian
    across = hessian[:2, :2] - np.outer(hessian[:2, 2], hessian[:2, 2]) / max(
        hessian[2, 2], np.finfo(float).tiny
    )
    best_seen = np.linalg.eigh(across)[1][:, 1]
    place_error = float(best_seen @ (fit.pose - guess.pose)[:2])
    turn_error = wrap_angle(float(fit.pose[2] - guess.pose[2]))
    return noise.learned(guess.motion, place_error, turn_error, settings.learning_rate)
