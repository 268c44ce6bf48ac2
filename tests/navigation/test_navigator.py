"""Scan in, command out: small drives with a localizer that knows where the robot is."""

import math
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from buildings import coarse
from four_rooms import ATLAS, EXACT, GRAPH, KITCHEN, SEEING, SKETCH, START, WORLD, drawn
from knowing import KnowingLocalizer, with_leading
from pilotage.drives import drive
from pilotage.drives.record import Drive
from pilotage.geometry import Polyline, Pose2
from pilotage.localization import Status
from pilotage.maps import NotEnclosedError, RouteError, SchematicMap, Zones, build_atlas
from pilotage.navigation import Behavior, Navigator, NavigatorSettings, Outcome, Tour
from pilotage.simulation import (
    Door,
    LaserSettings,
    Person,
    Simulator,
    SimulatorSettings,
    World,
)

DOOR_SHUT = replace(WORLD, doors=(Door(np.array([5.0, 2.0, 5.0, 3.0]), ((0.0, math.inf),)),))
"""The door between the first room and the kitchen is shut all the time."""


def knowing(changed=lambda estimate: estimate):
    return KnowingLocalizer(ATLAS, START, changed=changed)


def set_out(goal, world=WORLD, *, localizer=None, simulator=SEEING, **settings):
    """Put the robot down; it knows where if nothing else is said."""
    navigator = Navigator(localizer or knowing(), goal, NavigatorSettings(**settings))
    return drive(navigator, Simulator(world, START, np.random.default_rng(0), simulator))


def recorded(navigator, instants, world=WORLD):
    return Drive.of(navigator.planner.atlas, world, navigator.planner.goal, instants)


def driven(goal, world=WORLD, *, localizer=None, simulator=SEEING, **settings):
    navigator = Navigator(localizer or knowing(), goal, NavigatorSettings(**settings))
    instants = list(drive(navigator, Simulator(world, START, np.random.default_rng(0), simulator)))
    return recorded(navigator, instants, world)


@pytest.fixture(scope="module")
def to_the_opposite_room():
    return driven((7.5, 7.5), time_limit=60.0)


@pytest.fixture(scope="module")
def through_the_kitchen():
    return driven((9.5, 2.5))


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
    assert 7.0 < told.length < 2.0 * 7.1


def test_the_goal_is_reached_where_the_robot_stands_and_not_before(to_the_opposite_room):
    before, last = to_the_opposite_room.positions[-2:]

    assert 1e-3 > np.hypot(*(last - before))
    assert Behavior.REST is to_the_opposite_room.steps[-2].behavior


def test_each_step_tells_where_the_robot_is_and_where_it_goes(to_the_opposite_room):
    steps = to_the_opposite_room.steps

    assert {Behavior.CROSS, Behavior.GO_THROUGH} <= {step.behavior for step in steps}
    first, *_, last = [step for step in steps if step.target is not None]
    assert first.next_cell_id in {GRAPH.cell_at((7.5, 2.5)), GRAPH.cell_at((2.5, 7.5))}
    assert {first.estimate.cell_id, first.next_cell_id} == set(GRAPH.gateway(first.gateway_id).cell_ids)
    assert ("", "") == (last.next_cell_id, last.gateway_id)
    assert GRAPH.cell_at((7.5, 7.5)) == last.estimate.cell_id
    assert 1.0 > last.distance < first.distance < math.inf


@pytest.mark.parametrize("scale", [0.02, 36.0])
def test_the_drawing_may_be_of_any_scale(scale):
    atlas = build_atlas(drawn((scale, scale)), coarse(80, 60))
    told = driven(
        (7.5 * scale, 2.5 * scale), localizer=KnowingLocalizer(atlas, START, scale=scale), time_limit=60.0
    )

    assert has_arrived(told, (7.5, 2.5))


def test_a_closed_door_is_noticed_and_marked_and_another_way_is_taken():
    goal, localizer = (8.5, 2.5), knowing()
    told = driven(goal, DOOR_SHUT, localizer=localizer, patience=2.0, time_limit=150.0)

    closed = gateway_between(START.position, goal)
    assert has_arrived(told, goal)
    assert any(closed in step.closed_gateway_ids for step in told.steps)
    marked = [step for step in told.steps if closed in step.closed_gateway_ids]
    later = [step for step in marked if step.stamp > marked[0].stamp + 1.0]
    assert closed not in {step.gateway_id for step in later}
    assert 1.3 == pytest.approx(math.hypot(*localizer.blocked[0].end), abs=0.3)  # a metre behind the door


