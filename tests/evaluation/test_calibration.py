import math

import numpy as np
import pytest

from pilotage.evaluation.calibration import area_under_curve, bins_of, calibration, expected_error
from pilotage.evaluation.episodes import Trace


def trace(probability, right, counted=(True,)):
    n = len(probability)
    return Trace(
        np.arange(float(n)),
        np.array(probability, dtype=float),
        np.broadcast_to(right, n).copy(),
        np.broadcast_to(counted, n).copy(),
        np.zeros(n, dtype=bool),
        np.zeros(n),
        np.ones(n),
    )


def rng():
    return np.random.default_rng(0)


def test_probabilities_that_come_true_have_no_error():
    found = calibration([trace([0.75] * 4, [True, True, True, False]), trace([1.0] * 5, True)], rng())

    assert math.isclose(0.0, found.ece, abs_tol=1e-12)
    assert math.isclose((0.75 * 0.0625 + 0.25 * 0.5625) / 2, found.brier)
    assert 2 == found.episodes


def test_each_episode_has_the_same_weight():
    long, short = trace([0.95] * 1000, True), trace([0.95], False)

    found = calibration([long, short], rng())

    assert math.isclose(0.5, found.bins[-1].right)
    assert math.isclose(0.45, found.ece)


def test_rooms_that_are_not_drawn_are_not_counted():
    found = calibration([trace([0.5, 1.0], [False, True], [False, True]), trace([0.5], False, False)], rng())

    assert 1 == found.episodes
    assert 0.0 == found.ece
    with pytest.raises(ValueError, match="a room that the drawing shows"):
        calibration([trace([0.5], False, False)], rng())


def test_area_under_the_curve_is_the_share_of_pairs_in_order():
    values = rng().integers(0, 5, 40) / 5
    right = (rng().random(40) < values).astype(float)
    weight = rng().random(40)

    pairs = [
        (weight[i] * weight[j], (values[i] > values[j]) + (values[i] == values[j]) / 2)
        for i in np.flatnonzero(right)
        for j in np.flatnonzero(1 - right)
    ]

    expected = sum(w * ordered for w, ordered in pairs) / sum(w for w, _ in pairs)
    assert math.isclose(expected, area_under_curve(values, right, weight))
    assert math.isnan(area_under_curve(values, np.ones(40), weight))


def test_bins_hold_all_weight_and_certainty_is_in_the_last():
    bins = bins_of(np.array([0.0, 0.05, 1.0]), np.array([0.0, 1.0, 1.0]), np.ones(3))

    assert [(0.0, 0.1), (0.9, 1.0)] == [(one.low, one.high) for one in bins]
    assert math.isclose(1.0, sum(one.share for one in bins))
    assert math.isclose(2 / 3 * 0.475, expected_error(bins))
