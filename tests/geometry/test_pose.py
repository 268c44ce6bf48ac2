import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Pose2, Similarity2
from strategies import coordinates, poses, scales


def assert_close(first, second):
    assert math.isclose(first.x, second.x, abs_tol=1e-6)
    assert math.isclose(first.y, second.y, abs_tol=1e-6)
    assert abs(math.remainder(first.theta - second.theta, math.tau)) < 1e-9


@given(poses, poses, poses)
def test_composition_is_associative(a, b, c):
    assert_close((a @ b) @ c, a @ (b @ c))


@given(poses)
def test_a_pose_and_its_inverse_cancel(pose):
    assert_close(Pose2.identity(), pose @ pose.inverse())
    assert_close(Pose2.identity(), pose.inverse() @ pose)


@given(poses, poses, coordinates, coordinates)
def test_composing_equals_moving_twice(a, b, x, y):
    points = np.array([[x, y]])

    np.testing.assert_allclose(a @ (b @ points), (a @ b) @ points, atol=1e-6)


similarities = st.builds(Similarity2, scales, poses)


@given(similarities, similarities, coordinates, coordinates)
def test_composing_similarities_equals_moving_twice(first, second, x, y):
    points = np.array([[x, y]])

    np.testing.assert_allclose(first @ (second @ points), (first @ second) @ points, atol=1e-6)
    np.testing.assert_allclose(points, first.inverse() @ (first @ points), atol=1e-6)


@given(poses, scales, poses)
def test_a_pose_is_a_similarity_of_scale_one(a, scale, b):
    similarity = Similarity2(scale, a)

    assert_close((similarity @ Similarity2(1.0, b)).pose, (similarity @ b).pose)


def test_a_quarter_turn_turns_counter_clockwise():
    moved = Pose2(2.0, 1.0, math.pi / 2) @ np.array([[1.0, 0.0]])

    np.testing.assert_allclose([[2.0, 2.0]], moved, atol=1e-12)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_poses_are_finite(bad):
    with pytest.raises(ValueError, match="must be finite"):
        Pose2(bad, 0.0, 0.0)


@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, math.inf])
def test_scales_are_positive(bad):
    with pytest.raises(ValueError, match="scale must be positive"):
        Similarity2(bad, Pose2.identity())
