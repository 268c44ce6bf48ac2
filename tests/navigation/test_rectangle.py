"""A rectangular robot: what it may do beside obstacles, held against polygons, and a whole drive."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import affinity

from four_rooms import ATLAS, EXACT, START, WORLD
from knowing import KnowingLocalizer
from pilotage.drives import Drive, drive
from pilotage.geometry import Pose2, Twist
from pilotage.navigation import Navigator, NavigatorSettings, Outcome
from pilotage.navigation.braking import SteeringSettings
from pilotage.navigation.local_grid import CLEARANCE
from pilotage.navigation.rectangle import is_free_to_obey, poses_until_stopped, turned_or_backed_out
from pilotage.simulation import BodySettings, LaserSettings, Simulator, SimulatorSettings
from pilotage.simulation.rectangle import share_before_contact, touches

SIZE = (0.7, 0.44)
STEERING = SteeringSettings()
NOBODY = np.empty((0, 3))
near = st.floats(-1.5, 1.5)


def body(pose, size=SIZE):
    """Draw the rectangle at a pose (3,)."""
    x, y, theta = pose
    box = shapely.box(-size[0] / 2, -size[1] / 2, size[0] / 2, size[1] / 2)
    return affinity.translate(affinity.rotate(box, theta, origin=(0, 0), use_radians=True), x, y)


@settings(max_examples=80)
@given(st.lists(st.tuples(near, near), min_size=1, max_size=6), st.floats(-0.3, 0.8), st.floats(-1.2, 1.2))
def test_no_command_that_is_allowed_leads_into_an_obstacle(points, linear, angular):
    obstacles, command = np.array(points), Twist(linear, angular)
    if not is_free_to_obey(command, obstacles, SIZE, STEERING):
        return
    outside = [point for point in points if body((0, 0, 0)).distance(shapely.Point(point)) > CLEARANCE]
    for pose in poses_until_stopped(command, STEERING):
        assert not any(body(pose).contains(shapely.Point(point)) for point in outside)


@settings(max_examples=80)
@given(near, near, near, near, st.floats(-math.pi, math.pi))
def test_contact_of_a_rectangle_with_a_wall_is_that_of_polygons(ax, ay, bx, by, theta):
    wall = shapely.LineString([(ax, ay), (bx, by)])
    gap = body((0.2, -0.1, theta)).distance(wall)
    depth = body((0.2, -0.1, theta)).intersection(wall).length
    found = touches(Pose2(0.2, -0.1, theta), SIZE, np.array([[ax, ay, bx, by]]), NOBODY)

    if gap > 1e-6:
        assert not found
    if depth > 1e-6:
        assert found


def test_a_motion_ends_where_the_rectangle_touches():
    wall = np.array([[1.0, -1.0, 1.0, 1.0]])
    ahead = share_before_contact(Pose2(0.0, 0.0, 0.0), Pose2(1.0, 0.0, 0.0), SIZE, wall, NOBODY)
    turned = share_before_contact(Pose2(0.7, 0.0, math.pi / 2), Pose2(0.0, 0.0, 1.0), SIZE, wall, NOBODY)

    assert ahead == pytest.approx(0.65, abs=0.01)
    assert 0.05 < turned < 0.6
    assert 1.0 == share_before_contact(Pose2(0.0, 0.0, 0.0), Pose2(0.5, 0.0, 0.0), SIZE, wall, NOBODY)
    assert touches(Pose2(0.0, 0.0, 0.0), SIZE, np.empty((0, 4)), np.array([[0.5, 0.0, 0.2]]))
    assert not touches(Pose2(0.0, 0.0, 0.0), SIZE, np.empty((0, 4)), np.array([[0.6, 0.0, 0.2]]))


def test_a_robot_that_has_no_room_to_turn_backs_out_and_stands_if_it_cannot():
    x = np.linspace(-0.4, 0.6, 30)
    dead_end = np.vstack([np.column_stack([x, np.full(30, side)]) for side in (-0.27, 0.27)])
    closed = np.vstack([dead_end, [[-0.4, 0.0], [0.4, 0.0]]])
    still = Twist(0.0, 0.0)

    assert turned_or_backed_out(1.0, np.empty((0, 2)), SIZE, STEERING, still) == Twist(0.0, 1.0)
    assert 0.0 > turned_or_backed_out(1.0, dead_end, SIZE, STEERING, still).linear
    assert still == turned_or_backed_out(1.0, closed, SIZE, STEERING, still)


@pytest.mark.parametrize("degrees", [360.0, 270.0])
def test_a_rectangular_robot_drives_through_doors_and_touches_nothing(degrees):
    laser = LaserSettings(beams=round(degrees), field_of_view=math.radians(degrees - 1.0))
    shape = {"radius": SIZE[1] / 2.0, "length": SIZE[0]}
    simulator = Simulator(
        WORLD, START, np.random.default_rng(0), SimulatorSettings(BodySettings(**shape), laser, EXACT)
    )
    navigator = Navigator(
        KnowingLocalizer(ATLAS, START), (7.5, 7.5), NavigatorSettings(time_limit=120.0, **shape)
    )
    told = Drive.of(ATLAS, WORLD, navigator.planner.goal, list(drive(navigator, simulator)))

    assert Outcome.REACHED is told.outcome, told.reason
    assert 0 == told.collisions
    segments = np.asarray(WORLD.solid)
    assert not any(touches(scene.world_from_base, SIZE, segments, NOBODY) for scene in told.scenes)


@pytest.mark.parametrize("settings_of", [NavigatorSettings, BodySettings])
def test_a_rectangle_that_is_wider_than_long_is_rejected(settings_of):
    assert settings_of(radius=0.2).rectangle is None
    assert (0.5, 0.4) == settings_of(radius=0.2, length=0.5).rectangle
    with pytest.raises(ValueError, match="length must be 0 or at least the width"):
        settings_of(radius=0.2, length=0.3)
