"""Where the robot is between two scans that the localizer gets."""

import math
from dataclasses import replace

import numpy as np
import pytest

from buildings import coarse, flat, scan_at
from knowing import KnowingLocalizer
from pilotage.geometry import Pose2, Twist
from pilotage.localization import Status
from pilotage.maps import build_atlas
from pilotage.navigation.dead_reckoning import DeadReckoning, twist_between
from pilotage.perception import Odometry
from pilotage.simulation.body import rolled

START = Pose2(1.0, 5.0, -math.pi / 2)
ATLAS = build_atlas(flat(), coarse())


def reading(length, stamp, turn=0.0):
    odom_from_base = Pose2(length, 0.0, turn)
    return scan_at(START @ odom_from_base, stamp), Odometry(stamp, odom_from_base)


def begun(**how):
    position = DeadReckoning(KnowingLocalizer(ATLAS, START, **how))
    position.update(*reading(0.0, 0.0))
    return position


def test_the_first_scan_goes_to_the_localizer():
    position = begun()

    assert position.is_fresh
    assert Twist(0.0, 0.0) == position.twist
    assert 0 == position.times_lost
    assert [[0.0, 0.0]] == position.trail.tolist()


def test_a_scan_goes_to_the_localizer_once_the_robot_has_moved_enough():
    position, fresh = begun(), []
    for k in range(1, 9):
        position.update(*reading(0.06 * k, 0.1 * k))
        fresh.append(position.is_fresh)

    assert [False, False, True, False, False, True, False, False] == fresh


def test_in_between_odometry_moves_pose_and_estimate():
    position = begun()
    before, place = position.odom_from_base, position.estimate.sketch_from_base.translation
    position.update(*reading(0.1, 0.1))
    moved = before.inverse() @ position.odom_from_base

    assert not position.is_fresh
    np.testing.assert_allclose((moved.x, moved.y, moved.theta), (0.1, 0.0, 0.0), atol=1e-9)
    np.testing.assert_allclose(position.estimate.sketch_from_base.translation - place, (0.0, -0.1), atol=1e-9)
    np.testing.assert_allclose(position.localized.sketch_from_base.translation, place)
    assert math.isclose(1.0, position.twist.linear, rel_tol=1e-6)


def test_turns_add_up_whichever_way_they_go():
    position = begun()
    for k, turn in enumerate((0.3, -0.2, 0.1), 1):
        position.update(*reading(0.0, 0.1 * k, turn))

    assert math.isclose(0.3 + 0.5 + 0.3, position.turned)


def test_losing_the_place_is_counted_and_a_mismatch_too():
    stati = iter([Status.LOCATED, Status.LOST, Status.LOCATED, Status.MISMATCH, Status.LOST])
    position = begun(changed=lambda estimate: replace(estimate, status=next(stati)))
    for k in range(1, 5):
        position.update(*reading(0.2 * k, 0.1 * k))

    assert 2 == position.times_lost


@pytest.mark.parametrize("twist", [Twist(0.6, 0.0), Twist(0.5, -0.8), Twist(-0.3, 0.4), Twist(0.0, 1.0)])
def test_the_twist_is_what_odometry_says(twist):
    before = Odometry(4.0, Pose2(3.0, -2.0, 2.5))
    now = Odometry(4.1, before.odom_from_base @ rolled(twist, 0.1))

    told = twist_between(before, now)
    assert twist.linear == pytest.approx(told.linear, rel=0.01)
    assert twist.angular == pytest.approx(told.angular)
    assert Twist(0.0, 0.0) == twist_between(now, now)


@pytest.mark.parametrize("leap", [200.0, 1e9])
def test_a_leap_that_no_robot_makes_leaves_the_twist_as_it_was(leap):
    position = begun()
    position.update(*reading(0.05, 0.1))
    before = position.twist
    position.update(scan_at(START, 0.2), Odometry(0.2, Pose2(leap, 0.0, 0.0)))

    assert 0.5 == pytest.approx(before.linear)
    assert before == position.twist


def test_without_odometry_each_scan_goes_to_the_localizer():
    position = DeadReckoning(KnowingLocalizer(ATLAS, START))
    nothing = Odometry(0.0, Pose2.identity(), is_known=False)
    for k in range(3):
        position.update(scan_at(START, 0.1 * k), replace(nothing, stamp=0.1 * k))

        assert position.is_fresh
    assert Twist(0.0, 0.0) == position.twist
