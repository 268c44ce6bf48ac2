"""Marks on the timeline say what has changed from one step to the next."""

from dataclasses import replace

from four_rooms import GRAPH
from made_up_drive import through_the_door
from pilotage.navigation import Outcome, Visit
from pilotage.web.marks import changes

STEP = through_the_door().steps[0]
KITCHEN = Visit("kitchen", Outcome.REACHED, 9.0, "'kitchen' is reached")
HALL = Visit((3.0, 4.5), Outcome.GAVE_UP, 20.0, "no way leads there")


def test_each_goal_of_a_tour_is_told_as_soon_as_it_is_over() -> None:
    at_kitchen, at_end = replace(STEP, visits=(KITCHEN,)), replace(STEP, visits=(KITCHEN, HALL))

    assert [("reached", "kitchen: 'kitchen' is reached")] == list(changes(STEP, at_kitchen, GRAPH))
    assert [] == list(changes(at_kitchen, at_kitchen, GRAPH))
    ended = replace(at_end, outcome=Outcome.GAVE_UP, reason="1 of 2 goals are reached")
    assert [
        ("gave up", "3,4.5: no way leads there"),
        ("gave up", "1 of 2 goals are reached"),
    ] == list(changes(at_kitchen, ended, GRAPH))


def test_the_only_goal_is_told_once() -> None:
    ended = replace(STEP, visits=(KITCHEN,), outcome=Outcome.REACHED, reason="'kitchen' is reached")

    assert [("reached", "'kitchen' is reached")] == list(changes(STEP, ended, GRAPH))
