"""What is written as a log is read back as it was."""

import math

import numpy as np
import pytest

from pilotage.geometry import Pose2
from pilotage.io import open_log, write_log
from pilotage.perception import LaserScan, Odometry, Reading


def reading(k, ranges):
    scan = LaserScan(float(k), -math.pi / 2, math.pi / 180, np.array(ranges), range_max=50.0)
    return Reading(scan, Odometry(float(k), Pose2(0.5 * k, -0.1 * k, 0.2 * k)))


@pytest.mark.parametrize("name", ["run.log", "run.log.gz"])
def test_ranges_and_odometry_come_back(tmp_path, name):
    rng = np.random.default_rng(0)
    written = [reading(k, rng.uniform(1.0, 9.0, 181)) for k in range(5)]
    write_log(tmp_path / name, written)
    read = open_log(tmp_path / name)

    assert len(written) == len(read)
    for a, b in zip(written, read, strict=True):
        np.testing.assert_allclose(a.scan.ranges, b.scan.ranges, atol=0.0051)
        np.testing.assert_allclose(a.scan.directions, b.scan.directions, atol=1e-9)
        assert a.scan.stamp == b.scan.stamp
        assert a.odometry.odom_from_base.x == pytest.approx(b.odometry.odom_from_base.x, abs=1e-4)
        assert a.odometry.odom_from_base.theta == pytest.approx(b.odometry.odom_from_base.theta, abs=1e-5)


def test_beams_without_return_come_back_without(tmp_path):
    ranges = np.linspace(2.0, 9.0, 181)
    ranges[10:20], ranges[30] = math.inf, math.nan
    write_log(tmp_path / "run.log", [reading(0, ranges)])
    (read,) = open_log(tmp_path / "run.log")

    assert [*range(10, 20), 30] == np.flatnonzero(~read.scan.returned).tolist()
