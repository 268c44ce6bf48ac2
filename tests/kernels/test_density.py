import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.kernels import density as kernel

BOUNDS = (-3.0, 1.0, 20.0, 10.0)


def plain_gather(states, weights, block, most_blocks, radius):
    """The definition: all blocks against all particles."""
    left, bottom, width, height = BOUNDS
    scale = math.exp(np.average(states[3], weights=weights))
    size = max(block * scale, max(width, height) / most_blocks)
    low, high = np.array([left, bottom]) - size, np.array([width, height]) + 2.0 * size
    places = np.floor(np.clip(states[:2].T - low, 0.0, high) / size)
    columns, rows = (np.arange(math.ceil(one / size) + 1) for one in high)
    blocks = np.array([(column, row) for column in columns for row in rows])
    around = (np.abs(places[:, np.newaxis] - blocks) <= 1).all(axis=2)  # (particles, blocks)
    inside = around[:, np.argmax(weights @ around)] & (weights > 0.0)
    x, y, _, log_scale, *_ = np.average(states[:, inside], axis=1, weights=weights[inside])
    distances = np.hypot(states[0] - x, states[1] - y) / math.exp(log_scale)
    return (distances <= max(radius, distances[weights > 0.0].min())) & (weights > 0.0)


def cloud(seed, middles):
    """Particles about some places, the first place with most of them."""
    rng = np.random.default_rng(seed)
    states = rng.normal(0.0, 0.3, (6, 20 * len(middles)))
    states[:2] += np.repeat(middles, 20, axis=0).T
    weights = rng.random(states.shape[1]) * np.repeat(0.7 ** np.arange(len(middles)), 20)
    weights[rng.random(len(weights)) < 0.2] = 0.0
    return states, weights / weights.sum()


@given(
    st.integers(0, 1000),
    st.lists(st.tuples(st.floats(-2.0, 16.0), st.floats(2.0, 10.0)), min_size=1, max_size=5),
    st.sampled_from([0.01, 1.0, 3.0]),
    st.sampled_from([5, 1_000]),
)
def test_the_densest_particles_are_gathered(seed, middles, radius, most_blocks):
    states, weights = cloud(seed, middles)

    members = kernel.gather_densest(states, weights, BOUNDS, 1.0, most_blocks, radius)

    np.testing.assert_array_equal(members, plain_gather(states, weights, 1.0, most_blocks, radius))
    assert members.any()


@pytest.mark.parametrize("off", [-100.0, 100.0])
def test_particles_beside_the_drawing_are_gathered_too(off):
    states, weights = cloud(0, [(5.0 + off, 5.0 + off)])

    members = kernel.gather_densest(states, weights, BOUNDS, 1.0, 1_000, 5.0)

    np.testing.assert_array_equal(members, weights > 0.0)
