"""Whether the robot may stop where the goal should be."""

import math

from hypothesis import given
from hypothesis import strategies as st

from pilotage.navigation.arrival import DRIVE_ON_FOR, EXPLORE_FOR, Arrival, Doubt

SURE = 0.9


def judged(probability, position_std, *, times_doubted=0):
    return Arrival(times_doubted).judged(5.0, probability, position_std, SURE)


def test_who_knows_the_place_and_where_in_it_may_stop():
    assert Arrival() == judged(0.95, 0.4)


def test_who_is_not_sure_of_the_place_looks_for_more():
    assert Arrival(1, Doubt.WHICH_PLACE, 5.0 + EXPLORE_FOR) == judged(0.85, 0.1)


def test_who_is_not_sure_where_in_it_drives_on():
    assert Arrival(1, Doubt.WHERE_IN_IT, 5.0 + DRIVE_ON_FOR) == judged(0.95, 0.7)


@given(st.floats(0.0, 1.0), st.floats(0.0, 3.0), st.integers(0, 10))
def test_the_more_often_it_doubted_the_less_it_asks(confidence, spread, times_doubted):
    before = judged(confidence, spread, times_doubted=times_doubted)
    again = judged(confidence, spread, times_doubted=times_doubted + 1)

    assert before.doubt is not Doubt.NONE or again.doubt is Doubt.NONE


@given(st.integers(0, 100))
def test_a_place_that_is_hardly_believed_is_never_stopped_at(times_doubted):
    assert Doubt.WHICH_PLACE is judged(0.65, 0.0, times_doubted=times_doubted).doubt


def test_a_doubt_ends_with_its_time():
    doubting = judged(0.5, 0.1)

    assert doubting == doubting.updated(14.9, 0.5, 0.1, SURE)
    assert Arrival(1) == doubting.updated(15.0, 0.5, 0.1, SURE)


def test_which_place_it_is_is_no_doubt_once_the_robot_is_sure():
    doubting = judged(0.5, 0.1)

    assert doubting == doubting.updated(6.0, 0.89, 0.1, SURE)
    assert Arrival(1) == doubting.updated(6.0, 0.9, 0.1, SURE)


def test_where_in_the_place_is_no_doubt_once_it_is_settled():
    doubting = judged(0.95, 0.7)

    assert doubting == doubting.updated(6.0, 0.95, 0.65, SURE)
    assert Arrival(1) == doubting.updated(6.0, 0.95, 0.45, SURE)


def test_nothing_is_doubted_at_first():
    assert (0, Doubt.NONE, -math.inf) == (Arrival().times_doubted, Arrival().doubt, Arrival().until)
