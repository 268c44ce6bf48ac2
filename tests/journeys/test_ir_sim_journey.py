"""The same driving code in a simulator of others: success is not proven in a world of our own only."""

import math
from importlib.util import find_spec

import numpy as np
import pytest

from buildings import WALLS, flat
from ir_sim_robot import IrSimRobot
from pilotage.drives import Drive, drive
from pilotage.geometry import Polyline, Pose2, Twist
from pilotage.localization import Localizer
from pilotage.maps import SchematicMap
from pilotage.navigation import Navigator, Outcome
from pilotage.simulation import LaserSettings, Simulator, SimulatorSettings, World, sense

pytestmark = pytest.mark.skipif(find_spec("irsim") is None, reason="ir-sim is not installed")

START = Pose2(1.0, 6.0, -1.5)
GOAL = np.array([8.5, 5.0])  # in the smaller room
EXACT = SimulatorSettings(laser=LaserSettings(noise=0.0, dropout=0.0))
STRETCHED = np.array([46.0, 37.0])  # drawing units per metre, from left to right and upwards


@pytest.fixture
def furnished():
    """The flat with a table and a chest that no one drew."""
    table = Polyline.through([(4.6, 0.6), (5.6, 0.6), (5.6, 1.4), (4.6, 1.4)], closed=True)
    chest = Polyline.through([(0.0, 3.2), (0.5, 3.2), (0.5, 4.2), (0.0, 4.2)], closed=True)
    return SchematicMap((*WALLS, table, chest)).segments


@pytest.fixture
def robot_in(tmp_path):
    robots = []

    def put(walls, pose, **how):
        robots.append(IrSimRobot(walls, pose, tmp_path, **how))
        return robots[-1]

    yield put
    for robot in robots:
        robot.close()


@pytest.mark.parametrize("pose", [START, Pose2(7.0, 2.0, 0.3), Pose2(8.5, 5.0, 3.0)])
def test_both_simulators_measure_the_same_ranges(robot_in, furnished, pose):
    ours = sense(World(furnished), pose, 0.0, np.random.default_rng(0), EXACT.laser)
    theirs = robot_in(furnished, pose, settings=EXACT).read().scan

    np.testing.assert_allclose(ours.directions, theirs.directions, atol=1e-12)
    np.testing.assert_allclose(ours.ranges, theirs.ranges, atol=1e-9)


def test_a_command_moves_both_robots_alike(robot_in, furnished):
    ours = Simulator(World(furnished), START, np.random.default_rng(0), EXACT)
    theirs = robot_in(furnished, START, settings=EXACT, straying=(0.0, 0.0, 0.0, 0.0))
    for k in range(60):
        for robot in (ours, theirs):
            robot.step(Twist(0.6, 0.5 * math.cos(0.1 * k)))

    # they take the heading before the step, and we in its middle
    np.testing.assert_allclose(ours.world_from_base.position, theirs.world_from_base.position, atol=0.05)
    assert ours.world_from_base.theta == pytest.approx(theirs.world_from_base.theta)


@pytest.mark.slow
@pytest.mark.parametrize("knows_start", [True, False])
def test_the_robot_gets_to_the_goal_of_a_stretched_drawing(robot_in, furnished, knows_start):
    drawing = SchematicMap(tuple(Polyline(wall.vertices * STRETCHED) for wall in flat().strokes))
    x, y = START.position * STRETCHED
    start = (x, y, START.theta) if knows_start else None
    navigator = Navigator(Localizer(drawing, seed=0, start=start), tuple(GOAL * STRETCHED))
    instants = list(drive(navigator, robot_in(furnished, START)))
    driven = Drive.of(navigator.planner.atlas, World(furnished), navigator.planner.goal, instants)

    assert Outcome.REACHED is driven.outcome, driven.reason
    assert 0 == driven.collisions
    assert 1.5 > np.hypot(*(driven.positions[-1] - GOAL))
