import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import oracles
import strategies
from pilotage.kernels.partial_matching import Chain, Prices, match_at_poses

near = st.floats(-0.3, 0.3)
poses_near_identity = st.tuples(near, near, near)
prices = st.tuples(st.sampled_from([0.0, 0.2, 1.0]), st.floats(0.01, 3.0), st.integers(1, 3))


@st.composite
def chains(draw):
    """A polyline of few segments in a small room, and whether its ends go on."""
    polyline = draw(strategies.polylines(min_size=2, max_size=4, closed=False))
    assume(polyline.segment_lengths.min() > 1e-2)
    return polyline.vertices, draw(st.booleans()), draw(st.booleans())


@st.composite
def pairs_of_chains(draw):
    """Any two chains, or one and a noisy part of it, so that long matches come up too."""
    seen = draw(chains())
    if draw(st.booleans()):
        return seen, draw(chains())
    vertices = seen[0]
    noise = np.array(draw(st.lists(st.tuples(near, near), min_size=len(vertices), max_size=len(vertices))))
    return seen, (vertices + noise, draw(st.booleans()), draw(st.booleans()))


def as_chain(vertices, first_goes_on, last_goes_on):
    steps = np.diff(vertices, axis=0)
    return Chain(
        np.array(vertices, dtype=float),  # a copy that can be written to, as callers have it
        np.hypot(steps[:, 0], steps[:, 1]),
        np.arctan2(steps[:, 1], steps[:, 0]),
        first_goes_on,
        last_goes_on,
    )


@settings(max_examples=40)
@given(pairs_of_chains(), poses_near_identity, prices)
def test_the_dynamic_programme_finds_what_trying_everything_finds(pair, pose, prices):
    seen, known = pair

    expected = oracles.cheapest_match(seen, known, pose, prices)

    found = match_at_poses(as_chain(*seen), as_chain(*known), np.array([pose]), Prices(*prices))
    assert found.costs[0] == pytest.approx(expected, abs=1e-9)


@given(pairs_of_chains(), poses_near_identity)
def test_a_path_goes_forward_on_both_sides_one_segment_against_a_run(pair, pose):
    seen, known = (as_chain(*side) for side in pair)

    found = match_at_poses(seen, known, np.array([pose]), Prices(0.2, 0.5, 3))

    steps = np.diff(found.paths[0, : found.sizes[0]], axis=0)
    assert (found.sizes[0] >= 2) == (found.costs[0] < 0.0)
    assert (steps >= 1).all()
    assert (steps.min(axis=1) == 1).all()
    assert (steps <= 3).all()
