import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

from buildings import flat
from pilotage.config import Settings
from pilotage.errors import PilotageError
from pilotage.evaluation.drive import Destination, Drive, drive, navigate, score, set_out
from pilotage.geometry import Polyline, Pose2, Similarity2, Twist
from pilotage.localization import Estimate, Status
from pilotage.maps import NotEnclosedError, RouteError, SchematicMap
from pilotage.navigation import Behavior, NavigatorSettings, Outcome, Step
from pilotage.simulation import Simulator, World

HALL = World(np.array([[0, 0, 20, 0], [20, 0, 20, 3], [20, 3, 0, 3], [0, 3, 0, 0]], dtype=np.float64))
WEST, EAST = shapely.box(0, 0, 10, 3), shapely.box(10, 0, 20, 3)
AHEAD, STOP = Twist(0.5, 0.0), Twist(0.0, 0.0)


class Script:
    """A pilot that does what it is told, whatever it sees."""

    def __init__(self, commands, outcome=Outcome.REACHED, told=()):
        self.commands, self.outcome = [*commands, STOP], outcome
        self.told = [*told, *[(Status.LOCATED, 0)] * len(self.commands)]
        self.count = 0

    def step(self, scan, odometry):
        assert scan.stamp == odometry.stamp
        status, times_lost = self.told[self.count]
        here = Similarity2(1.0, Pose2.identity())
        estimate = Estimate(scan.stamp, status, "cell-1", here, float(status is Status.LOCATED))
        command = self.commands[self.count]
        self.count += 1
        outcome = self.outcome if self.count == len(self.commands) else None
        return Step(
            scan.stamp, command, Behavior.CROSS, estimate, times_lost=times_lost, outcome=outcome, reason="so"
        )


def driven(script, x=1.0):
    return Drive(tuple(drive(script, Simulator(HALL, Pose2(x, 1.5, 0.0), np.random.default_rng(0)))))


def test_a_drive_goes_on_until_its_outcome_and_no_farther():
    script = Script([AHEAD] * 40)

    told = driven(script)

    assert 41 == len(told.instants) == script.count
    assert Outcome.REACHED is told.outcome
    assert "so" == told.reason
    assert [None] * 40 == [instant.step.outcome for instant in told.instants[:-1]]
    assert math.isclose(4.0 / 60.0, told.minutes)
    assert all(instant.step_ms >= 0.0 for instant in told.instants)


def test_the_way_is_the_true_one():
    told = driven(Script([AHEAD] * 60 + [STOP] * 10))

    assert math.isclose(told.way, told.positions[-1, 0] - 1.0)
    assert 2.5 < told.way <= 3.0
    assert 0 == told.collisions


def test_contacts_are_counted_once_each():
    told = driven(Script([AHEAD] * 60), x=19.0)

    assert 1 == told.collisions


def test_places_found_again_are_counted():
    lost, located = Status.LOST, Status.LOCATED
    told = [(lost, 0), (located, 0), (lost, 1), (lost, 1), (located, 1), (lost, 2), (lost, 2)]

    told = driven(Script([STOP] * 6, outcome=Outcome.GAVE_UP, told=told))

    assert (2, 1) == (told.times_lost, told.times_recovered)


def test_a_drive_needs_a_step():
    with pytest.raises(ValueError, match="at least one step"):
        Drive(())


def test_a_room_is_as_large_as_its_longer_side_however_turned():
    turned = shapely.affinity.rotate(shapely.box(0, 0, 30, 2), 33.0)

    assert math.isclose(30.0, Destination((0.0, 0.0), turned).size)
    assert math.isclose(3.0, Destination((0.0, 0.0), turned).tolerance)
    assert 1.5 == Destination((0.0, 0.0), shapely.box(0, 0, 3, 4)).tolerance


@pytest.mark.parametrize(
    ("start_x", "point", "room", "outcome", "reached"),
    [
        (5.0, (6.4, 1.5), WEST, Outcome.REACHED, True),
        (5.0, (6.6, 1.5), WEST, Outcome.REACHED, False),  # too far off
        (9.5, (10.5, 1.5), EAST, Outcome.REACHED, False),  # near, but not in the room
        (5.0, (5.0, 1.5), WEST, Outcome.GAVE_UP, False),  # there, but does not know it
    ],
)
def test_a_goal_is_reached_in_its_room_near_its_mark_and_knowingly(start_x, point, room, outcome, reached):
    told = driven(Script([], outcome=outcome), x=start_x)

    scored = score(told, Destination(point, room), shortest=2.0)

    assert reached is scored.reached
    assert room.covers(shapely.Point(start_x, 1.5)) is scored.in_room
    assert math.isclose(abs(point[0] - start_x), scored.miss)
    assert 0.0 == scored.way == scored.way_ratio


def test_the_way_is_held_against_the_shortest():
    told = driven(Script([AHEAD] * 60))

    scored = score(told, Destination((4.0, 1.5), WEST), shortest=2.0)

    assert math.isclose(told.way / 2.0, scored.way_ratio)
    assert 61 == scored.steps
    assert 0.0 <= scored.ms_median <= scored.ms_p95


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


def test_a_world_without_free_space_is_refused():
    with pytest.raises(PilotageError, match="free space that walls enclose"):
        set_out(flat(), World(WORLD.segments[:1]), GOAL)


def test_a_place_may_be_known_without_a_heading():
    navigator, _ = set_out(flat(), WORLD, GOAL, start=(1.0, 6.0), world_start=START)
    x, y, headings = navigator.localizer.belief.states[:3]

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
            {"world_start": START, "start": Pose2(30.0, 30.0, 0.0)},
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
def test_what_cannot_be_driven_is_refused_before_anything_moves(drawing, goal, settings, error, message):
    with pytest.raises(error, match=message):
        set_out(drawing, WORLD, goal, **settings)
