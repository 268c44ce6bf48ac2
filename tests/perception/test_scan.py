"""A scan is checked when it is made, so that no absurd value goes further."""

import math

import numpy as np
import pytest

from pilotage.geometry import Pose2
from pilotage.perception import LaserScan, Odometry


@pytest.mark.parametrize("absurd", [100.0, 1e9, 1e300])
def test_a_range_that_no_scanner_reaches_counts_as_no_return(absurd):
    scan = LaserScan(0.0, -0.1, 0.1, np.array([5.0, absurd, 99.0]))

    assert [5.0, math.inf, 99.0] == scan.ranges.tolist()


@pytest.mark.parametrize("mount", [Pose2(1e9, 0.0, 0.0), Pose2(0.0, -11.0, 0.0), Pose2(300.0, 0.0, 0.0)])
def test_a_laser_far_from_its_robot_is_rejected(mount):
    with pytest.raises(ValueError, match="base_from_laser must be within 10 m of the base, got"):
        LaserScan(0.0, 0.0, 0.1, np.ones(3), base_from_laser=mount)


def test_odometry_has_a_time():
    with pytest.raises(ValueError, match="stamp must be finite, got nan"):
        Odometry(math.nan, Pose2.identity())
