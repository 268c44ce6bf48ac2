"""A bag that ROS 1 itself recorded is read like any other."""

import math
import subprocess
from pathlib import Path

import numpy as np
import pytest

from pilotage import open_log

SYSTEM_PYTHON = "/usr/bin/python3"
RECORDER = Path(__file__).with_name("record_with_rosbag.py")
NEEDED = "rosbag, rospy, nav_msgs.msg, sensor_msgs.msg, tf2_msgs.msg, geometry_msgs.msg"


def run(*words):
    return subprocess.run(  # noqa: S603  # fixed words
        [SYSTEM_PYTHON, *map(str, words)], capture_output=True, text=True, check=False
    )


def has_rosbag():
    try:
        return 0 == run("-c", f"import {NEEDED}").returncode
    except OSError:
        return False


@pytest.mark.skipif(not has_rosbag(), reason="the rosbag of ROS 1 is not installed (Debian: python3-rosbag)")
@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
def test_a_bag_that_ros_1_recorded_is_read(tmp_path, compression):
    path = tmp_path / "run.bag"
    recorded = run(RECORDER, path, compression)
    assert 0 == recorded.returncode, recorded.stderr

    log = open_log(path)

    assert "" == log.complaint
    assert 40 == len(log)
    for k, reading in enumerate(log):
        assert pytest.approx(100.0 + 0.025 * k) == reading.scan.stamp
        assert pytest.approx(0.05 * k) == reading.odometry.odom_from_base.x
        ranges = reading.scan.ranges
        np.testing.assert_allclose((1.0 + 0.01 * np.arange(181) + 0.001 * k)[1:-1], ranges[1:-1], rtol=1e-6)
        assert math.inf == ranges[0]
        assert math.isnan(ranges[-1])
    mount = log.readings[0].scan.base_from_laser
    assert pytest.approx((0.2, 0.0, math.pi / 2)) == (mount.x, mount.y, mount.theta)
