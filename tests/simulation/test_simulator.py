"""A robot in a world, moved by commands."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pilotage.geometry import Polyline, Pose2, Twist
from pilotage.maps import SchematicMap
from pilotage.simulation import (
    BodySettings,
    LaserSettings,
    OdometrySettings,
    Person,
    Simulator,
    SimulatorSettings,
    StartError,
    World,
)

ROOM = World.of(SchematicMap((Polyline.through([(-2, -3), (5, -3), (5, 4), (-2, 4)], closed=True),)))
SURE = SimulatorSettings(
    laser=LaserSettings(noise=0.0, dropout=0.0),
    odometry=OdometrySettings(slip=0.0, drift=0.0, turn_slip=0.0),
)
REST = Twist(0.0, 0.0)


def simulator_at(x, y, theta, *, world=ROOM, seed=0, how=SURE):
    return Simulator(world, Pose2(x, y, theta), np.random.default_rng(seed), how)


def test_the_robot_obeys_as_fast_as_it_can():
    simulator = simulator_at(0, 0, 0)
    for _ in range(20):
        simulator.step(Twist(0.5, 0.0))

    # speeding up at 1 m/s² takes the first half second
    assert 2.0 == pytest.approx(simulator.stamp)
    assert 0.5 == simulator.twist.linear
    assert 0.1 * (0.1 + 0.2 + 0.3 + 0.4 + 16 * 0.5) == pytest.approx(simulator.world_from_base.x)
    assert 0.0 == simulator.world_from_base.theta


def test_an_arc_is_driven_as_geometry_says():
    simulator = simulator_at(
        0, 0, 0, how=SimulatorSettings(body=BodySettings(acceleration=99, turn_acceleration=99))
    )
    for _ in range(10):
        simulator.step(Twist(0.4, 0.8))

    assert 0.8 == pytest.approx(simulator.world_from_base.theta)
    np.testing.assert_allclose(
        [0.5 * math.sin(0.8), 0.5 * (1.0 - math.cos(0.8))], simulator.world_from_base.position
    )


def test_wheels_that_do_not_slip_report_the_way_from_the_start():
    simulator = simulator_at(1, 2, 0.7)
    for k in range(60):
        simulator.step(Twist(0.6, math.sin(k)))
    reading = simulator.read()
    expected = Pose2(1, 2, 0.7).inverse() @ simulator.world_from_base

    assert simulator.stamp == reading.scan.stamp == reading.odometry.stamp
    np.testing.assert_allclose(expected.position, reading.odometry.odom_from_base.position, atol=1e-9)


def test_the_robot_stops_where_it_touches_and_the_contact_counts_once():
    simulator = simulator_at(3.5, 0, 0)
    for _ in range(40):
        simulator.step(Twist(0.8, 0.0))

    assert 4.8 == pytest.approx(simulator.world_from_base.x, abs=1e-5)
    assert 1 == simulator.collisions

    for _ in range(20):
        simulator.step(Twist(0.8, 0.3))
    assert 1 == simulator.collisions

    for _ in range(20):
        simulator.step(Twist(-0.8, 0.0))
    for _ in range(60):
        simulator.step(Twist(0.8, 0.0))
    assert 2 == simulator.collisions


@given(commands=st.lists(st.builds(Twist, st.floats(-2, 2), st.floats(-3, 3)), min_size=1, max_size=12))
@settings(max_examples=40)
def test_whatever_is_commanded_the_robot_is_never_in_a_wall(commands):
    simulator = simulator_at(4.0, 3.0, 0.5)
    for command in commands:
        for _ in range(15):
            simulator.step(command)
            assert 0.2 <= ROOM.clearance([simulator.world_from_base.position])[0]


def test_a_reading_does_not_change_until_the_next_step():
    simulator = simulator_at(0, 0, 0, how=SimulatorSettings())
    first = simulator.read()

    assert simulator.read() is first
    simulator.step(REST)
    assert not np.array_equal(first.scan.ranges, simulator.read().scan.ranges)


def test_the_same_seed_gives_the_same_drive():
    first, again = (simulator_at(0, 0, 0, seed=4, how=SimulatorSettings()) for _ in range(2))
    for k in range(100):
        for simulator in (first, again):
            simulator.step(Twist(0.7, math.cos(k)))
    again.read()

    assert first.read().odometry == again.read().odometry
    assert np.array_equal(first.read().scan.ranges, again.read().scan.ranges)


@pytest.mark.parametrize("x", [4.9, 4.81, -2.0])
def test_a_start_in_a_wall_is_refused(x):
    with pytest.raises(StartError, match="start must leave"):
        simulator_at(x, 0, 0)


@pytest.mark.parametrize(
    ("make", "rule"),
    [
        (lambda: SimulatorSettings(time_step=0.0), "time_step must be > 0 s"),
        (lambda: BodySettings(radius=-1.0), "radius must be > 0"),
        (lambda: simulator_at(0, 0, 0).step(Twist(math.nan, 0.0)), "must be finite"),
    ],
)
def test_invalid_values_are_rejected(make, rule):
    with pytest.raises(ValueError, match=rule):
        make()


def test_a_carried_robot_stands_elsewhere_and_its_wheels_do_not_know():
    simulator = simulator_at(0, 0, 0)
    before = simulator.read()

    simulator.carry(Pose2(3, 2, 1.0))

    assert before.odometry == simulator.read().odometry
    assert not np.array_equal(before.scan.ranges, simulator.read().scan.ranges)
    with pytest.raises(StartError):
        simulator.carry(Pose2(5, 0, 0))
    assert [3.0, 2.0] == simulator.world_from_base.position.tolist()


def test_a_world_that_is_rebuilt_stops_the_robot_where_it_is_new():
    simulator = simulator_at(0, 0, 0)
    wall = np.array([[1.0, -1.0, 1.0, 1.0]])

    simulator.rebuild(replace(ROOM, segments=np.vstack([ROOM.segments, wall])))
    for _ in range(50):
        simulator.step(Twist(0.5, 0.0))

    assert 1.0 - simulator.settings.body.radius == pytest.approx(simulator.world_from_base.x, abs=1e-3)
    assert 1 == simulator.collisions
    with pytest.raises(StartError):
        simulator.rebuild(replace(ROOM, segments=wall - (0.3, 0.0, 0.3, 0.0)))


def test_who_joins_a_world_does_not_disturb_who_walks_there():
    path = Polyline.through([(-1, 3), (4, 3)])
    one = replace(ROOM, people=(Person(path),))
    undisturbed, joined = (simulator_at(0, 0, 0, world=one) for _ in range(2))

    joined.rebuild(replace(one, people=(Person(path), Person(Polyline.through([(-1, -2), (4, -2)])))))
    for _ in range(30):
        undisturbed.step(REST)
        joined.step(REST)

    assert 2 == len(joined.people)
    assert undisturbed.people[0].tolist() == joined.people[0].tolist()
