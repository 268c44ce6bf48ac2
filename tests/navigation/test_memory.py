"""What the robot keeps from plan to plan: each input changes in one place."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from knowing import estimate_at
from pilotage.geometry import Pose2
from pilotage.localization import BlockedWay, Status
from pilotage.maps import Route
from pilotage.navigation.arrival import Arrival, Doubt
from pilotage.navigation.memory import DETOUR, Memory
from pilotage.navigation.plan import Plan
from pilotage.navigation.route_leg import RouteLeg
from pilotage.navigation.settings import NavigatorSettings
from pilotage.navigation.step import Behavior
from pilotage.perception import LaserScan

SETTINGS = NavigatorSettings(patience=4.0)
STEP = 0.3  # [s] between plans
PATH = np.array([[0.0, 0.0], [2.0, 0.0]])
LEG = RouteLeg(
    Route(("c1", "c2"), ("g1",), 0.1, PATH), PATH, np.array([3.0, 0.0]), "g1", np.array([2.0, 0.0])
)
FRESH = Memory()
WHERE = Arrival(1, Doubt.WHERE_IN_IT, math.inf)


def standing(turned=0.0, **claim):
    """Stand at the origin and claim something."""
    return SimpleNamespace(
        turned=turned, estimate=estimate_at(0.0, 0.0, **claim), odom_from_base=Pose2.identity()
    )


def lasting(plan, seconds, memory=FRESH, position=None, step=STEP):
    """Make the same plan again every `step` seconds, and stay where the robot is."""
    for k in range(round(seconds / step)):
        made = replace(plan, stamp=(k - 1) * step)
        memory = memory.updated(made, k * step, position or standing(), SETTINGS)
    return memory


def test_a_stall_on_the_route_blocks_the_gateway_ahead_and_makes_the_robot_explore():
    memory = lasting(Plan(Behavior.CROSS, path=PATH, leg=LEG), 4.5)

    assert ("g1",) == memory.blocked.gateway_ids
    assert 1 == memory.detours
    assert 4.0 + DETOUR <= memory.detour_until < 4.5 + DETOUR


@pytest.mark.parametrize("step", [0.1, 0.3, 0.5])
def test_the_time_near_a_gateway_is_counted_in_seconds_however_often_plans_are_made(step):
    near = replace(LEG, middle=np.array([1.0, 0.0]))
    memory = lasting(Plan(Behavior.CROSS, path=PATH, leg=near), 3.0, step=step)

    assert memory.blocked.time_near["g1"] == pytest.approx(3.0)


def test_a_new_goal_keeps_what_is_blocked_and_forgets_how_long_the_robot_was_near_the_others():
    near = replace(LEG, middle=np.array([1.0, 0.0]))
    memory = lasting(Plan(Behavior.CROSS, path=PATH, leg=near), 3.0)
    memory = memory.with_blocked(replace(memory.blocked, since={"g7": 1.0})).for_new_goal(3.0)

    assert {"g7": 1.0} == memory.blocked.since
    assert {} == memory.blocked.time_near


def test_a_stall_while_exploring_gives_the_frontier_up():
    memory = lasting(Plan(Behavior.EXPLORE, path=PATH), 4.5)

    assert [[2.0, 0.0]] == memory.exploration.unreachable.tolist()
    assert () == memory.blocked.gateway_ids


@pytest.mark.parametrize("behavior", [Behavior.BACK_OUT, Behavior.LOOK_AROUND])
def test_a_frontier_gets_its_time_after_a_stall_in_which_there_was_none(behavior):
    stalled = lasting(Plan(behavior), 4.5)
    memory = stalled
    for k in range(5):
        memory = memory.updated(Plan(Behavior.EXPLORE, path=PATH), 4.5 + k * STEP, standing(), SETTINGS)

    assert 0 == len(memory.exploration.unreachable)


def test_a_stall_while_driving_on_ends_the_doubt():
    plan, memory = Plan(Behavior.DRIVE_ON, path=PATH), Memory(arrival=WHERE)

    at = {"position": standing(position_std=2.0)}
    assert Doubt.WHERE_IN_IT is lasting(plan, 3.0, memory, **at).arrival.doubt
    assert Doubt.NONE is lasting(plan, 5.0, memory, **at).arrival.doubt


@pytest.mark.parametrize("behavior", [Behavior.REST, Behavior.LOOK_AROUND, Behavior.BACK_OUT])
def test_standing_where_nothing_was_tried_changes_nothing(behavior):
    memory = lasting(Plan(behavior), 20.0)

    assert (0, ()) == (memory.detours, memory.blocked.gateway_ids)
    assert 0 == len(memory.exploration.unreachable)


def test_the_target_is_the_end_of_the_path_while_the_robot_explores():
    exploring = Memory().updated(Plan(Behavior.EXPLORE, path=PATH), 0.0, standing(), SETTINGS)
    following = exploring.updated(Plan(Behavior.CROSS, path=PATH, leg=LEG), 0.3, standing(), SETTINGS)

    assert [2.0, 0.0] == exploring.exploration.target.tolist()
    assert following.exploration.target is None


def test_a_doubt_is_kept_and_lets_a_robot_that_does_not_see_all_around_turn():
    doubting = Plan(Behavior.LOOK_AROUND, arrival=WHERE)
    memory = Memory(unseen_angle=3.0).updated(doubting, 0.0, standing(turned=2.0), SETTINGS)

    assert memory.arrival == WHERE
    assert math.isclose(5.0, memory.look_until)


def test_a_doubt_ends_where_nothing_leads_on():
    memory = Memory(arrival=WHERE)
    followed = memory.updated(Plan(Behavior.CROSS, path=PATH, leg=LEG), 0.0, standing(), SETTINGS)

    assert Doubt.NONE is followed.arrival.doubt


@pytest.mark.parametrize("found", [{}, {"status": Status.MISMATCH}])
def test_a_mismatch_is_timed_from_its_beginning_and_forgotten_once_a_place_is_known(found):
    wrong, right = standing(status=Status.MISMATCH, probability=0.4), standing(**found)
    plan = Plan(Behavior.EXPLORE, path=PATH)
    memory = Memory().updated(plan, 5.0, wrong, SETTINGS).updated(plan, 6.0, wrong, SETTINGS)

    assert 5.0 == memory.mismatch_since
    assert math.inf == memory.updated(plan, 7.0, right, SETTINGS).mismatch_since


@pytest.mark.parametrize(("beams", "unseen"), [(181, math.pi), (360, 0.0)])
def test_a_robot_that_begins_lost_turns_by_what_its_scanner_leaves_out(beams, unseen):
    scan = LaserScan(1.0, 0.0, math.radians(1.0), np.ones(beams))
    known, lost = estimate_at(0.0, 0.0), replace(estimate_at(0.0, 0.0), status=Status.LOST)

    assert unseen == pytest.approx(Memory.at_start(scan, lost).look_until)
    assert 0.0 == Memory.at_start(scan, known).look_until


@pytest.mark.parametrize(("waypoint", "is_told"), [([5.0, 0.0], True), ([2.2, 0.0], False)])
def test_a_stall_before_a_waypoint_tells_of_a_blocked_way_once(waypoint, is_told):
    plan = Plan(Behavior.CROSS, path=PATH, leg=LEG, waypoint=np.array(waypoint))
    told = []
    memory = FRESH
    for k in range(20):
        memory = memory.updated(replace(plan, stamp=(k - 1) * STEP), k * STEP, standing(), SETTINGS)
        told += [memory.blocked_way] if memory.blocked_way else []

    assert told == ([BlockedWay((2.0, 0.0), (5.0, 0.0))] if is_told else [])
