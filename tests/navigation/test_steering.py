"""From a path to a command among obstacles, from which the robot can always stop."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pilotage.geometry import Pose2, Twist
from pilotage.navigation.braking import SteeringSettings
from pilotage.navigation.local_grid import CLEARANCE
from pilotage.navigation.steering import steer, turn_on_the_spot
from pilotage.simulation import BodySettings
from pilotage.simulation.body import rolled
from strategies import angles

BODY, SETTINGS = BodySettings(), SteeringSettings()
TIME_STEP = 0.1
NOTHING = np.empty((0, 2))
AHEAD = np.column_stack([np.linspace(0.0, 5.0, 101), np.zeros(101)])
STILL = Twist(0.0, 0.0)


def along(*corners):
    """Points every 4 cm along a path or a wall."""
    pieces = []
    for start, end in itertools.pairwise(np.array(corners, dtype=float)):
        count = max(2, math.ceil(np.hypot(*(end - start)) / 0.04))
        pieces.append(start + np.linspace(0.0, 1.0, count)[:, np.newaxis] * (end - start))
    return np.vstack(pieces)


def obey(path, obstacles, start, *, seconds, moving=STILL, how=SETTINGS):
    """Drive along a path among obstacles, both in the world; poses and twists ten times a second."""
    pose, now = start, moving
    for _ in range(round(seconds / TIME_STEP)):
        in_base = pose.inverse() @ path
        passed = int(np.hypot(*in_base.T).argmin())
        command = steer(in_base[passed:], pose.inverse() @ obstacles, BODY.radius, how, now)
        now = BODY.obeyed(now, command, TIME_STEP)
        yield pose, now
        pose = pose @ rolled(now, TIME_STEP)
    yield pose, now


def stop(start, moving):
    """Brake until the robot stands."""
    pose, now = start, moving
    while now.linear > 0.0:
        now = BODY.obeyed(now, turn_on_the_spot(0.0, SETTINGS, now), TIME_STEP)
        yield pose, now
        pose = pose @ rolled(now, TIME_STEP)
    yield pose, now


def room_between(moments, obstacles):
    """Measure from the body to the nearest obstacle at any time of a drive [m]."""
    gaps = []
    for pose, now in moments:
        gaps += [
            np.hypot(*(obstacles - (pose @ rolled(now, share * TIME_STEP)).position).T).min()
            for share in (0.0, 0.25, 0.5, 0.75)
        ]
    return min(gaps) - BODY.radius


def somewhere(rng, *shape):
    """Draw places about the robot."""
    return rng.uniform((-2.0, -2.0), (3.0, 2.0), (*shape, 2))


@st.composite
def scenes(draw):
    """Obstacles about a robot that is clear of them: lone posts, walls, a corridor; and a generator."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    walls = [along(*somewhere(rng, 2)) for _ in range(draw(st.integers(0, 4)))]
    obstacles = np.vstack([somewhere(rng, draw(st.integers(1, 25))), *walls])
    if draw(st.booleans()):
        half = draw(st.floats(0.24, 0.8))
        obstacles = np.vstack([obstacles, along((-1, half), (4, half)), along((-1, -half), (4, -half))])
    clear = np.hypot(*obstacles.T) > BODY.radius + CLEARANCE
    return np.vstack([obstacles[clear], (9.0, 9.0)]), rng


@settings(max_examples=250)
@given(scenes(), st.lists(st.floats(0.2, 2.5), min_size=1, max_size=4))
def test_whatever_the_path_a_robot_that_obeys_stays_clear_of_all_obstacles(scene, times):
    obstacles, rng = scene
    pose, now = Pose2.identity(), STILL
    for seconds in times:
        path = along(pose.position, *somewhere(rng, rng.integers(1, 4)))
        moments = list(obey(path, obstacles, pose, seconds=seconds, moving=now))
        assert CLEARANCE - 0.004 < room_between(moments, obstacles)
        pose, now = moments[-1]
        assert CLEARANCE - 0.004 < room_between(stop(pose, now), obstacles)


