"""Where in its surroundings the robot stands."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Pose2
from pilotage.localization.belief import Belief, similarity_of, stretched
from pilotage.localization.placement import Placement, place_at
from strategies import angles, coordinates, poses

small = st.floats(-0.7, 0.7)
states = st.tuples(coordinates, coordinates, angles, small, small, small).map(np.array)
AXIS = np.array([0.3, 0.4])
points = st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=5).map(np.array)


def gathered(*rows, weights=None):
    """Belief in hypotheses (x, y, heading, log scale) without stretch."""
    columns = np.vstack([np.array(rows, dtype=float).T, np.zeros((2, len(rows)))])
    return Belief(columns, np.log(weights or np.ones(len(rows))))


@given(states, points)
def test_points_are_carried_to_the_drawing_and_back(state, in_base):
    placement = Placement(state, 0.0, AXIS)

    on_paper = placement.sketch_from_base(in_base)
    np.testing.assert_allclose(placement.base_from_sketch(on_paper), in_base, atol=1e-9)


@given(states, st.tuples(coordinates, coordinates))
def test_a_place_means_what_its_hypotheses_mean(state, point):
    carried = Placement(state, 0.0, AXIS).sketch_from_base(np.array([point]))[0]

    np.testing.assert_allclose(state[:2] + stretched(state[:, np.newaxis], *point)[:, 0], carried, atol=1e-9)


@given(states, points)
def test_a_place_without_stretch_is_a_similarity(state, in_base):
    state[4:] = 0.0

    np.testing.assert_allclose(
        similarity_of(state) @ in_base, Placement(state, 0.0, AXIS).sketch_from_base(in_base), atol=1e-9
    )
    assert math.isclose(similarity_of(state).scale, Placement(state, 0.0, AXIS).scale)


@given(states, poses, poses)
def test_moving_twice_is_moving_by_both(state, first, second):
    placement = Placement(state, 0.3, AXIS)

    twice, at_once = placement.moved(first).moved(second), placement.moved(first @ second)
    np.testing.assert_allclose(twice.position, at_once.position, atol=1e-9)
    np.testing.assert_allclose(twice.linear, at_once.linear, atol=1e-9)
    assert 0.3 == twice.spread
    np.testing.assert_array_equal(AXIS, twice.axis)


@given(states, poses, points)
def test_what_stands_still_stays_on_the_drawing_while_the_robot_moves(state, motion, in_base):
    placement = Placement(state, 0.0, AXIS)

    np.testing.assert_allclose(
        placement.sketch_from_base(in_base),
        placement.moved(motion).sketch_from_base(motion.inverse() @ in_base),
        atol=1e-9,
    )


def test_moving_changes_nothing_of_the_place_before():
    placement = Placement(np.zeros(6), 0.0, AXIS)
    placement.moved(Pose2(1.0, 2.0, 0.5))

    assert (0.0, 0.0) == placement.position


def test_a_place_is_the_mean_of_the_hypotheses_near_it_by_weight():
    belief = gathered((0, 0, 0.2, 0), (1, 0, 0.4, 0), (9, 9, 3, 0), weights=[3.0, 1.0, 96.0])

    placement = place_at(belief, (0.2, 0.0), reach=2.0)

    np.testing.assert_allclose([0.25, 0.0], placement.position)
    # one at 0.25 m with weight 3 / 4, one at 0.75 m with weight 1 / 4
    assert math.isclose(math.sqrt(0.75 * 0.25**2 + 0.25 * 0.75**2), placement.spread)
    assert 0.2 < placement.state[2] < 0.4


def test_reach_and_spread_are_in_metres_whatever_the_scale():
    tenfold = math.log(10.0)
    belief = gathered((0, 0, 0, tenfold), (10, 0, 0, tenfold), (30, 0, 0, tenfold))

    placement = place_at(belief, (0.0, 0.0), reach=2.0)

    np.testing.assert_allclose([5.0, 0.0], placement.position)
    assert math.isclose(0.5, placement.spread)
    assert math.isclose(10.0, placement.scale)


def test_far_from_all_hypotheses_the_place_is_the_mean_of_all():
    belief = gathered((0, 0, 0, 0), (4, 2, 0, 0))

    np.testing.assert_allclose([2.0, 1.0], place_at(belief, (100.0, 100.0), reach=2.0).position)


def test_headings_on_both_sides_of_the_half_turn_are_averaged_across_it():
    belief = gathered((0, 0, math.pi - 0.1, 0), (0, 0, -math.pi + 0.1, 0))

    assert math.isclose(-1.0, math.cos(place_at(belief, (0.0, 0.0), reach=1.0).state[2]))


@given(angles, st.floats(0.1, 5.0))
def test_the_axis_lies_along_the_line_on_which_hypotheses_stand(direction, scale):
    along = scale * np.array([math.cos(direction), math.sin(direction)])
    belief = gathered(*((*(k * along), 0.0, math.log(scale)) for k in (-1.0, 0.0, 1.0)))

    placement = place_at(belief, (0.0, 0.0), reach=5.0)

    deviation = math.sqrt(2.0 / 3.0)  # of -1, 0 and 1
    axis = math.copysign(1.0, placement.axis @ along) * placement.axis
    np.testing.assert_allclose(deviation * along, axis, atol=1e-9)
    assert math.isclose(deviation, placement.spread)
