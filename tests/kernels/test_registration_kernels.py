"""The kernels of registration agree with their plain oracles."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import registration_oracles as oracles
from pilotage.kernels.point_to_segment import linearize, refine_pose, solve_symmetric
from pilotage.kernels.pose_search import add_place_scores, search_poses
from pilotage.kernels.samples import Samples, Trials
from pilotage.kernels.segment_field import NONE, build_segment_field, find_nearest
from pilotage.kernels.segment_sampling import sample_segments

CELL, REACH = 0.1, 0.6
ROOM = np.array(
    [
        [-3.0, -2.0, 3.0, -2.0],
        [3.0, -2.0, 3.0, 2.0],
        [3.0, 2.0, 1.0, 2.0],
        [1.0, 2.0, 1.0, 1.0],
        [1.0, 1.0, -3.0, 1.0],
        [-3.0, 1.0, -3.0, -2.0],
    ]
)
FREE = np.zeros((3, 3))  # no prior
SCALES = np.array([0.5, 0.3, 0.2, 0.1, 0.05, 0.05, 0.05, 0.05])

coordinate = st.floats(-3.0, 3.0).map(lambda value: round(value, 2))
segment_lists = st.lists(
    st.tuples(coordinate, coordinate, coordinate, coordinate).filter(lambda s: s[:2] != s[2:]),
    min_size=1,
    max_size=8,
).map(np.array)


def rigid(pose, points):
    return np.array([oracles.place(pose, point) for point in points])


def seen_from(pose, step=0.1):
    """The room, sampled, in the frame of a robot at a pose."""
    points, directions, weights, _ = sample_segments(ROOM, step)
    c, s = math.cos(pose[2]), math.sin(pose[2])
    turn = np.array([[c, -s], [s, c]])
    return Samples(
        np.ascontiguousarray((points - pose[:2]) @ turn), np.ascontiguousarray(directions @ turn), weights
    )


def samples_of(segments):
    """Sample segments where they are."""
    return Samples(*sample_segments(np.array(segments), 0.1)[:3])


@settings(max_examples=30)
@given(segment_lists)
def test_every_cell_knows_its_nearest_segment(segments):
    field = build_segment_field(segments, CELL, REACH)
    rows, columns = field.nearest.shape
    rng = np.random.default_rng(0)
    for row, column in zip(rng.integers(0, rows, 40), rng.integers(0, columns, 40), strict=True):
        center = (field.left + (column + 0.5) * CELL, field.bottom + (row + 0.5) * CELL)
        _, distance = oracles.nearest_segment(center, segments)
        if distance > REACH + 1e-9:
            assert field.nearest[row, column] == NONE
        elif distance < REACH - 1e-9:
            assert field.distance[row, column] == pytest.approx(distance, abs=1e-5)
            found = segments[field.nearest[row, column]]
            assert oracles.distance_to_segment(center, found) == pytest.approx(distance, abs=1e-5)


def test_no_segments_make_an_empty_field():
    field = build_segment_field(np.empty((0, 4)), CELL, REACH)

    assert (field.nearest == NONE).all()
    assert find_nearest(np.zeros((1, 2)), np.ones((1, 2)), field, -1.0).tolist() == [NONE]


@given(segment_lists, st.floats(0.02, 1.0))
def test_samples_weigh_as_much_as_the_segments_are_long(segments, step):
    points, directions, weights, owners = sample_segments(segments, step)
    lengths = np.hypot(*(segments[:, 2:] - segments[:, :2]).T)

    np.testing.assert_allclose(np.bincount(owners, weights, len(segments)) * step, lengths)
    np.testing.assert_allclose(np.hypot(*directions.T), 1.0)
    for point, owner in zip(points, owners, strict=True):
        assert oracles.distance_to_segment(point, segments[owner]) == pytest.approx(0.0, abs=1e-9)


def test_a_segment_without_length_has_no_samples():
    points, *_ = sample_segments(np.array([[1.0, 1.0, 1.0, 1.0]]), 0.1)

    assert len(points) == 0


@given(
    st.lists(st.floats(-1.0, 1.0), min_size=9, max_size=9),
    st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=3),
)
def test_three_equations_are_solved(entries, right):
    m = np.array(entries).reshape(3, 3)
    a = m @ m.T + 0.1 * np.eye(3)

    np.testing.assert_allclose(solve_symmetric(a, np.array(right)), np.linalg.solve(a, right), atol=1e-6)


def test_singular_equations_move_nothing():
    assert [0.0, 0.0, 0.0] == solve_symmetric(np.zeros((3, 3)), np.ones(3)).tolist()


def test_the_gradient_is_that_of_the_robust_cost():
    pose, scale, overhang = np.array([0.05, -0.03, 0.02]), 0.2, 0.1
    field = build_segment_field(ROOM, CELL, REACH)
    samples = seen_from((0.0, 0.0, 0.0), step=0.37)
    samples.weights[:] = 1.0
    _, gradient, _ = linearize(samples, field, pose, scale, -1.0, overhang)
    h = 1e-6
    for axis in range(3):
        step = np.eye(3)[axis] * h
        plus = oracles.robust_cost(samples.points, field, pose + step, scale, overhang)
        minus = oracles.robust_cost(samples.points, field, pose - step, scale, overhang)

        assert gradient[axis] == pytest.approx((plus - minus) / (2 * h), rel=1e-3, abs=1e-4)


@settings(max_examples=40)
@given(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(-0.15, 0.15))
def test_a_displaced_room_is_put_back(x, y, theta):
    true = np.array([0.3, -0.4, 0.7])
    field = build_segment_field(ROOM, CELL, REACH)
    samples = seen_from(true)
    start = true + np.array([x, y, theta])
    pose, _, inlier_weight = refine_pose(samples, field, start, start, FREE, 1.0, SCALES, 0.5, 0.1)

    np.testing.assert_allclose(pose, true, atol=1e-3)
    least = 0.95 * samples.weights.sum()  # in a corner the nearest segment may be the other wall
    assert inlier_weight > least


def test_along_a_corridor_the_prior_holds():
    corridor = np.array([[-20.0, -1.0, 20.0, -1.0], [20.0, 1.0, -20.0, 1.0]])
    field = build_segment_field(corridor, CELL, REACH)
    samples = samples_of([[-3.0, -1.1, 3.0, -1.1], [3.0, 0.9, -3.0, 0.9]])
    prior = np.array([1.0, 0.0, 0.0])
    information = np.diag([0.1, 0.1, 0.1])
    pose, *_ = refine_pose(samples, field, prior, prior, information, 1.0, SCALES, 0.5, 0.1)

    np.testing.assert_allclose(pose, [1.0, 0.1, 0.0], atol=2e-3)


def test_walls_that_run_the_other_way_do_not_attract():
    field = build_segment_field(np.array([[3.0, 0.0, -3.0, 0.0]]), CELL, REACH)
    samples = samples_of([[-2.0, 0.1, 2.0, 0.1]])
    *_, inlier_weight = linearize(samples, field, np.zeros(3), 0.2, 0.5, 0.1)

    assert inlier_weight == 0.0


@settings(max_examples=20)
@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
def test_places_score_as_the_plain_sum_does(x, y, theta):
    field = build_segment_field(ROOM, CELL, REACH)
    samples = seen_from((0.0, 0.0, 0.0), step=0.4)
    scores = np.zeros((2, 3))
    add_place_scores(scores, samples, field, np.array([x, y]), theta, 2, 0.3, 0.5)
    expected = oracles.place_score(samples, field, (x, y, theta), width=0.3, min_cosine=0.5)

    assert scores[0, 0] == pytest.approx(expected)


def test_the_search_finds_a_room_that_odometry_lost():
    true = np.array([0.8, -0.4, 0.7])
    field = build_segment_field(ROOM, CELL, REACH)
    guess = true + np.array([-0.8, 0.5, -0.6])
    poses = search_poses(
        seen_from(true, step=0.3),
        field,
        guess,
        np.array([0.4, 0.3]),
        np.array([1.2, 0.9]),
        Trials(
            turn_step=math.radians(3.0),
            stride=2,
            scale=0.3,
            min_cosine=0.5,
            prior_weight=0.03,
            robust_scale=4.0,
            kept=8,
        ),
    )

    assert poses.shape == (8, 3)
    np.testing.assert_allclose(poses[0], true, atol=0.15)
