"""Scan in, command out, in a small building whose drawing is known."""

import math
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from pilotage.evaluation.drive import Drive, drive
from pilotage.geometry import Polyline, Pose2, Twist
from pilotage.localization import AlignmentSettings, Localizer, LocalizerSettings, Status, TrackingSettings
from pilotage.maps import (
    AtlasSettings,
    NotEnclosedError,
    RangeTableSettings,
    RouteError,
    SchematicMap,
    build_atlas,
)
from pilotage.navigation import Behavior, Navigator, NavigatorSettings, Outcome
from pilotage.navigation.reckoning import twist_between
from pilotage.perception import Odometry
from pilotage.simulation import Door, LaserSettings, Person, Simulator, SimulatorSettings, World
from pilotage.simulation.body import rolled

ROOMS = (
    [(0, 0), (12, 0), (12, 9), (0, 9), (0, 0)],
    [(5, 0), (5, 2)],
    [(5, 3), (5, 6.5)],
    [(5, 7.5), (5, 9)],
    [(0, 5), (1, 5)],
    [(2, 5), (9, 5)],
    [(10, 5), (12, 5)],
    [(7.5, 5), (7.5, 6)],
)
"""Four rooms, each with a door to two others, none like another [m]."""
SMALL = LocalizerSettings(
    atlas=AtlasSettings(range_table=RangeTableSettings(cells=80, directions=60)),
    tracking=TrackingSettings(first_count=50_000, count=20_000),
    alignment=AlignmentSettings(proposals=4_000, kept=(1_000, 200)),
)
START = Pose2(2.5, 2.5, 0.0)
SEEING = SimulatorSettings()


def drawn(scale=(1.0, 1.0)):
    """Draw the rooms, so many units a metre across and up the sheet."""
    return SchematicMap(tuple(Polyline.through(np.array(stroke) * scale) for stroke in ROOMS))


SKETCH = drawn()
WORLD = World.of(SKETCH)
ATLAS = build_atlas(SKETCH, SMALL.atlas)
GRAPH = ATLAS.cell_graph


def localizer(drawing=ATLAS, start=START, **known):
    return Localizer(drawing, SMALL, start=start, **known)


def set_out(goal, world=WORLD, *, pilot=None, seed=0, simulator=SEEING, **settings):
    """Put the robot down, and tell it where if nothing else is said."""
    navigator = Navigator(pilot or localizer(seed=seed), goal, NavigatorSettings(**settings))
    return drive(navigator, Simulator(world, START, np.random.default_rng(seed), simulator))


def driven(*where, **how):
    return Drive(tuple(set_out(*where, **how)))


@pytest.fixture(scope="module")
def to_the_opposite_room():
    return driven((7.5, 7.5), time_limit=60.0)


def has_arrived(told, goal):
    return (
        told.outcome is Outcome.REACHED and told.collisions == 0 and math.dist(told.positions[-1], goal) < 1.0
    )


def gateway_between(first, second):
    """Name the gateway between the cells of two points."""
    cells = {GRAPH.cell_at(first), GRAPH.cell_at(second)}
    (found,) = (gateway.gateway_id for gateway in GRAPH.gateways if cells == set(gateway.cell_ids))
    return found


def test_a_robot_that_knows_its_start_drives_to_the_goal_and_touches_nothing(to_the_opposite_room):
    told = to_the_opposite_room

    assert has_arrived(told, (7.5, 7.5))
    assert GRAPH.cell_at((7.5, 7.5)) in told.reason
    assert 2.0 * 7.1 > told.way


def test_the_goal_is_reached_where_the_robot_stands_and_not_before(to_the_opposite_room):
    before, last = to_the_opposite_room.positions[-2:]

    assert 1e-3 > np.hypot(*(last - before))
    assert Behavior.REST is to_the_opposite_room.instants[-2].step.behavior