@pytest.mark.parametrize("length", [0.0, 0.6])
def test_a_jump_of_odometry_turns_the_robot_no_faster_than_it_may(length):
    settings = NavigatorSettings(length=length)
    navigator = Navigator(knowing(), (7.5, 7.5), settings)
    simulator = Simulator(WORLD, START, np.random.default_rng(0), SEEING)
    for instant in islice(drive(navigator, simulator), 20):
        assert instant.step.outcome is None
    reading = simulator.read()
    jumped = replace(reading.odometry, odom_from_base=reading.odometry.odom_from_base @ Pose2(0.5, 0.0, 2.0))
    command = navigator.step(reading.scan, replace(jumped, stamp=jumped.stamp + 0.1)).command

    assert settings.steering.turn_rate >= abs(command.angular)
    assert settings.steering.speed >= abs(command.linear)


def test_a_keep_out_zone_is_no_way_that_the_robot_found_blocked():
    localizer = zoned(keep_out=(square(0.1, 8.0, 1.0, 8.9),))
    driven((8.5, 2.5), DOOR_SHUT, localizer=localizer, patience=2.0, time_limit=20.0)

    assert [] == localizer.blocked


def test_a_thing_that_stands_on_the_goal_is_gone_up_to():
    crate = Polyline.through([(7.2, 2.2), (7.8, 2.2), (7.8, 2.8), (7.2, 2.8)], closed=True)
    told = driven((7.5, 2.5), World.of(SchematicMap((*SKETCH.strokes, crate))), time_limit=60.0)

    assert has_arrived(told, (7.5, 2.5))


ACROSS_THE_KITCHEN = World.of(SchematicMap((*SKETCH.strokes, Polyline.through([(10.05, 0.0), (10.05, 5.0)]))))
"""A wall that is not drawn; the goal beyond it is out of reach."""


def test_where_no_way_leads_on_the_robot_tries_others_and_stops_as_near_as_it_can():
    told = driven((11.7, 2.5), ACROSS_THE_KITCHEN, patience=2.0, time_limit=200.0)

    assert Outcome.REACHED is told.outcome
    assert 0 == told.collisions
    assert "as near as the robot can come" in told.reason
    assert 3.0 > math.dist(told.positions[-1], (11.7, 2.5))
    assert Behavior.EXPLORE in {step.behavior for step in told.steps}


def test_a_room_is_not_reached_from_outside_however_often_the_robot_tries():
    shut = replace(WORLD, doors=(*DOOR_SHUT.doors, Door(np.array([9.0, 5.0, 10.0, 5.0]), ((0.0, math.inf),))))
    told = driven("kitchen", shut, patience=2.0, time_limit=150.0)

    assert Outcome.GAVE_UP is told.outcome
    assert 5.0 < told.length
    found_shut = {gateway_id for step in told.steps for gateway_id in step.closed_gateway_ids}
    assert {gateway.gateway_id for gateway in GRAPH.gateways_of(KITCHEN)} <= found_shut


def test_people_who_walk_through_the_door_are_not_touched():
    walker = Person(Polyline.through([(2.0, 2.5), (8.0, 2.5)]))
    told = driven((8.5, 2.5), replace(WORLD, people=(walker,)), time_limit=90.0)

    assert has_arrived(told, (8.5, 2.5))


def test_after_the_time_limit_the_robot_gives_up_and_says_why():
    told = driven((7.5, 7.5), time_limit=3.0)

    assert Outcome.GAVE_UP is told.outcome
    assert "3 s" in told.reason
    assert 3.0 == pytest.approx(told.steps[-1].stamp)


def test_once_a_drive_is_over_the_robot_brakes_and_rests():
    navigator = Navigator(knowing(), (7.5, 7.5), NavigatorSettings(time_limit=3.0))
    simulator = Simulator(WORLD, START, np.random.default_rng(0), SEEING)
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


def astray(estimate):
    return with_leading(replace(estimate, status=Status.MISMATCH), probability=0.1)


def lost(estimate):
    return with_leading(replace(estimate, status=Status.LOST), probability=0.1)


