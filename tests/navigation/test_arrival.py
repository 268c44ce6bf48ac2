"""Whether the robot may stop where the goal should be."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Pose2, Similarity2
from pilotage.localization import Estimate, Status
from pilotage.navigation.arrival import Arrival, ArrivalSettings, Doubt

SETTINGS = ArrivalSettings(sure=0.9, easing=0.1, least=0.3, settled=0.5, look=10.0, drive_on=20.0)


def knowing(confidence, status=Status.LOCATED):
    return Estimate(0.0, status, "c1", Similarity2(1.0, Pose2.identity()), confidence)


def judged(confidence, spread, *, times_doubted=0, status=Status.LOCATED):
    arrival = Arrival(times_doubted)
    return arrival.judged(5.0, knowing(confidence, status), spread, SETTINGS)


def test_who_knows_the_place_and_where_in_it_may_stop():
    assert Arrival() == judged(0.95, 0.4)


def test_who_is_not_sure_of_the_place_looks_for_more():
    assert Arrival(1, Doubt.WHICH_PLACE, 15.0) == judged(0.85, 0.1)
    assert Doubt.WHICH_PLACE is judged(0.95, 0.1, status=Status.LOST).doubt


def test_who_is_not_sure_where_in_it_drives_on():
    assert Arrival(1, Doubt.WHERE_IN_IT, 25.0) == judged(0.95, 0.6)


@given(st.floats(0.0, 1.0), st.floats(0.0, 3.0), st.integers(0, 10))
def test_the_more_often_it_doubted_the_less_it_asks(confidence, spread, times_doubted):
    before = judged(confidence, spread, times_doubted=times_doubted)
    again = judged(confidence, spread, times_doubted=times_doubted + 1)

    assert before.doubt is not Doubt.NONE or again.doubt is Doubt.NONE


@given(st.integers(0, 100))
def test_a_place_that_is_hardly_believed_is_never_stopped_at(times_doubted):
    assert Doubt.WHICH_PLACE is judged(0.25, 0.0, times_doubted=times_doubted).doubt


def test_a_doubt_ends_with_its_time():
    doubting = judged(0.5, 0.1)

    assert doubting == doubting.at(14.9, 0.5, 0.1, SETTINGS)
    assert Arrival(1) == doubting.at(15.0, 0.5, 0.1, SETTINGS)


def test_which_place_it_is_is_no_doubt_once_the_robot_is_sure():
    doubting = judged(0.5, 0.1)

    assert doubting == doubting.at(6.0, 0.89, 0.1, SETTINGS)
    assert Arrival(1) == doubting.at(6.0, 0.9, 0.1, SETTINGS)


def test_where_in_the_place_is_no_doubt_once_it_is_settled():
    doubting = judged(0.95, 0.6)

    assert doubting == doubting.at(6.0, 0.95, 0.55, SETTINGS)
    assert Arrival(1) == doubting.at(6.0, 0.95, 0.45, SETTINGS)


@pytest.mark.parametrize("name", ["near", "settled"])
def test_a_robot_that_cannot_arrive_is_refused(name):
    with pytest.raises(ValueError, match=f"{name} must be > 0 m, got 0.0"):
        ArrivalSettings(**{name: 0.0})


@pytest.mark.parametrize("name", ["sure", "easing", "least"])
def test_confidence_is_a_share(name):
    with pytest.raises(ValueError, match=rf"{name} must be in \[0, 1\], got 1.5"):
        ArrivalSettings(**{name: 1.5})


def test_nothing_is_doubted_at_first():
    assert (0, Doubt.NONE, -math.inf) == (Arrival().times_doubted, Arrival().doubt, Arrival().until)
