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

import numpy as np

from pilotage.geometry import Pose2, frozen_array
from pilotage.perception import Odometry
from pilotage.scan_matching.by_shape import find_pose_by_shape
from pilotage.scan_matching.local_map import PerceptionMap
from pilotage.scan_matching.motion_prior import Guess, learn, predict
from pilotage.scan_matching.overlap import find_correspondences
from pilotage.scan_matching.refine import find_best_fit, fit_at, take_samples
from pilotage.scan_matching.registration import Registration
from pilotage.scan_matching.settings import Method, RegistrationSettings
from pilotage.shape.partial import PartialShape

__all__ = ["Method", "RegistrationSettings", "register"]


def register(
    shapes: tuple[PartialShape, ...],
    perception_map: PerceptionMap,
    odometry: Odometry,
    settings: RegistrationSettings,
) -> Registration:
    """Find where a scan was taken, from its shapes, the map and the motion that odometry reports.

    With an empty map, or shapes that match nothing, the motion is that of odometry.
    """
    guess = predict(perception_map, odometry)
    samples = take_samples(shapes, settings)
    if not samples.weights.any() or len(perception_map.segments) == 0:
        return _unregistered(shapes, perception_map, odometry, guess)
    if settings.method is Method.SHAPES:
        pose = find_pose_by_shape(shapes, perception_map.shapes, guess.odom_from_base, settings.shape)
        fit = fit_at(samples, perception_map, pose, settings)
    else:
        fit = find_best_fit(samples, perception_map, guess, settings)
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
        noise=learn(perception_map.noise, guess, fit.pose, fit.hessian, settings)
        if support >= settings.learning_support
        else perception_map.noise,
    )


def _unregistered(
    shapes: tuple[PartialShape, ...], perception_map: PerceptionMap, odometry: Odometry, guess: Guess
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