@pytest.mark.parametrize("half", [0.26, 0.35, 0.6])
@pytest.mark.parametrize("turn", [-2.5, -1.0, 1.6, 3.0])
@pytest.mark.parametrize("seconds", [1.2, 2.7])
def test_a_robot_at_speed_that_is_sent_back_touches_no_corridor(half, turn, seconds):
    obstacles = np.vstack([along((-1, half), (8, half)), along((-1, -half), (8, -half))])
    *_, (pose, now) = obey(along((0, 0), (8, 0)), obstacles, Pose2.identity(), seconds=seconds)
    back = along(pose.position, pose.position + 2.0 * np.array([math.cos(turn), math.sin(turn)]))
    moments = list(obey(back, obstacles, pose, seconds=3.0, moving=now))

    assert 0.1 < now.linear
    assert CLEARANCE - 0.004 < room_between(moments, obstacles)


@given(angles)
def test_in_the_open_the_end_of_the_path_is_reached_from_any_heading(heading):
    *_, (pose, now) = obey(along((0, 0), (3, 0)), NOTHING, Pose2(0.0, 0.0, heading), seconds=12.0)

    assert 0.2 > math.hypot(pose.x - 3.0, pose.y)
    assert 0.1 > now.linear


@pytest.mark.parametrize("half", [0.3, 0.4, 0.6])
def test_the_robot_comes_around_a_corner(half):
    inner = along((-1, half), (2 - half, half), (2 - half, 3))
    outer = along((-1, -half), (2 + half, -half), (2 + half, 3))
    path = along((0, 0), (2, 0), (2, 2.5))
    *_, (pose, _) = obey(path, np.vstack([inner, outer]), Pose2.identity(), seconds=20.0)

    assert 0.3 > math.hypot(pose.x - 2.0, pose.y - 2.5)


@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0), st.booleans())
def test_commands_are_within_limits_and_never_backward(x, y, blocked):
    obstacles = np.array([[0.5, 0.1]]) if blocked else NOTHING
    command = steer(along((0, 0), (x, y)), obstacles, BODY.radius, SETTINGS)

    assert 0.0 <= command.linear <= SETTINGS.speed
    assert abs(command.angular) <= SETTINGS.turn_rate


@given(scenes())
def test_what_is_mirrored_is_steered_mirrored(scene):
    obstacles, rng = scene
    path = along((0.0, 0.0), *somewhere(rng, 3))
    command = steer(path, obstacles, BODY.radius, SETTINGS)
    mirrored = steer(path * (1.0, -1.0), obstacles * (1.0, -1.0), BODY.radius, SETTINGS)

    assert pytest.approx(command.linear) == mirrored.linear
    assert pytest.approx(-command.angular) == mirrored.angular


@pytest.mark.parametrize("bearing", [1.7, 2.5, 3.1, -1.7, -2.5, -3.1])
def test_towards_a_path_behind_it_the_robot_turns_on_the_spot_by_the_smaller_angle(bearing):
    command = steer(
        along((0, 0), (3 * math.cos(bearing), 3 * math.sin(bearing))), NOTHING, BODY.radius, SETTINGS
    )

    assert 0.0 == command.linear
    assert 0.0 < command.angular * bearing


def test_a_robot_that_moves_stops_on_its_arc_before_it_turns_back():
    moving = Twist(0.6, -0.4)
    command = steer(-AHEAD, NOTHING, BODY.radius, SETTINGS, moving)

    assert Twist(0.0, -0.4) == command == turn_on_the_spot(0.0, SETTINGS, moving)


def test_a_robot_that_stands_is_braked_without_turning():
    turning = Twist(0.0, 0.5)

    assert STILL == turn_on_the_spot(0.0, SETTINGS, STILL) == turn_on_the_spot(0.0, SETTINGS, turning)


@pytest.mark.parametrize("away", [0.231, 0.25])
def test_before_a_wall_the_robot_stands_still(away):
    wall = along((away, -2), (away, 2))

    assert 0.0 == steer(AHEAD, wall, BODY.radius, SETTINGS).linear


