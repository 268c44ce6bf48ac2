"""How much of a scan is new, by laws and worked examples, and which keyframes stand for a window."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Pose2
from pilotage.localization.keyframes import Keyframe, choose_keyframes, novelty_at
from pilotage.localization.sensor_model import SparseScan
from pilotage.shape.corners import find_corners

HALF, ALL_AROUND = math.pi, math.tau

coordinates = st.floats(-5.0, 5.0)
poses = st.builds(Pose2, coordinates, coordinates, st.floats(-math.pi, math.pi))
views = st.floats(0.1, math.tau)


def keyframe(pose, novelty=1.0):
    nothing = np.empty(0, dtype=np.int32)
    return Keyframe(SparseScan(nothing, nothing), find_corners([]), pose, 0.0, novelty)


def window_of(poses):
    return tuple(keyframe(pose) for pose in poses)


@given(poses, views, st.lists(poses, max_size=5))
def test_novelty_is_a_share_and_whole_where_nothing_was_seen(pose, view, seen_from):
    assert 0.0 <= novelty_at(pose, view, window_of(seen_from)) <= 1.0
    assert novelty_at(pose, view, ()) == 1.0


@given(poses, views, st.lists(poses, min_size=1, max_size=5), poses)
def test_who_has_seen_more_learns_less(pose, view, seen_from, further):
    before = novelty_at(pose, view, window_of(seen_from))

    assert novelty_at(pose, view, window_of([*seen_from, further])) <= before
    assert novelty_at(pose, view, window_of([*seen_from, pose])) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("pose", "view", "expected"),
    [
        (Pose2(0.25, 0.0, 0.0), HALF, 0.5),
        (Pose2(0.0, 0.5, 0.0), ALL_AROUND, 1.0),
        (Pose2(0.0, 0.0, math.radians(30.0)), HALF, 0.5),
        (Pose2(0.0, 0.0, math.radians(-90.0)), HALF, 1.0),
        (Pose2(0.0, 0.0, math.radians(30.0)), 1.5 * math.pi, 0.25),
        (Pose2(0.0, 0.0, math.radians(170.0)), ALL_AROUND, 0.0),
        (Pose2(0.25, 0.0, math.radians(15.0)), HALF, 0.75),
    ],
)
def test_novelty_of_worked_examples(pose, view, expected):
    assert novelty_at(pose, view, window_of([Pose2.identity()])) == pytest.approx(expected)


def test_the_way_back_shows_nothing_new_to_a_scanner_that_sees_all_around():
    way = window_of([Pose2(0.5 * k, 0.0, 0.0) for k in range(10)])

    assert novelty_at(Pose2(2.0, 0.0, math.pi), ALL_AROUND, way) == pytest.approx(0.0, abs=1e-9)
    assert novelty_at(Pose2(2.0, 0.0, math.pi), HALF, way) == 1.0


@given(st.lists(st.floats(0.0, 1.0), max_size=20), st.integers(1, 10))
def test_chosen_keyframes_are_some_of_the_window_the_newest_first(novelty, count):
    window = tuple(keyframe(Pose2.identity(), share) for share in (1.0, *novelty))

    chosen = choose_keyframes(window, count)

    order = [next(i for i, one in enumerate(window) if one is each) for each in chosen]
    assert order == sorted(set(order), reverse=True)
    assert chosen[0] is window[-1]
    assert len(chosen) <= count


@pytest.mark.parametrize("length", [1, 2, 7, 8, 9, 20])
def test_keyframes_of_equal_novelty_are_chosen_evenly(length):
    window = window_of([Pose2.identity()] * length)
    even = np.linspace(0, length - 1, min(8, length))

    chosen = [next(i for i, one in enumerate(window) if one is each) for each in choose_keyframes(window, 8)]

    np.testing.assert_allclose(chosen[::-1], even, atol=0.5)


def test_a_robot_that_stood_and_turned_is_judged_by_the_rest_of_its_way():
    novelty = [1.0, 1.0, 1.0, *[0.0] * 12, 1.0, 1.0]
    window = tuple(keyframe(Pose2.identity(), share) for share in novelty)

    chosen = choose_keyframes(window, 5)

    assert sum(one.novelty for one in chosen) == 5.0
