import math

import numpy as np
import pytest
import shapely

from knowing import estimate_at
from pilotage.drives import Drive, drive
from pilotage.evaluation.drive import Destination, score
from pilotage.geometry import Polyline, Pose2, Twist
from pilotage.localization import Status
from pilotage.maps import SchematicMap
from pilotage.navigation import Behavior, Goal, Outcome, Step
from pilotage.simulation import Simulator, World

HALL = World(np.array([[0, 0, 20, 0], [20, 0, 20, 3], [20, 3, 0, 3], [0, 3, 0, 0]], dtype=np.float64))
DRAWN = SchematicMap((Polyline.through([(0, 0), (20, 0), (20, 3), (0, 3)], closed=True),))
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
        estimate = estimate_at(0.0, 0.0, stamp=scan.stamp, status=status)
        command = self.commands[self.count]
        self.count += 1
        outcome = self.outcome if self.count == len(self.commands) else None
        return Step(
            scan.stamp, command, Behavior.CROSS, estimate, times_lost=times_lost, outcome=outcome, reason="so"
        )


def driven(script, x=1.0):
    instants = list(drive(script, Simulator(HALL, Pose2(x, 1.5, 0.0), np.random.default_rng(0))))
    steps, scenes = [one.step for one in instants], [one.scene for one in instants]
    return Drive(DRAWN, HALL, Goal((5.0, 1.5), "cell-1"), steps, scenes, [one.step_ms for one in instants])


def test_a_drive_goes_on_until_its_outcome_and_no_farther():
    script = Script([AHEAD] * 40)

    told = driven(script)

    assert 41 == len(told.steps) == script.count
    assert Outcome.REACHED is told.outcome
    assert "so" == told.reason
    assert [None] * 40 == [step.outcome for step in told.steps[:-1]]
    assert math.isclose(4.0 / 60.0, told.minutes)
    assert all(ms >= 0.0 for ms in told.step_ms)


def test_the_length_is_the_true_one():
    told = driven(Script([AHEAD] * 60 + [STOP] * 10))

    assert math.isclose(told.length, told.positions[-1, 0] - 1.0)
    assert 2.5 < told.length <= 3.0
    assert 0 == told.collisions


def test_contacts_are_counted_once_each():
    told = driven(Script([AHEAD] * 60), x=19.0)

    assert 1 == told.collisions


def test_places_found_again_are_counted():
    lost, located = Status.LOST, Status.LOCATED
    told = [(lost, 0), (located, 0), (lost, 1), (lost, 1), (located, 1), (lost, 2), (lost, 2)]

    told = driven(Script([STOP] * 6, outcome=Outcome.GAVE_UP, told=told))

    assert (2, 1) == (told.times_lost, told.times_recovered)


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


def test_the_length_is_compared_with_the_shortest():
    told = driven(Script([AHEAD] * 60))

    scored = score(told, Destination((4.0, 1.5), WEST), shortest=2.0)

    assert math.isclose(told.length / 2.0, scored.way_ratio)
    assert 61 == scored.steps
    assert 0.0 <= scored.ms_median <= scored.ms_p95


def test_a_goal_by_name_is_reached_anywhere_in_its_room():
    told = driven(Script([]), x=1.0)

    assert score(told, Destination((9.0, 1.5), WEST, is_room=True), shortest=2.0).reached
    assert not score(told, Destination((9.0, 1.5), WEST), shortest=2.0).reached
    assert not score(told, Destination((11.0, 1.5), EAST, is_room=True), shortest=2.0).reached


def test_a_mismatch_is_no_goal_reached():
    told = driven(Script([], outcome=Outcome.MISMATCH), x=5.0)
    scored = score(told, Destination((5.0, 1.5), WEST, is_room=True), shortest=2.0)

    assert not scored.reached
    assert "mismatch" == scored.outcome
