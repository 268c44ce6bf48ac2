"""Motion is scored as the protocol says."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.evaluation.trajectory import associate, chain, motion_errors, motions, spoil, thin
from pilotage.geometry import Pose2, Trajectory
from strategies import poses

pose_lists = st.lists(poses, min_size=2, max_size=8)


def trajectory(stamps):
    return Trajectory(np.array(stamps), np.zeros((len(stamps), 3)))


@given(pose_lists)
def test_chained_motions_lead_where_the_poses_lead(path):
    start, *rest = chain(motions(path))

    assert start == Pose2.identity()
    for expected, got in zip(path[1:], rest, strict=True):
        there = (path[0] @ got).inverse() @ expected
        assert (there.x, there.y, there.theta) == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)


@given(pose_lists)
def test_true_motions_have_no_error(path):
    errors = motion_errors(motions(path), motions(path))

    np.testing.assert_allclose(errors.place, 0.0, atol=1e-9)
    np.testing.assert_allclose(errors.turn, 0.0, atol=1e-9)


def test_errors_of_place_and_turn_are_told_apart():
    errors = motion_errors([Pose2(1.3, 0.4, 0.2)], [Pose2(1.0, 0.0, 0.5)])

    assert errors.place[0] == pytest.approx(0.5)
    assert errors.turn[0] == pytest.approx(0.3)


def test_stamps_find_their_pose_whatever_the_order():
    assert [2, 0] == associate(np.array([1.0, 3.0]), trajectory([3.0, 2.0, 1.0])).tolist()


def test_equal_stamps_are_taken_in_turn():
    assert [0, 1, 2] == associate(np.array([1.0, 1.0, 2.0]), trajectory([1.0, 1.0, 2.0])).tolist()


def test_trajectories_of_equal_length_go_by_index_if_stamps_do_not_agree():
    assert [0, 1] == associate(np.array([10.0, 11.0]), trajectory([0.0, 1.0])).tolist()


def test_stamps_without_a_pose_are_an_error():
    with pytest.raises(ValueError, match="1 of 1 stamps"):
        associate(np.array([5.0]), trajectory([0.0, 1.0]))


def test_thinning_keeps_what_moved_or_turned_enough():
    path = [
        Pose2(x, 0.0, theta) for x, theta in [(0, 0), (0.3, 0), (0.6, 0), (0.6, 0.3), (0.6, 0.4), (0.9, 0.4)]
    ]

    assert [0, 2, 4] == thin(path, 0.5, math.radians(20.0))


def test_noise_grows_with_the_distance_and_comes_from_the_seed():
    steps = [Pose2(0.0, 0.0, 0.5), Pose2(1.0, 0.0, 0.0)]
    first, again = (
        spoil(steps, np.random.default_rng(3), place_per_meter=0.3, turn_per_meter=0.3) for _ in range(2)
    )

    assert first == again
    assert first[0] == steps[0]
    assert first[1] != steps[1]
