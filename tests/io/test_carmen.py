"""CARMEN's messages are read as their writers meant them."""

import math

import numpy as np
import pytest

from pilotage.io.carmen import read_carmen

FRONT = "FLASER 3 1.0 2.0 3.0 0.5 0 0 0.5 0 0 7.5 host 7.6"


def flaser(ranges, laser="0 0 0", robot="0 0 0", stamp="1.0", name="FLASER"):
    return f"{name} {len(ranges)} {' '.join(map(str, ranges))} {laser} {robot} {stamp} host {stamp}"


@pytest.mark.parametrize(
    ("beams", "first_deg", "last_deg"),
    [
        (180, -90.0, 89.0),
        (360, -90.0, 89.5),
        (181, -90.0, 90.0),
        (361, -90.0, 90.0),
        (401, -50.0, 50.0),
        (1081, -135.0, 135.0),
    ],
)
def test_even_numbers_of_beams_stop_one_step_short_and_odd_ones_do_not(beams, first_deg, last_deg):
    (reading,) = read_carmen([flaser([1.0] * beams)]).readings

    assert first_deg == pytest.approx(math.degrees(reading.scan.directions[0]))
    assert last_deg == pytest.approx(math.degrees(reading.scan.directions[-1]))


def test_one_beam_is_a_scan():
    (reading,) = read_carmen([flaser([2.5])]).readings

    assert reading.scan.ranges.tolist() == [2.5]


@pytest.mark.parametrize("nothing", [50.0, 51.16, 81.91, "inf", "nan"])
def test_ranges_at_the_limit_of_the_laser_are_no_returns(nothing):
    (reading,) = read_carmen([flaser([1.0, nothing, 49.9])]).readings

    assert reading.scan.returned.tolist() == [True, False, True]


def test_a_largest_range_that_outnumbers_its_neighborhood_is_the_limit():
    ranges = [*np.linspace(0.5, 5.4, 40), *[5.6] * 60]
    (reading,) = read_carmen([flaser(ranges)]).readings

    assert reading.scan.returned.tolist() == [True] * 40 + [False] * 60


def test_a_wall_at_the_largest_range_is_no_limit():
    ranges = [4.9] * 60 + [5.0] * 40
    (reading,) = read_carmen([flaser(ranges)]).readings

    assert reading.scan.returned.all()


def test_zero_is_too_near_to_be_a_return():
    (reading,) = read_carmen([flaser([0.0, 1.0])]).readings

    assert reading.scan.ranges[0] == -math.inf


def test_a_rear_laser_looks_backward():
    (reading,) = read_carmen([flaser([9.0, 2.0, 9.0], name="RLASER")]).readings

    np.testing.assert_allclose(reading.scan.points_in_base[1], [-2.0, 0.0], atol=1e-12)


def test_a_rear_laser_whose_pose_holds_the_half_turn_is_not_turned_twice():
    line = flaser([9.0, 2.0, 9.0], laser="-0.3 0 3.14159265", name="RLASER")
    (reading,) = read_carmen([line]).readings

    np.testing.assert_allclose(reading.scan.points_in_base[1], [-2.3, 0.0], atol=1e-6)


def test_a_mount_that_stands_still_is_believed():
    lines = [
        flaser([1.0] * 3, laser="0.3 0 0"),
        flaser([1.0] * 3, laser="0 1.3 1.570796", robot="0 1 1.570796"),
    ]
    log = read_carmen(lines)

    for reading in log.readings:
        assert reading.scan.base_from_laser.x == pytest.approx(0.3, abs=1e-5)


def test_a_corrected_pose_is_no_mount():
    lines = [flaser([1.0] * 3, laser="0.3 0 0"), flaser([1.0] * 3, laser="0.9 0.2 0", robot="0.1 0 0")]
    log = read_carmen(lines)

    assert [(0.0, 0.0)] * 2 == [
        (reading.scan.base_from_laser.x, reading.scan.base_from_laser.y) for reading in log.readings
    ]


def test_a_robotlaser_describes_its_laser():
    line = (
        "ROBOTLASER1 0 -1.0 2.0 0.5 8.0 0.01 0 5 1 2 8.0 4 5 2 7 7 "
        "1.2 2 0.1 1 2 0.1 0 0 0.5 0.5 0.5 12.5 host 12.5"
    )
    (reading,) = read_carmen([line]).readings

    np.testing.assert_allclose(reading.scan.directions, [-1.0, -0.5, 0.0, 0.5, 1.0])
    assert reading.scan.returned.tolist() == [True, True, False, True, True]
    assert reading.scan.stamp == 12.5
    assert reading.scan.base_from_laser.x == pytest.approx(0.2 * math.cos(0.1))
    assert reading.odometry.odom_from_base.position.tolist() == [1.0, 2.0]


def test_odometry_comes_from_scans_and_odom_lines_in_order():
    log = read_carmen(["ODOM 1 2 0.5 0 0 0 3.5 host 3.5", FRONT])

    assert [3.5, 7.5] == [odometry.stamp for odometry in log.odometry]
    assert len(log.readings) == 1


@pytest.mark.parametrize(
    "broken",
    [
        "FLASER",
        "FLASER many 1 2 3",
        "FLASER 3 1.0 2.0",
        "FLASER 2 1.0 x 0 0 0 0 0 0 1 host 1",
        "FLASER 2 1.0 1.0 0 0 nan 0 0 nan 1 host 1",
        "FLASER 2 1.0 1.0 0 0 0 0 0 0 inf host 1",
        "FLASER 2 1.0 1.0 0 0 0 0 0 0",
        "FLASER -1 0 0 0 0 0 0 1 host 1",
        "ROBOTLASER1 0 -1.0 2.0",
        "ODOM 1 2",
    ],
)
def test_a_broken_line_is_named_and_passed_over(broken):
    log = read_carmen(["# a log", broken, FRONT])

    assert [2] == [line.number for line in log.broken_lines]
    assert len(log.readings) == 1


def test_other_messages_comments_and_empty_lines_are_passed_over():
    log = read_carmen(["", "# comment", "PARAM robot_width 0.5", "SYNC x", FRONT])

    assert log.broken_lines == ()
    assert len(log.readings) == 1


def test_equal_stamps_stay_in_order():
    log = read_carmen([flaser([1.0, 1.0], robot=f"{k} 0 0") for k in range(3)])

    assert [0.0, 1.0, 2.0] == [reading.odometry.odom_from_base.x for reading in log.readings]


def robotlaser(angle_min="-1.57", increment="1.57"):
    return (
        f"ROBOTLASER1 0 {angle_min} 3.14 {increment} 80 0.01 0 3 1 1 1 0 0 0 0 0 0 0 0 0 0 0 0 1.0 host 1.0"
    )


@pytest.mark.parametrize(
    "broken",
    [robotlaser("inf"), robotlaser("nan"), robotlaser(increment="inf"), flaser([1.0], robot="1e300 0 0")],
)
def test_a_line_of_endless_angles_or_places_is_passed_over(broken):
    log = read_carmen([broken, robotlaser()])

    assert 1 == len(log.readings)
    assert [1] == [line.number for line in log.broken_lines]
