"""Goals by name and by point, in the drawing's own axes."""

import math

import numpy as np
import pytest

from buildings import coarse
from knowing import estimate_at
from pilotage.geometry import Polyline
from pilotage.maps import NotEnclosedError, RouteError, SchematicMap, build_atlas
from pilotage.maps.schematic import Label
from pilotage.navigation.goal import CLEAR_OF_GATEWAY, find_goal

SCALE = 20.0
STROKES = ([(0, 0), (10, 0), (10, 5), (0, 5), (0, 0)], [(5, 0), (5, 2)], [(5, 3), (5, 5)])


def two_rooms(*, y_down=False):
    """Two rooms and a door between them, 20 units a metre, each with a name."""
    words = (Label("office", (40.0, 60.0)), Label("kitchen", (160.0, 20.0)))
    strokes = tuple(Polyline.through(SCALE * np.array(stroke)) for stroke in STROKES)
    return build_atlas(SchematicMap(strokes, labels=words, y_down=y_down), coarse())


ATLAS = two_rooms()
GRAPH = ATLAS.cell_graph
KITCHEN = GRAPH.cell_at((160.0, 50.0))


def standing(x, y, **claim):
    """Stand at a place given in metres."""
    cell_id = GRAPH.cell_at((SCALE * x, SCALE * y))
    return estimate_at(SCALE * x, SCALE * y, scale=SCALE, cell_id=cell_id, **claim)


def test_a_name_is_a_room_and_a_point_is_not():
    room, point = find_goal(ATLAS, "Kitchen"), find_goal(ATLAS, (160.0, 50.0))

    assert room.is_room
    assert not point.is_room
    assert KITCHEN == room.cell_id == point.cell_id
    assert (160.0, 50.0) == point.point


def test_a_point_is_in_the_axes_of_the_file():
    assert (160.0, 50.0) == find_goal(two_rooms(y_down=True), (160.0, -50.0)).point


def test_the_robot_is_in_the_room_once_it_is_clear_of_the_gateway():
    goal = find_goal(ATLAS, "kitchen")

    assert not goal.is_room_around(standing(4.0, 2.5), GRAPH)
    assert not goal.is_room_around(standing(5.0 + 0.8 * CLEAR_OF_GATEWAY, 2.5), GRAPH)
    assert goal.is_room_around(standing(5.0 + 1.2 * CLEAR_OF_GATEWAY, 2.5), GRAPH)
    assert goal.is_room_around(standing(9.5, 0.3), GRAPH)


def test_a_point_is_not_reached_anywhere_in_its_room():
    assert not find_goal(ATLAS, (160.0, 50.0)).is_room_around(standing(9.0, 1.0), GRAPH)


@pytest.mark.parametrize("goal", [(math.nan, 0.0), (0.0, math.inf)])
def test_a_point_that_is_not_finite_is_rejected(goal):
    with pytest.raises(ValueError, match="the goal must be finite"):
        find_goal(ATLAS, goal)


def test_what_cannot_be_found_is_said():
    with pytest.raises(RouteError, match="'cellar' stands in no cell"):
        find_goal(ATLAS, "cellar")
    with pytest.raises(RouteError, match="goal lies outside the drawing"):
        find_goal(ATLAS, (500.0, 0.0))
    with pytest.raises(NotEnclosedError, match="no closed room"):
        find_goal(build_atlas(SchematicMap((Polyline.through([(0, 0), (8, 0), (8, 3)]),)), coarse()), "x")
