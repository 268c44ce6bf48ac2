"""People and doors, and a robot among them."""

import math

import numpy as np
import pytest

from pilotage.geometry import Polyline, Pose2, Twist
from pilotage.simulation import (
    Door,
    LaserSettings,
    OdometrySettings,
    Person,
    Simulator,
    SimulatorSettings,
    World,
)

WALLS = np.array([[0, 0, 10, 0], [10, 0, 10, 4], [10, 4, 0, 4], [0, 4, 0, 0]], dtype=float)
EXACT = SimulatorSettings(
    laser=LaserSettings(noise=0.0, dropout=0.0),
    odometry=OdometrySettings(slip=0.0, drift=0.0, turn_slip=0.0),
)
AHEAD, REST = Twist(0.8, 0.0), Twist(0.0, 0.0)


def simulator_in(world, pose, seed=0):
    return Simulator(world, pose, np.random.default_rng(seed), EXACT)


def walk_along(*points, speed=1.0, closed=False):
    return Person(Polyline.through(points, closed=closed), speed)


def test_a_person_walks_to_and_fro_along_the_path_and_rests_at_its_ends():
    simulator = simulator_in(World(WALLS, people=(walk_along((1, 3), (9, 3), speed=1.2),)), Pose2(1, 0.5, 0))
    places = []
    for _ in range(600):
        simulator.step(REST)
        places.append(simulator.people[0])
    x, y = np.array(places).T
    steps = np.abs(np.diff(x))

    np.testing.assert_allclose(3.0, y)
    assert (1.0, 9.0) == (x.min(), x.max())
    assert 0.12 == pytest.approx(steps.max())
    assert 0.1 < np.mean(steps == 0.0) < 0.5


def test_a_closed_path_is_walked_round_and_round():
    person = walk_along((3, 1), (9, 1), (9, 3), (3, 3), speed=0.9, closed=True)
    simulator = simulator_in(World(WALLS, people=(person,)), Pose2(1, 2, 0))
    places = []
    for _ in range(500):
        simulator.step(REST)
        places.append(simulator.people[0])
    gaps = World(np.hstack([person.path.ring[:-1], person.path.ring[1:]])).clearance(places)

    np.testing.assert_allclose(0.0, gaps, atol=1e-9)
    assert not (np.diff(places, axis=0) == 0.0).all(axis=1).any()


@pytest.mark.parametrize("seed", range(5))
def test_people_do_not_walk_into_a_robot_that_stands_in_their_way(seed):
    simulator = simulator_in(World(WALLS, people=(walk_along((1, 2), (9, 2)),)), Pose2(5, 2, 0), seed)
    sides = set()
    for _ in range(900):
        simulator.step(REST)
        sides.add(float(np.sign(simulator.people[0, 0] - 5.0)))
        assert 0.6 + 0.2 + 0.25 <= abs(simulator.people[0, 0] - 5.0) + 1e-9

    assert 0 == simulator.collisions
    assert 1 == len(sides)


def test_a_robot_that_drives_into_a_person_collides():
    person = walk_along((6, 2), (6.0, 2.001), speed=0.001)
    simulator = simulator_in(World(WALLS, people=(person,)), Pose2(2, 2, 0))
    for _ in range(60):
        simulator.step(AHEAD)

    assert 1 == simulator.collisions
    assert 0.45 == pytest.approx(
        np.hypot(*(simulator.people[0] - simulator.world_from_base.position)), abs=1e-4
    )


def test_a_door_opens_and_closes_at_its_times():
    door = Door(np.array([5.0, 0, 5, 4]), ((1.0, 3.0), (5.0, math.inf)))
    simulator = simulator_in(World(WALLS, doors=(door,)), Pose2(2, 2, 0))
    ranges = {}
    for _ in range(70):
        ranges[round(simulator.stamp, 1)] = simulator.read().scan.ranges[90]
        simulator.step(REST)

    assert [8.0, 8.0, 3.0, 3.0, 8.0, 8.0, 3.0, 3.0] == pytest.approx(
        [ranges[stamp] for stamp in (0.0, 0.9, 1.0, 2.9, 3.0, 4.9, 5.0, 6.9)]
    )


def test_a_closed_door_stops_the_robot_and_an_open_one_does_not():
    door = Door(np.array([5.0, 0, 5, 4]), ((0.0, 8.0),))
    simulator = simulator_in(World(WALLS, doors=(door,)), Pose2(2, 2, 0))
    for _ in range(60):
        simulator.step(AHEAD)

    assert 4.8 == pytest.approx(simulator.world_from_base.x, abs=1e-5)
    for _ in range(60):
        simulator.step(AHEAD)
    assert 6.0 < simulator.world_from_base.x
    assert 1 == simulator.collisions


def test_a_door_waits_until_the_robot_is_a_metre_off():
    door = Door(np.array([5.0, 0, 5, 4]), ((2.0, math.inf),))
    simulator = simulator_in(World(WALLS, doors=(door,)), Pose2(4.9, 2, 0))
    for _ in range(50):
        simulator.step(REST)

    assert 0 == len(simulator.closed_doors)
    while simulator.world_from_base.x < 6.1:
        simulator.step(Twist(0.3, 0.0))
    simulator.step(REST)
    assert 1 == len(simulator.closed_doors)
    assert 0 == simulator.collisions


def test_people_wait_at_closed_doors():
    door = Door(np.array([5.0, 0, 5, 4]), ((0.0, 30.0),))
    simulator = simulator_in(
        World(WALLS, doors=(door,), people=(walk_along((2, 2), (8, 2)),)), Pose2(1, 1, 0)
    )
    side = np.sign(simulator.people[0, 0] - 5.0)
    crossed = []
    for _ in range(900):
        simulator.step(REST)
        crossed.append(np.sign(simulator.people[0, 0] - 5.0) != side)

    assert not any(crossed[:300])
    assert any(crossed[300:])


def test_the_same_seed_moves_the_same_people_however_often_the_laser_is_read():
    world = World(WALLS, people=(walk_along((1, 3), (9, 3)), walk_along((3, 1), (8, 3), speed=0.7)))
    first, again = simulator_in(world, Pose2(1, 1, 0), 9), simulator_in(world, Pose2(1, 1, 0), 9)
    for _ in range(200):
        first.step(AHEAD)
        again.step(AHEAD)
        again.read()

    np.testing.assert_array_equal(first.people, again.people)
    assert first.world_from_base == again.world_from_base


@pytest.mark.parametrize(
    ("make", "rule"),
    [
        (lambda: Door(np.zeros(3)), "segment must be four finite numbers"),
        (lambda: Door(np.array([0, 0, 1, math.nan])), "segment must be four finite numbers"),
        (lambda: Door(np.zeros(4), ((3.0, 2.0),)), "must close before it opens again"),
        (lambda: walk_along((0, 0), (1, 0), speed=0.0), "speed must be > 0"),
        (lambda: walk_along((0, 0), (1, 0), speed=math.inf), "speed must be > 0"),
        (lambda: walk_along((0, 0), (0, 0)), "path must have a length"),
    ],
)
def test_invalid_values_are_rejected(make, rule):
    with pytest.raises(ValueError, match=rule):
        make()