def test_each_step_tells_where_the_robot_is_and_where_it_goes(to_the_opposite_room):
    steps = [instant.step for instant in to_the_opposite_room.instants]

    assert {Behavior.CROSS, Behavior.GO_THROUGH} <= {step.behavior for step in steps}
    first, *_, last = [step for step in steps if step.target is not None]
    assert first.next_cell_id in {GRAPH.cell_at((7.5, 2.5)), GRAPH.cell_at((2.5, 7.5))}
    assert {first.estimate.cell_id, first.next_cell_id} == set(GRAPH.gateway(first.gateway_id).cell_ids)
    assert ("", "") == (last.next_cell_id, last.gateway_id)
    assert GRAPH.cell_at((7.5, 7.5)) == last.estimate.cell_id
    assert 1.0 > last.distance < first.distance < math.inf
    assert all(0.0 <= step.cell_belief <= 1.0 + 1e-9 for step in steps)
    assert 0.9 < steps[-1].cell_belief
    assert 1.0 > steps[-1].alignment_error


def test_the_robot_believes_itself_where_it_is(to_the_opposite_room):
    told = to_the_opposite_room
    believed = np.array([instant.step.estimate.sketch_from_base.pose.position for instant in told.instants])

    assert 1.0 > np.median(np.hypot(*(believed - told.positions).T))


@pytest.mark.parametrize("scale", [(0.02, 0.02), (36.0, 27.0)])
def test_the_drawing_may_be_of_any_scale_and_a_little_stretched(scale):
    start = Pose2(2.5 * scale[0], 2.5 * scale[1], 0.0)
    goal = (7.5 * scale[0], 2.5 * scale[1])
    told = driven(goal, pilot=localizer(drawn(scale), start), time_limit=60.0)

    assert has_arrived(told, (7.5, 2.5))


def test_a_closed_door_is_noticed_and_marked_and_another_way_is_taken():
    door = Door(np.array([5.0, 2.0, 5.0, 3.0]), ((0.0, math.inf),))
    goal = (8.5, 2.5)
    told = driven(goal, replace(WORLD, doors=(door,)), patience=2.0, time_limit=150.0)

    closed = gateway_between(START.position, goal)
    assert has_arrived(told, goal)
    assert any(closed in instant.step.closed_gateway_ids for instant in told.instants)
    marked = [instant.step for instant in told.instants if closed in instant.step.closed_gateway_ids]
    later = [step for step in marked if step.stamp > marked[0].stamp + 1.0]
    assert closed not in {step.gateway_id for step in later}


def test_a_thing_that_stands_on_the_goal_is_gone_up_to():
    crate = Polyline.through([(7.2, 2.2), (7.8, 2.2), (7.8, 2.8), (7.2, 2.8)], closed=True)
    told = driven((7.5, 2.5), World.of(SchematicMap((*SKETCH.strokes, crate))), time_limit=60.0)

    assert has_arrived(told, (7.5, 2.5))


def test_people_who_walk_through_the_door_are_not_touched():
    walker = Person(Polyline.through([(2.0, 2.5), (8.0, 2.5)]))
    told = driven((8.5, 2.5), replace(WORLD, people=(walker,)), time_limit=90.0)

    assert has_arrived(told, (8.5, 2.5))


def test_after_the_time_limit_the_robot_gives_up_and_says_why():
    told = driven((7.5, 7.5), time_limit=3.0)

    assert Outcome.GAVE_UP is told.outcome
    assert "3 s" in told.reason
    assert 3.0 == pytest.approx(told.instants[-1].step.stamp)


def test_once_a_drive_is_over_the_robot_brakes_and_rests():
    navigator = Navigator(localizer(), (7.5, 7.5), NavigatorSettings(time_limit=3.0))
    simulator = Simulator(WORLD, START, np.random.default_rng(0))
    steps = []
    for _ in range(45):
        reading = simulator.read()
        steps.append(navigator.step(reading.scan, reading.odometry))
        simulator.step(steps[-1].command)

    assert 0.1 < max(step.command.linear for step in steps)
    ended = [step for step in steps if step.outcome is not None]
    assert 3.0 == pytest.approx(ended[0].stamp)
    assert {(Behavior.REST, Outcome.GAVE_UP, 0.0)} == {
        (step.behavior, step.outcome, step.command.linear) for step in ended
    }
    assert 0.0 == simulator.twist.linear


