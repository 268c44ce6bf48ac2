"""Where the robot is between two looks at the drawing."""

import math

import numpy as np

from buildings import flat, scan_at
from pilotage.geometry import Pose2, Twist
from pilotage.localization import AlignmentSettings, Localizer, LocalizerSettings, TrackingSettings
from pilotage.navigation.reckoning import Reckoning
from pilotage.perception import Odometry

START = Pose2(1.0, 5.0, -math.pi / 2)
ODOM_FROM_WORLD = Pose2(3.0, -2.0, 0.7)
SETTINGS = LocalizerSettings(
    tracking=TrackingSettings(first_count=4000, count=2000, least=1000),
    alignment=AlignmentSettings(proposals=400, kept=(200, 50)),
)


def reading(way, stamp):
    pose = START @ Pose2(way, 0.0, 0.0)
    return scan_at(pose, stamp), Odometry(stamp, ODOM_FROM_WORLD @ pose)


def begun():
    return Reckoning(Localizer(flat(), SETTINGS, start=START, scale=1.0), *reading(0.0, 0.0))


def test_the_first_scan_is_looked_at_by_a_robot_that_stands():
    reckoning = begun()

    assert reckoning.is_fresh
    assert Twist(0.0, 0.0) == reckoning.moving
    assert 0 == reckoning.times_lost


def test_a_scan_is_looked_at_once_the_robot_has_moved_enough():
    reckoning, looked = begun(), []
    for k in range(1, 9):
        reckoning.advance(*reading(0.06 * k, 0.1 * k), 0.15, 0.2)
        looked.append(reckoning.is_fresh)

    assert [False, False, True, False, False, True, False, False] == looked


def test_in_between_the_wheels_carry_pose_and_place_on():
    reckoning = begun()
    before, place = reckoning.odom_from_base, np.array(reckoning.placement.position)
    reckoning.advance(*reading(0.1, 0.1), 0.15, 0.2)
    moved = before.inverse() @ reckoning.odom_from_base

    np.testing.assert_allclose((moved.x, moved.y, moved.theta), (0.1, 0.0, 0.0), atol=1e-9)
    step = np.array(reckoning.placement.position) - place
    assert 0.05 < np.hypot(*step) / reckoning.placement.scale < 0.15
    assert math.isclose(1.0, reckoning.moving.linear, rel_tol=1e-6)