def test_the_nearer_a_wall_the_slower():
    speeds = [
        steer(AHEAD, along((away, -2), (away, 2)), BODY.radius, SETTINGS).linear
        for away in (0.3, 0.5, 0.8, 3.0)
    ]

    assert sorted(speeds) == speeds
    assert 0.0 < speeds[1] < speeds[3] == SETTINGS.speed


@pytest.mark.parametrize("sight", [0.24, 0.3, 0.5, 0.7, 1.0])
def test_the_less_a_robot_sees_the_slower_it_drives_and_it_touches_nothing(sight):
    wall = np.column_stack([np.full(81, 3.0), np.linspace(-2.0, 2.0, 81)])
    path = np.array([[0.0, 0.0], [6.0, 0.0]])
    pose, now, fastest = Pose2.identity(), STILL, 0.0
    for _ in range(200):
        in_base = pose.inverse() @ wall
        seen = in_base[np.hypot(*in_base.T) < sight]
        now = BODY.obeyed(
            now, steer(pose.inverse() @ path, seen, BODY.radius, SETTINGS, now, sight=sight), TIME_STEP
        )
        pose = pose @ rolled(now, TIME_STEP)
        fastest = max(fastest, now.linear)

        assert np.hypot(*(pose.inverse() @ wall).T).min() > BODY.radius
    assert fastest <= math.sqrt(2.0 * SETTINGS.braking * sight)


def test_what_is_behind_does_not_stop_a_robot_that_drives_off():
    wall = along((-0.21, -2), (-0.21, 2))

    assert SETTINGS.speed == steer(AHEAD, wall, BODY.radius, SETTINGS).linear


@pytest.mark.parametrize("heading", [0.0, 1.5, 3.0, -1.5])
def test_a_robot_that_is_too_near_to_a_wall_drives_off_it_and_comes_no_nearer(heading):
    too_near = BODY.radius + CLEARANCE / 2.0
    wall = along((-1, too_near), (3, too_near))

    start, slowly = Pose2(0.0, 0.0, heading), SteeringSettings(speed=0.25)
    moments = list(obey(along((0, 0), (1, -1)), wall, start, seconds=15.0, how=slowly))

    assert 0.2 > np.hypot(*(moments[-1][0].position - (1.0, -1.0)))
    assert too_near - 1e-6 < room_between(moments, wall) + BODY.radius


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("heading", [0.0, -0.5, 1.0])
def test_a_robot_gets_away_from_a_post_that_its_path_passes_too_near(side, heading):
    post = np.array([[0.05, side * (BODY.radius + 0.01)]])

    moments = list(obey(along((0, 0), (2, 0)), post, Pose2(0.0, 0.0, heading), seconds=15.0))

    assert 0.2 > np.hypot(*(moments[-1][0].position - (2.0, 0.0)))
    assert np.hypot(*post[0]) - 1e-3 < room_between(moments, post) + BODY.radius


@pytest.mark.parametrize("left", [0.0, 0.05, 0.3])
def test_the_robot_can_stop_at_the_end_of_its_path(left):
    path = np.array([[0.0, 0.0]]) if left == 0.0 else along((0, 0), (left, 0))
    command = steer(path, NOTHING, BODY.radius, SETTINGS)

    assert command.linear**2 / (2.0 * SETTINGS.braking) <= left + 1e-9


@pytest.mark.parametrize("name", ["speed", "turn_rate", "braking"])
@pytest.mark.parametrize("value", [0.0, math.inf])
def test_what_moves_the_robot_is_positive_and_finite(name, value):
    with pytest.raises(ValueError, match=f"{name} must be > 0 and finite"):
        SteeringSettings(**{name: value})


@pytest.mark.parametrize("delay", [-1.0, math.nan, math.inf])
def test_the_delay_is_not_negative_and_finite(delay):
    with pytest.raises(ValueError, match="delay must be >= 0"):
        SteeringSettings(delay=delay)