def test_a_robot_that_does_not_know_where_it_is_and_looks_ahead_turns_round_first():
    ahead = SimulatorSettings(laser=LaserSettings(beams=181, field_of_view=math.pi))
    instants = list(islice(set_out((7.5, 7.5), pilot=localizer(start=None), simulator=ahead), 30))

    assert {Behavior.LOOK_AROUND} == {instant.step.behavior for instant in instants}
    assert Status.LOST is instants[0].step.estimate.status
    assert 0.02 > np.ptp(Drive(tuple(instants)).positions, axis=0).max()
    assert 1.0 < abs(instants[-1].scene.world_from_base.theta)


class Forgetful(Localizer):
    """Is not sure of any place for ten seconds."""

    def update(self, scan, odometry):
        estimate = super().update(scan, odometry)
        if not 2.0 <= scan.stamp < 12.0:
            return estimate
        places = tuple(replace(place, probability=0.1) for place in estimate.hypotheses)
        return replace(estimate, hypotheses=places)


def test_a_robot_explores_while_it_knows_no_place_and_drives_on_once_it_does():
    pilot = Forgetful(ATLAS, SMALL, start=START)
    steps = [instant.step for instant in islice(set_out((8.5, 7.0), pilot=pilot), 150)]

    exploring = {step.behavior for step in steps if 3.0 < step.stamp < 12.0}
    after = {step.behavior for step in steps if step.stamp > 13.0}
    assert Behavior.EXPLORE in exploring
    assert Behavior.CROSS not in exploring
    assert after <= {Behavior.CROSS, Behavior.GO_THROUGH, Behavior.WAIT, Behavior.REST}
    assert all(() == step.closed_gateway_ids for step in steps)


def test_equal_seeds_give_equal_steps_and_others_do_not():
    runs = [
        [instant.step for instant in islice(set_out((7.5, 7.5), pilot=localizer(start=None, seed=seed)), 25)]
        for seed in (3, 3, 4)
    ]

    assert runs[0] == runs[1]
    assert runs[0] != runs[2]


def test_a_goal_in_a_wall_is_refused_before_anything_moves():
    block = Polyline.through([(3, 3), (17, 3), (17, 7), (3, 7), (3, 3)])
    outside = Polyline.through([(0, 0), (20, 0), (20, 10), (0, 10), (0, 0)])
    ring = localizer(SchematicMap((outside, block)), Pose2(1.5, 1.5, 0.0))

    with pytest.raises(RouteError, match="goal lies in a wall"):
        Navigator(ring, (10.0, 5.0))
    with pytest.raises(RouteError, match="goal lies outside the drawing"):
        Navigator(ring, (30.0, 5.0))


def test_a_drawing_without_cells_cannot_be_driven_by():
    stroke = SchematicMap((Polyline.through([(0, 0), (8, 0), (8, 3)]),))

    with pytest.raises(NotEnclosedError, match="has no cells"):
        Navigator(localizer(stroke, None), (1.0, 1.0))


@pytest.mark.parametrize("twist", [Twist(0.6, 0.0), Twist(0.5, -0.8), Twist(-0.3, 0.4), Twist(0.0, 1.0)])
def test_how_the_robot_moves_is_read_off_its_wheels(twist):
    before = Odometry(4.0, Pose2(3.0, -2.0, 2.5))
    now = Odometry(4.1, before.odom_from_base @ rolled(twist, 0.1))

    told = twist_between(before, now)
    assert twist.linear == pytest.approx(told.linear, rel=0.01)
    assert twist.angular == pytest.approx(told.angular)
    assert Twist(0.0, 0.0) == twist_between(now, now)


@pytest.mark.parametrize("name", ["radius", "time_limit", "plan_every", "patience"])
def test_settings_are_positive(name):
    with pytest.raises(ValueError, match=f"{name} must be > 0"):
        NavigatorSettings(**{name: math.nan})


def test_a_probability_to_act_on_is_a_share():
    with pytest.raises(ValueError, match=r"act_on must be in \[0, 1\], got 3.0"):
        NavigatorSettings(act_on=3.0)
