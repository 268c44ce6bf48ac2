"""Several goals in order."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.navigation import Outcome, Tour
from pilotage.navigation.tour import HOME, tour_of

OUTCOMES = st.sampled_from([Outcome.REACHED, Outcome.GAVE_UP])


@given(st.integers(1, 4), st.integers(1, 3), st.booleans(), st.data())
def test_each_goal_is_tried_once_a_round_and_home_comes_last(count, rounds, returns, data):
    goals = tuple(f"room {number}" for number in range(count))
    tour, tried, ended = Tour(goals, rounds, returns), [], []
    while not tour.is_over:
        tried.append(tour.goal)
        ended.append(data.draw(OUTCOMES))
        tour = tour.after(ended[-1], 1.0, "so it is")

    assert [*goals * rounds, *([HOME] if returns else [])] == tried
    assert (tour.outcome is Outcome.REACHED) == all(one is Outcome.REACHED for one in ended)
    assert 1 + ended.count(Outcome.GAVE_UP) == len(tour.reason.split("; ")) or len(tried) == 1


def test_a_patrol_never_ends_unless_the_drawing_does_not_fit():
    tour = Tour(("a", "b"), rounds=None)
    for _ in range(7):
        tour = tour.after(Outcome.GAVE_UP, 0.0, "")
        assert not tour.is_over

    assert "b" == tour.goal
    assert tour.after(Outcome.MISMATCH, 0.0, "").is_over


@pytest.mark.parametrize("number", [int, float, np.float32, np.int64])
def test_a_point_is_two_numbers_of_any_type(number):
    point = number(3), number(4)

    assert ((3.0, 4.0),) == tour_of(point).goals == tour_of(np.array(point)).goals
    assert ((3.0, 4.0), (3.0, 4.0)) == tour_of([np.array(point), point]).goals


@pytest.mark.parametrize("goal", [[(1.0, 2.0, 3.0)], [3.0], [None, None], [("a", "b")]])
def test_what_is_neither_a_name_nor_a_point_is_no_goal(goal):
    with pytest.raises(ValueError, match="a goal must be a name or a point x, y"):
        tour_of(goal)
