"""Laws of affine maps."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Affine2
from strategies import angles, coordinates, poses

logarithms = st.floats(-1.0, 1.0)
maps = st.builds(Affine2.from_state, coordinates, coordinates, angles, logarithms, logarithms, logarithms)
points = st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=5).map(np.array)


def assert_same(first, second):
    np.testing.assert_allclose(first.linear, second.linear, atol=1e-6)
    np.testing.assert_allclose(first.translation, second.translation, atol=1e-6)


@given(maps, points)
def test_an_inverse_undoes_the_map(a_from_b, some):
    np.testing.assert_allclose(a_from_b.inverse() @ (a_from_b @ some), some, atol=1e-6)
    assert_same(a_from_b.inverse().inverse(), a_from_b)


@given(maps, maps, points)
def test_to_compose_is_to_apply_one_after_the_other(a_from_b, b_from_c, some):
    np.testing.assert_allclose((a_from_b @ b_from_c) @ some, a_from_b @ (b_from_c @ some), atol=1e-6)


@given(maps, poses, points)
def test_a_pose_composes_like_an_affine_map(a_from_b, b_from_c, some):
    np.testing.assert_allclose((a_from_b @ b_from_c) @ some, a_from_b @ (b_from_c @ some), atol=1e-6)


@given(st.tuples(coordinates, coordinates, angles, logarithms, logarithms, logarithms))
def test_a_state_says_position_heading_and_scale(state):
    x, y, heading, log_scale, *_ = state
    carried = Affine2.from_state(*state)

    assert [x, y] == carried.pose.position.tolist() == carried.translation.tolist()
    assert abs(math.remainder(carried.pose.theta - heading, math.tau)) < 1e-6
    assert math.isclose(math.exp(log_scale), carried.scale, rel_tol=1e-9)


@given(coordinates, coordinates, angles, logarithms)
def test_without_a_stretch_all_directions_are_scaled_alike(x, y, heading, log_scale):
    lengths = np.linalg.svd(Affine2.from_state(x, y, heading, log_scale, 0.0, 0.0).linear, compute_uv=False)

    np.testing.assert_allclose(lengths, math.exp(log_scale))


@given(maps)
def test_equal_maps_hash_alike(a_from_b):
    again = Affine2(a_from_b.linear.copy(), a_from_b.translation.copy())

    assert a_from_b == again
    assert hash(a_from_b) == hash(again)
