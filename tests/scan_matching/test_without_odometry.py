"""A robot without odometry is followed by its scans alone."""

from dataclasses import replace

import numpy as np
import pytest

from pilotage import LaserScan, Odometry, Pose2, open_log
from pilotage.scan_matching import MotionPrior, ScanMatcher
from shared_data import DATA, needs_bags

BEAMS = 360


def scan_in_a_room(stamp, pose):
    """A scan in a room of 8 x 5 m with a niche, from a pose in it."""
    corners = np.array([[0, 0], [8, 0], [8, 2], [9, 2], [9, 3], [8, 3], [8, 5], [0, 5]], dtype=float)
    first, second = corners, np.roll(corners, -1, axis=0)
    along = second - first
    angles = pose.theta + np.linspace(-np.pi, np.pi, BEAMS, endpoint=False)
    directions = np.column_stack([np.cos(angles), np.sin(angles)])[:, None]
    offset = first - pose.position
    cross = directions[..., 0] * along[:, 1] - directions[..., 1] * along[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        ranges = (offset[:, 0] * along[:, 1] - offset[:, 1] * along[:, 0]) / cross
        share = (offset[:, 0] * directions[..., 1] - offset[:, 1] * directions[..., 0]) / cross
    hits = np.where((ranges > 0) & (share >= 0) & (share <= 1), ranges, np.inf).min(axis=1)
    return LaserScan(stamp, -np.pi, 2 * np.pi / BEAMS, hits, range_max=30.0)


def test_a_drive_on_an_arc_is_followed_though_odometry_says_nothing():
    matcher = ScanMatcher()
    pose, step = Pose2(2.0, 2.0, 0.0), Pose2(0.05, 0.0, 0.04)
    start = pose
    for k in range(40):
        unknown = Odometry(0.1 * k, Pose2(7.0 * k, 0.0, 1.0), is_known=False)
        motion = matcher.update(scan_in_a_room(0.1 * k, pose), unknown)
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
