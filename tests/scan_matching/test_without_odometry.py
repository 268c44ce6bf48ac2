"""A robot without odometry is followed by its scans alone."""

import math
from dataclasses import replace

import numpy as np
import pytest

from buildings import scan_at
from pilotage import Odometry, Pose2, open_log
from pilotage.geometry import Polyline
from pilotage.scan_matching import MotionPrior, ScanMatcher
from shared_data import DATA, needs_bags

ROOM = Polyline.through([(0, 0), (8, 0), (8, 2), (9, 2), (9, 3), (8, 3), (8, 5), (0, 5)], closed=True)
"""A room of 8 x 5 m with a niche."""


def test_a_drive_on_an_arc_is_followed_though_odometry_says_nothing():
    matcher = ScanMatcher()
    pose, step = Pose2(2.0, 2.0, 0.0), Pose2(0.05, 0.0, 0.04)
    start = pose
    for k in range(40):
        unknown = Odometry(0.1 * k, Pose2(7.0 * k, 0.0, 1.0), is_known=False)
        scan = scan_at(pose, 0.1 * k, beams=360, fov=math.radians(359.0), walls=(ROOM,))
        motion = matcher.update(scan, unknown)
        pose = pose @ step
    true = start.inverse() @ (pose @ step.inverse())

    assert 0.05 > np.hypot(*(motion.odom_from_base.position - true.position))
    assert pytest.approx(true.theta, abs=0.03) == motion.odom_from_base.theta
    assert not motion.odometry_refused


def test_what_is_not_known_of_a_motion_grows_with_time_up_to_a_limit():
    stds = [
        MotionPrior.going_on(Pose2.identity(), Pose2.identity(), seconds).position_std
        for seconds in (-1.0, 0.0, 0.1, 0.5, 1.0, 1e3, 1e9)
    ]

    assert sorted(stds) == stds
    assert stds[0] == stds[1] > 0.0
    assert stds[-1] == stds[-2]


@needs_bags
@pytest.mark.slow
def test_a_real_robot_is_followed_as_well_without_its_odometry():
    ends = []
    for is_known in (True, False):
        matcher = ScanMatcher()
        for reading in open_log(DATA / "bags" / "mac_take_2_bag").readings[:200]:
            matcher.update(reading.scan, replace(reading.odometry, is_known=is_known))
        ends.append(matcher.odom_from_base)

    assert 0.2 > np.hypot(*(ends[0].position - ends[1].position))
