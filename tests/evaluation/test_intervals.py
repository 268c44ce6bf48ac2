"""Intervals hold the mean as often as they say."""

import numpy as np
import pytest

from pilotage.evaluation.intervals import bootstrap_interval


def test_the_true_mean_is_held_in_about_95_of_100():
    rng = np.random.default_rng(0)
    held = 0
    for _ in range(60):
        low, high = bootstrap_interval(rng.normal(2.0, 1.0, 60), rng)
        held += low <= 2.0 <= high

    assert held >= 51


def test_equal_values_leave_no_doubt():
    assert (0.5, 0.5) == bootstrap_interval([0.5] * 10, np.random.default_rng(0))


@pytest.mark.parametrize("values", [[], [[1.0]]])
def test_what_has_no_mean_is_refused(values):
    with pytest.raises(ValueError, match="values"):
        bootstrap_interval(values, np.random.default_rng(0))


def test_a_median_is_less_moved_by_what_stands_far_out_than_a_mean():
    values = [1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 9.0] * 5
    _, mean_high = bootstrap_interval(values, np.random.default_rng(0))
    low, high = bootstrap_interval(values, np.random.default_rng(0), np.median)

    assert low <= 1.3 <= high < mean_high