def test_a_robot_that_does_not_know_where_it_is_and_looks_ahead_turns_round_first():
    ahead = SimulatorSettings(laser=LaserSettings(beams=181, field_of_view=math.pi), odometry=EXACT)
    instants = list(islice(set_out((7.5, 7.5), localizer=knowing(lost), simulator=ahead), 30))

    assert {Behavior.LOOK_AROUND} == {instant.step.behavior for instant in instants}
    assert Status.LOST is instants[0].step.estimate.status
    positions = np.array([instant.scene.world_from_base.position for instant in instants])
    assert 0.02 > np.ptp(positions, axis=0).max()
    assert 1.0 < abs(instants[-1].scene.world_from_base.theta)


def test_a_robot_explores_while_it_knows_no_place_and_drives_on_once_it_does():
    forgetful = knowing(lambda estimate: lost(estimate) if 2.0 <= estimate.stamp < 12.0 else estimate)
    steps = [instant.step for instant in islice(set_out((8.5, 7.0), localizer=forgetful), 150)]

    exploring = {step.behavior for step in steps if 3.0 < step.stamp < 12.0}
    after = {step.behavior for step in steps if step.stamp > 13.0}
    assert Behavior.EXPLORE in exploring
    assert Behavior.CROSS not in exploring
    assert after <= {Behavior.CROSS, Behavior.GO_THROUGH, Behavior.WAIT, Behavior.REST}
    assert all(() == step.closed_gateway_ids for step in steps)


def test_a_goal_by_name_is_reached_inside_its_room_and_need_not_be_crossed():
    told = driven("kitchen", time_limit=60.0)

    assert Outcome.REACHED is told.outcome
    assert "'kitchen'" in told.reason
    assert KITCHEN == GRAPH.cell_at(tuple(told.positions[-1]))
    assert 0.5 <= told.positions[-1, 0] - 5.0 < 1.5
    assert driven((8.0, 2.5), time_limit=60.0).length > told.length + 1.0


def test_a_table_where_the_name_stands_keeps_no_robot_out_of_the_room():
    x, y = GRAPH.cell(KITCHEN).center
    table = Polyline.through([(x - 1, y - 1), (x + 1, y - 1), (x + 1, y + 1), (x - 1, y + 1)], closed=True)
    told = driven("kitchen", World.of(SchematicMap((*SKETCH.strokes, table))), time_limit=60.0)

    assert Outcome.REACHED is told.outcome
    assert KITCHEN == GRAPH.cell_at(tuple(told.positions[-1]))


def test_a_robot_that_stands_in_the_room_already_need_not_move():
    told = driven(GRAPH.cell(KITCHEN).label, localizer=KnowingLocalizer(ATLAS, Pose2(8.0, 1.5, 0.0)))

    assert Outcome.REACHED is told.outcome
    assert 0.0 == told.length


@pytest.mark.parametrize("goal", ["kitchen", (8.0, 2.5)])
def test_a_robot_that_is_not_sure_of_the_place_does_not_stop_there(goal):
    def doubting(estimate):
        return with_leading(replace(estimate, cell_probability=0.6), probability=0.6)

    told = driven(goal, localizer=knowing(doubting), time_limit=16.0)

    assert Outcome.GAVE_UP is told.outcome
    assert Behavior.EXPLORE in {step.behavior for step in told.steps}


def test_a_robot_that_is_not_sure_where_in_the_place_drives_on_along_the_doubt():
    def along(estimate):
        return with_leading(estimate, position_std=1.0, position_axis=(0.0, 1.0))

    told = driven((8.0, 2.5), localizer=knowing(along), time_limit=60.0)
    onward = [k for k, step in enumerate(told.steps) if step.behavior is Behavior.DRIVE_ON]

    assert onward
    travelled = np.abs(np.diff(told.positions[onward[0] : onward[0] + 20], axis=0)).sum(axis=0)
    assert travelled[1] > travelled[0]
    assert Outcome.REACHED is told.outcome


