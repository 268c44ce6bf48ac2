"""Odometry is believed as far as registration found it right, and not at all where no robot moves so."""

import numpy as np
import pytest

from pilotage.geometry import Pose2
from pilotage.perception import Odometry
from pilotage.scan_matching import MotionPrior, OdometryNoise
from pilotage.scan_matching.odometry import reported_motion, update_noise

METER = Pose2(1.0, 0.0, 0.0)


@pytest.mark.parametrize("true_std", [0.1, 0.2, 0.4])
def test_stds_converge_to_those_of_the_robot(true_std):
    rng = np.random.default_rng(0)
    noise, found = OdometryNoise(position=0.001), []
    for _ in range(600):
        noise = noise.adapted(METER, rng.normal(0.0, true_std), 0.0)
        found.append(noise.position_per_meter)

    assert np.median(found[100:]) == pytest.approx(true_std, rel=0.15)


def test_one_gross_error_counts_no_more_than_any_other():
    noise = OdometryNoise()

    assert noise.adapted(METER, 0.5, 0.0) == noise.adapted(METER, 500.0, 0.0)


def test_a_robot_that_stands_still_teaches_nothing():
    noise = OdometryNoise()

    assert noise is noise.adapted(Pose2(0.01, 0.0, 1.0), 1.0, 1.0)


def test_stds_grow_with_the_motion():
    noise = OdometryNoise()
    near, far = noise.stds(Pose2(0.1, 0.0, 0.0)), noise.stds(Pose2(1.0, 0.0, 1.0))

    assert near[0] < far[0]
    assert near[1] < far[1]


def test_along_a_corridor_odometry_is_not_judged():
    """The scan tells nothing about x: an error along it must not count as one of odometry."""
    noise = OdometryNoise()
    prior = MotionPrior.of(METER, Pose2.identity(), noise)
    across_only = np.diag([0.0, 100.0, 100.0])
    along = update_noise(noise, prior, np.array([3.0, 0.0, 0.0]), across_only)
    across = update_noise(noise, prior, np.array([1.0, 2.0, 0.0]), across_only)

    assert along.position_per_meter < noise.position_per_meter < across.position_per_meter


@pytest.mark.parametrize(
    ("x", "seconds"),
    [(30.0, 0.5), (100.0, 0.5), (1e9, 0.5), (1e300, 0.5), (-1e308, 0.5), (102.0, 1e9), (6.1, -1.0)],
)
def test_a_motion_that_no_robot_makes_is_refused(x, seconds):
    before = Odometry(10.0, Pose2(1.0, 2.0, 0.5))

    assert reported_motion(before, Odometry(10.0 + seconds, Pose2(x, 2.0, 0.5))) is None


@pytest.mark.parametrize(("x", "seconds"), [(4.0, 0.0), (4.0, -3.0), (30.0, 4.0), (0.0, 1e6)])
def test_a_motion_that_a_robot_may_make_is_used(x, seconds):
    motion = reported_motion(Odometry(0.0, Pose2.identity()), Odometry(seconds, Pose2(x, 0.0, 0.1)))

    assert Pose2(x, 0.0, 0.1) == motion


def test_a_turn_that_no_robot_makes_is_refused():
    before = Odometry(0.0, Pose2.identity())

    assert reported_motion(before, Odometry(0.1, Pose2(0.0, 0.0, 2.0))) is None
    assert reported_motion(before, Odometry(0.5, Pose2(0.0, 0.0, 2.0))) is not None


def test_where_rounding_eats_the_motion_it_is_refused():
    far = Odometry(0.0, Pose2(1e308, 1e308, 2.0))

    assert reported_motion(far, far) is None
