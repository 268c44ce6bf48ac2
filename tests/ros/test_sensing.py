"""Readings are made of what a robot publishes, or it is said what is missing."""

import math

import pytest
from benchmarks.lib.bag_making import Maker
from hypothesis import given
from hypothesis import strategies as st

from pilotage.ros.sensing import STALE, NotReadyError, Sensing

MAKER = Maker("")


def sensing(until=1.0, speed=1.0):
    """Odometry ten times a second of a robot that drives straight on."""
    made = Sensing()
    made.hear_transforms(MAKER.transform("base_link", "laser", position=(0.1, 0.0, 0.0))[1])
    for k in range(round(10 * until) + 1):
        made.hear_odometry(MAKER.odometry(0.1 * k, (speed * 0.1 * k, 0.0, 0.0))[1])
    return made


@given(stamp=st.floats(0.0, 1.0 + STALE - 0.01), speed=st.floats(-2.0, 2.0))
def test_odometry_is_interpolated_and_carried_on(stamp, speed):
    reading = sensing(speed=speed).reading(MAKER.scan(stamp, [1.0, 2.0])[1])

    assert pytest.approx(speed * stamp, abs=1e-6) == reading.odometry.odom_from_base.x
    assert pytest.approx(0.1) == reading.scan.base_from_laser.x


@pytest.mark.parametrize(
    ("stamp", "frame", "rule"),
    [(1.5, "laser", "stale by 0.50 s"), (-3.0, "laser", "does not reach back"), (1.0, "top", "no transform")],
)
def test_what_is_missing_is_said(stamp, frame, rule):
    made = sensing()
    scan = MAKER.scan(max(stamp, 0.0), [1.0, 2.0], frame=frame)[1]
    if stamp < 0.0:
        made = Sensing()
        made.hear_odometry(MAKER.odometry(9.0, (0.0, 0.0, 0.0))[1])

    with pytest.raises(NotReadyError, match=rule):
        made.reading(scan)


def test_a_broken_scan_is_said():
    with pytest.raises(NotReadyError, match="angle_increment"):
        sensing().reading(MAKER.scan(1.0, [1.0, 2.0], increment=0.0)[1])


def test_transforms_are_odometry_until_a_topic_tells_it():
    made = Sensing()
    made.hear_transforms(MAKER.transform("odom", "base_footprint", 1.0, position=(3.0, 0.0, 0.0))[1])
    made.hear_transforms(MAKER.transform("base_footprint", "laser")[1])
    assert 3.0 == made.reading(MAKER.scan(1.0, [1.0, 2.0])[1]).odometry.odom_from_base.x

    made.hear_odometry(MAKER.odometry(1.0, (5.0, 0.0, 0.0), "base_footprint")[1])
    made.hear_transforms(MAKER.transform("odom", "base_footprint", 1.1, position=(9.0, 0.0, 0.0))[1])
    assert 5.0 == made.reading(MAKER.scan(1.0, [1.0, 2.0])[1]).odometry.odom_from_base.x


def test_a_clock_that_is_set_back_begins_anew_and_small_disorder_does_not():
    made = sensing()
    made.hear_odometry(MAKER.odometry(0.95, (math.pi, 0.0, 0.0))[1])
    assert pytest.approx(1.0) == made.pose_at(1.0).x

    made = sensing(until=5.0)
    made.hear_odometry(MAKER.odometry(1.0, (7.0, 0.0, 0.0))[1])
    assert 7.0 == made.pose_at(1.1).x