@pytest.mark.parametrize("goal", ["kitchen", (8.0, 2.5), (2.5, 2.5)])
def test_a_drawing_that_does_not_fit_is_given_up_and_its_goal_never_reached(goal):
    told = driven(goal, localizer=knowing(astray), mismatch_patience=12.0, time_limit=60.0)

    assert Outcome.MISMATCH is told.outcome
    assert "this drawing does not fit this building" == told.reason
    assert 12.0 <= told.times[-1] < 13.0
    assert 1.0 < told.length
    assert {Behavior.CROSS, Behavior.GO_THROUGH}.isdisjoint(step.behavior for step in told.steps)


def test_a_place_that_is_sure_is_acted_on_though_the_drawing_fits_badly():
    mismatch = knowing(lambda estimate: replace(estimate, status=Status.MISMATCH))
    told = driven((8.0, 2.5), localizer=mismatch, mismatch_patience=2.0, time_limit=60.0)

    assert has_arrived(told, (8.0, 2.5))
    assert told.reason.endswith("is reached, though the drawing fits badly")


def test_a_mismatch_that_passes_is_forgotten():
    def passing(estimate):
        return astray(estimate) if 2.0 <= estimate.stamp < 8.0 else estimate

    told = driven((8.0, 2.5), localizer=knowing(passing), mismatch_patience=7.0, time_limit=60.0)

    assert Outcome.REACHED is told.outcome


def test_equal_drives_are_equal():
    first, second = (
        [instant.step for instant in islice(set_out((7.5, 7.5), localizer=knowing(lost)), 40)]
        for _ in range(2)
    )

    for one, other in zip(first, second, strict=True):
        assert (one.command, one.behavior, one.target) == (other.command, other.behavior, other.target)


def test_a_gateway_that_the_drawing_does_not_have_is_rejected_before_anything_moves():
    with pytest.raises(ValueError, match="blocked must hold ids of gateways of this drawing, got g99"):
        Navigator(knowing(), (7.5, 7.5), blocked=("g99",))


def test_a_goal_in_a_wall_is_rejected_before_anything_moves():
    block = Polyline.through([(3, 3), (17, 3), (17, 7), (3, 7), (3, 3)])
    outside = Polyline.through([(0, 0), (20, 0), (20, 10), (0, 10), (0, 0)])
    ring = KnowingLocalizer(build_atlas(SchematicMap((outside, block)), coarse()), START)

    with pytest.raises(RouteError, match="goal lies in a wall"):
        Navigator(ring, (10.0, 5.0))
    with pytest.raises(RouteError, match="goal lies outside the drawing"):
        Navigator(ring, (30.0, 5.0))


def test_a_drawing_without_cells_cannot_be_driven_by():
    stroke = SchematicMap((Polyline.through([(0, 0), (8, 0), (8, 3)]),))

    with pytest.raises(NotEnclosedError, match="no closed room"):
        Navigator(KnowingLocalizer(build_atlas(stroke, coarse()), START), (1.0, 1.0))


@pytest.mark.parametrize("name", ["radius", "time_limit", "near", "patience"])
def test_settings_are_positive(name):
    with pytest.raises(ValueError, match=f"{name} must be > 0"):
        NavigatorSettings(**{name: math.nan})


@pytest.mark.parametrize("name", ["radius", "near", "patience"])
def test_sizes_and_patience_are_finite(name):
    with pytest.raises(ValueError, match=f"{name} must be > 0 and finite"):
        NavigatorSettings(**{name: math.inf})


@pytest.mark.parametrize("name", ["blocked_for", "mismatch_patience"])
def test_times_are_not_negative(name):
    with pytest.raises(ValueError, match=f"{name} must be >= 0 s"):
        NavigatorSettings(**{name: -1.0})


@pytest.mark.parametrize("name", ["act_on", "sure"])
def test_a_probability_is_a_share(name):
    with pytest.raises(ValueError, match=rf"{name} must be in \[0, 1\], got 3.0"):
        NavigatorSettings(**{name: 3.0})


def test_a_robot_that_has_arrived_drives_to_another_goal_if_it_is_told_to():
    navigator = Navigator(knowing(), (3.5, 2.5), NavigatorSettings())
    simulator = Simulator(WORLD, START, np.random.default_rng(0), SEEING)
    assert Outcome.REACHED is list(drive(navigator, simulator))[-1].step.outcome

    with pytest.raises(RouteError):
        navigator.set_goal("attic")
    navigator.set_goal("kitchen")
    instants = list(drive(navigator, simulator))

    assert Outcome.REACHED is instants[-1].step.outcome
    assert KITCHEN == instants[-1].step.estimate.cell_id
    assert 5.0 < instants[-1].scene.world_from_base.x


