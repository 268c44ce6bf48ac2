"""What odometry is worth is learnt from what registration finds."""

import math

import numpy as np
import pytest

from pilotage.geometry import Pose2
from pilotage.scan_matching import OdometryNoise

METER = Pose2(1.0, 0.0, 0.0)


@pytest.mark.parametrize("true_deviation", [0.1, 0.2, 0.4])
def test_deviations_converge_to_those_of_the_robot(true_deviation):
    rng = np.random.default_rng(0)
    noise, found = OdometryNoise(place=0.001), []
    for _ in range(600):
        noise = noise.learned(METER, rng.normal(0.0, true_deviation), 0.0, 0.1)
        found.append(noise.place_per_meter)

    assert np.median(found[100:]) == pytest.approx(true_deviation, rel=0.15)


def test_one_gross_error_counts_no_more_than_any_other():
    noise = OdometryNoise()

    assert noise.learned(METER, 0.5, 0.0, 0.1) == noise.learned(METER, 500.0, 0.0, 0.1)


def test_a_robot_that_stands_still_teaches_nothing():
    noise = OdometryNoise()

    assert noise is noise.learned(Pose2(0.01, 0.0, 1.0), 1.0, 1.0, 0.1)


def test_deviations_grow_with_the_motion():
    noise = OdometryNoise()
    near, far = noise.deviations(Pose2(0.1, 0.0, 0.0)), noise.deviations(Pose2(1.0, 0.0, 1.0))

    assert near[0] < far[0]
    assert near[1] < far[1]


@pytest.mark.parametrize("wrong", [{"place": 0.0}, {"turn": math.nan}, {"turn_per_meter": -1.0}])
def test_noise_that_cannot_be_meant_is_refused(wrong):
    with pytest.raises(ValueError, match="must be"):
        OdometryNoise(**wrong)
