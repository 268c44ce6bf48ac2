"""Setting a robot out in a world, and driving it to the end."""

import math
from dataclasses import replace

import numpy as np
import pytest

from buildings import flat
from pilotage.config import Settings
from pilotage.drives import navigate, set_out
from pilotage.errors import PilotageError
from pilotage.geometry import Polyline, Pose2
from pilotage.maps import NotEnclosedError, RouteError, SchematicMap
from pilotage.navigation import NavigatorSettings
from pilotage.simulation import World

WORLD, START, GOAL = World.of(flat()), Pose2(1.0, 6.0, -math.pi / 2), (8.5, 5.0)
SHORT = replace(Settings(), navigator=NavigatorSettings(time_limit=3.0))


def test_equal_seeds_give_equal_drives():
    first, second = (
        navigate(flat(), WORLD, GOAL, world_start=START, seed=3, settings=SHORT) for _ in range(2)
    )

    assert first.outcome is not None
    np.testing.assert_array_equal(first.positions, second.positions)


def test_a_drive_begins_where_the_world_says():
    _, simulator = set_out(flat(), replace(WORLD, start=START), GOAL)

    assert START == simulator.world_from_base


def test_without_a_place_to_begin_the_seed_chooses_a_free_one():
    first, again, other = (set_out(flat(), WORLD, GOAL, seed=seed)[1].world_from_base for seed in (1, 1, 2))

    assert first == again != other
    assert WORLD.is_free([first.position, other.position], 0.2).all()


def test_a_world_without_free_space_is_rejected():
    with pytest.raises(PilotageError, match="free space that walls enclose"):
        set_out(flat(), World(WORLD.segments[:1]), GOAL)


def test_start_and_goal_are_in_the_axes_of_the_drawing():
    strokes = tuple(Polyline(stroke.vertices) for stroke in flat().strokes)
    flipped = SchematicMap(strokes, y_down=True)
    navigator, _ = set_out(flipped, WORLD, (8.5, -5.0), start=(1.0, -6.0, 0.5), world_start=START)

    assert GOAL == navigator.planner.goal.point
    x, y, heading = navigator.position.localizer.sample(100)[:3]
    assert 2.0 > np.hypot(x - 1.0, y - 6.0).mean()
    assert 0.9 < np.cos(heading - 0.5).mean()


def test_a_start_may_be_known_without_a_heading():
    navigator, _ = set_out(flat(), WORLD, GOAL, start=(1.0, 6.0), world_start=START)
    x, y, headings = navigator.position.localizer.sample(400)[:3]

    assert 2.0 > np.hypot(x - 1.0, y - 6.0).mean()
    assert 0.3 > np.hypot(np.cos(headings).mean(), np.sin(headings).mean())


@pytest.mark.parametrize(
    ("drawing", "goal", "settings", "error", "message"),
    [
        (flat(), (30.0, 30.0), {"world_start": START}, RouteError, "goal lies outside the drawing"),
        (flat(), "kitchen", {"world_start": START}, RouteError, "'kitchen' stands in no cell"),
        (flat(), GOAL, {"world_start": Pose2(0.0, 0.0, 0.0)}, PilotageError, "in or at a wall"),
        (
            flat(),
            GOAL,
            {"world_start": START, "start": (30.0, 30.0, 0.0)},
            RouteError,
            "start lies outside the drawing",
        ),
        (
            SchematicMap((*flat().strokes, Polyline.through([(20, 0), (22, 0), (22, 2), (20, 2), (20, 0)]))),
            (21.0, 1.0),
            {"start": (1.0, 6.0), "world_start": START},
            RouteError,
            "no gateways join them",
        ),
        (
            SchematicMap((Polyline.through([(0, 0), (8, 0), (8, 3)]),)),
            GOAL,
            {"world_start": START},
            NotEnclosedError,
            "no closed room",
        ),
    ],
)
def test_what_cannot_be_driven_is_rejected_before_anything_moves(drawing, goal, settings, error, message):
    with pytest.raises(error, match=message):
        set_out(drawing, WORLD, goal, **settings)
