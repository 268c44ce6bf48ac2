import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pilotage.localization.belief import Belief, mean_state, similarity_of, stretched
from strategies import coordinates

small = st.floats(-0.7, 0.7)


@given(st.tuples(coordinates, coordinates), st.floats(-7.0, 7.0), small, st.tuples(small, small))
def test_displacements_follow_the_definition(step, heading, log_scale, stretches):
    p, q = stretches
    values, vectors = np.linalg.eigh([[p, q], [q, -p]])
    stretch = vectors @ np.diag(np.exp(values)) @ vectors.T
    turn = np.array([[math.cos(heading), -math.sin(heading)], [math.sin(heading), math.cos(heading)]])
    states = np.array([[0.0], [0.0], [heading], [log_scale], [p], [q]])

    expected = math.exp(log_scale) * stretch @ turn @ step

    np.testing.assert_allclose(expected, stretched(states, *step)[:, 0], atol=1e-9)


def test_a_stretch_keeps_areas():
    states = np.array([[0.0], [0.0], [0.4], [0.0], [0.3], [-0.5]])
    a, b = stretched(states, 1.0, 0.0)[:, 0], stretched(states, 0.0, 1.0)[:, 0]

    assert math.isclose(1.0, a[0] * b[1] - a[1] * b[0], rel_tol=1e-12)


@given(st.lists(st.floats(-5.0, 5.0), min_size=1, max_size=30), st.integers(0, 2**32 - 1))
def test_resampling_draws_each_as_often_as_its_weight_asks_give_or_take_one(log_weights, seed):
    count, n = 1000, len(log_weights)
    belief = Belief(np.tile(np.arange(n, dtype=float), (6, 1)), np.array(log_weights))

    drawn = belief.resampled(count, np.random.default_rng(seed))

    times = np.bincount(drawn.states[0].astype(int), minlength=n)
    assert (np.abs(times - count * belief.weights) <= 1.0 + 1e-9).all()
    assert (drawn.log_weights == 0.0).all()


def test_mixing_gives_the_other_its_share():
    zeros, ones = Belief(np.zeros((6, 100)), np.zeros(100)), Belief(np.ones((6, 7)), np.zeros(7))

    mixed = zeros.mixed(ones, 0.25, len(zeros), np.random.default_rng(0))

    assert 100 == len(mixed)
    assert 25 == mixed.states[0].sum()


def test_headings_are_averaged_on_the_circle():
    states = np.zeros((6, 2))
    states[2] = [math.pi - 0.1, -math.pi + 0.1]

    assert math.isclose(math.pi, abs(mean_state(states, np.ones(2))[2]), abs_tol=1e-9)


def test_a_state_without_stretch_is_a_similarity():
    state = np.array([3.0, 4.0, 0.5, math.log(2.0), 0.0, 0.0])

    moved = similarity_of(state) @ np.array([[1.0, 2.0]])

    np.testing.assert_allclose(moved[0] - state[:2], stretched(state[:, None], 1.0, 2.0)[:, 0])