def test_goals_are_visited_in_order_and_the_way_leads_back():
    tour = Tour(("kitchen", (7.5, 7.5)), returns=True)
    told = driven(tour, time_limit=60.0)
    visits = told.steps[-1].visits

    assert [Outcome.REACHED] * 3 == [visit.outcome for visit in visits]
    assert "3 of 3 goals are reached" == told.reason
    assert Outcome.REACHED is told.outcome
    for visit, place in zip(visits, ((8.0, 2.5), (7.5, 7.5), START.position), strict=True):
        assert GRAPH.cell_at(place) == GRAPH.cell_at(told.positions[told.step_at(visit.stamp)])
    assert 0.5 > np.hypot(*(told.positions[-1] - START.position))
    assert 0 == told.collisions


def test_a_sure_robot_finds_back_although_the_drawing_fits_badly():
    mismatch = knowing(lambda estimate: replace(estimate, status=Status.MISMATCH))
    told = driven(Tour(("kitchen",), returns=True), localizer=mismatch, time_limit=60.0)

    assert [Outcome.REACHED] * 2 == [visit.outcome for visit in told.steps[-1].visits]
    assert 0.5 > np.hypot(*(told.positions[-1] - START.position))


def test_a_goal_that_is_not_reached_in_its_time_is_left_out_and_told():
    told = driven(["kitchen", (2.5, 7.0)], time_limit=3.0)

    assert Outcome.GAVE_UP is told.outcome
    missed = "the goal was not reached within 3 s"
    assert told.reason == f"0 of 2 goals are reached; kitchen: {missed}; 2.5,7: {missed}"
    assert [3, 6] == [round(visit.stamp - told.steps[0].stamp) for visit in told.steps[-1].visits]


def test_all_goals_of_a_tour_must_be_on_the_drawing():
    with pytest.raises(RouteError, match="attic"):
        Navigator(knowing(), ["kitchen", "attic"])
    with pytest.raises(ValueError, match="at least one goal"):
        Navigator(knowing(), [])


def test_a_round_is_driven_again_and_again():
    told = driven(Tour(("kitchen", (4.0, 2.5)), rounds=2), time_limit=60.0)

    assert ["kitchen", (4.0, 2.5)] * 2 == [visit.goal for visit in told.steps[-1].visits]
    assert Outcome.REACHED is told.outcome
    assert {()} == {step.closed_gateway_ids for step in told.steps}  # the door was passed, not stayed near


def square(left, bottom, right, top):
    return Polyline(np.array([(left, bottom), (right, bottom), (right, top), (left, top)]), closed=True)


def zoned(**zones):
    atlas = replace(ATLAS, sketch=replace(SKETCH, zones=Zones(**zones)))
    return KnowingLocalizer(atlas, START)


def test_a_keep_out_zone_is_driven_around(through_the_kitchen):
    zone = square(2.0, 2.0, 8.0, 2.9)
    told = driven((9.5, 3.8), localizer=zoned(keep_out=(zone,)))
    freely, kept_out = (
        [all((4.0, 2.1) <= at) and all(at <= (7.9, 2.8)) for at in one.positions]
        for one in (through_the_kitchen, told)
    )

    assert any(freely)
    assert has_arrived(told, (9.5, 3.8))
    assert not any(kept_out)


def test_in_a_slow_zone_the_robot_drives_at_half_its_speed(through_the_kitchen):
    told = driven((9.5, 2.5), localizer=zoned(slow=(square(4.0, 1.0, 9.0, 4.0),)))
    speeds = [
        [step.command.linear for step, at in zip(one.steps, one.positions, strict=True) if 5.0 < at[0] < 8.0]
        for one in (through_the_kitchen, told)
    ]

    assert has_arrived(told, (9.5, 2.5))
    assert 0.8 == pytest.approx(max(speeds[0]))
    assert 0.4 == pytest.approx(max(speeds[1]))


def test_a_goal_in_a_keep_out_zone_is_refused():
    with pytest.raises(RouteError, match="keep-out zone"):
        Navigator(zoned(keep_out=(square(7.0, 2.0, 9.0, 3.0),)), (8.0, 2.5))
