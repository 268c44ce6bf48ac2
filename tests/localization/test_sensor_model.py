"""The beam model against its definition, computed slowly."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from buildings import coarse, flat, scan_at
from pilotage.geometry import Pose2
from pilotage.kernels.visibility import LOG_STEP
from pilotage.localization import SensorModel, SensorSettings
from pilotage.localization.sensor_model import CLASS_WIDTH, CLASSES, FIRST_CLASS, null_density, thin_scan
from pilotage.maps import build_atlas
from pilotage.perception import LaserScan

SETTINGS = SensorSettings()
MODEL = SensorModel(build_atlas(flat(), coarse(200, 240)), SETTINGS)


def plain_ratio(error, log_range):
    """Add the four parts of the mixture at e = log(predicted / measured), over the null model."""
    s = SETTINGS
    hit = s.z_hit * math.exp(-0.5 * (error / s.sigma_hit) ** 2) / (s.sigma_hit * math.sqrt(2.0 * math.pi))
    if error > 0.0:
        exponential = s.z_short * s.lambda_short * math.exp(-s.lambda_short * error)
    else:
        exponential = s.z_beyond * s.lambda_beyond * math.exp(s.lambda_beyond * error)
    normal = math.exp(-0.5 * ((log_range - 1.0) / 0.85) ** 2) / (0.85 * math.sqrt(2.0 * math.pi))
    null = 0.97 * normal + 0.03 / 8.0
    return math.log((hit + exponential) / null + s.z_rand), hit / (hit + exponential + s.z_rand * null)


@given(st.integers(-400, 400), st.integers(0, CLASSES - 1))
def test_the_tables_hold_the_mixture(step, number):
    middle = (number + FIRST_CLASS + 0.5) * CLASS_WIDTH
    log_ratio, share = plain_ratio(step * LOG_STEP, middle)

    assert math.isclose(log_ratio, MODEL.log_ratios[number, step + 400], abs_tol=1e-4)
    assert math.isclose(share, MODEL.hit_shares[number, step + 400], abs_tol=1e-4)


def test_the_null_model_is_a_density():
    log_ranges = np.linspace(-8.0, 10.0, 20_000)
    normal = null_density(log_ranges) - 0.03 / 8.0

    assert 0.97 == pytest.approx(normal.sum() * (log_ranges[1] - log_ranges[0]), abs=1e-3)


def test_no_reading_costs_more_than_chance():
    assert math.log(SETTINGS.z_rand) - 1e-6 <= MODEL.log_ratios.min()
    assert 0.0 <= MODEL.hit_shares.min() <= MODEL.hit_shares.max() <= 1.0


def states_at(*poses):
    return np.column_stack([[pose.x, pose.y, pose.theta, 0.0, 0.0, 0.0] for pose in poses])


def test_the_true_pose_explains_a_scan_better_than_others_do():
    poses = [Pose2(1.5, 1.5, 0.5), Pose2(1.5, 1.5, 2.5), Pose2(8.5, 5.0, 0.5), Pose2(4.0, 1.5, 0.5)]
    for true in poses:
        scan = thin_scan(scan_at(true))
        ratios = MODEL.log_ratio(states_at(*poses), scan)

        assert true is poses[int(np.argmax(ratios))]
        assert 0.5 < MODEL.fit(states_at(true)[:, 0], scan)


def test_a_state_off_the_drawing_gets_the_least_ratio():
    scan = thin_scan(scan_at(Pose2(1.5, 1.5, 0.5)))
    (ratio,) = MODEL.log_ratio(states_at(Pose2(1e9, 0.0, 0.0)), scan)

    assert math.isclose(ratio, 3.0 * math.log(SETTINGS.z_rand) + 1.0, rel_tol=1e-6)
    assert 0.0 == MODEL.fit(states_at(Pose2(1e9, 0.0, 0.0))[:, 0], scan)


@pytest.mark.parametrize("ranges", [np.full(181, np.nan), np.zeros(181), np.full(181, -np.inf)])
def test_a_scan_without_a_reading_says_nothing(ranges):
    scan = thin_scan(LaserScan(0.0, -1.5, 3.0 / 180, ranges))

    assert 0 == len(scan)
    assert [0.0] == MODEL.log_ratio(states_at(Pose2(1.5, 1.5, 0.5)), scan).tolist()
    assert 0.0 == MODEL.fit(states_at(Pose2(1.5, 1.5, 0.5))[:, 0], scan)


@pytest.mark.parametrize("far", [1e9, 1e300, np.finfo(float).max])
def test_an_impossible_range_counts_as_no_return(far):
    scan = scan_at(Pose2(1.5, 1.5, 0.5))
    ranges = np.array(scan.ranges)
    ranges[::2] = far
    thinned = thin_scan(LaserScan(0.0, scan.angle_min, scan.angle_increment, ranges))

    assert np.isfinite(MODEL.log_ratio(states_at(Pose2(1.5, 1.5, 0.5)), thinned)).all()


@pytest.mark.parametrize(
    ("changes", "rule"),
    [
        ({"z_rand": 0.0}, "z_rand must be > 0"),
        ({"sigma_hit": math.inf}, "sigma_hit must be > 0 and finite"),
        ({"effective_beams": 46.0}, "effective_beams must be in"),
        ({"null_log_ratio": math.nan}, "null_log_ratio must be finite"),
    ],
)
def test_invalid_settings_are_rejected(changes, rule):
    with pytest.raises(ValueError, match=rule):
        SensorSettings(**changes)
