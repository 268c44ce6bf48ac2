"""The matcher follows the robot, and no odd reading leaves it in a state from which it cannot go on."""

import math
from dataclasses import replace

import numpy as np
import pytest

from buildings import readings_of, walk
from pilotage.evaluation.trajectory import associate, chain, motion_errors, motions, spoil, thin
from pilotage.geometry import Pose2
from pilotage.io.logs import open_log
from pilotage.io.tum import read_trajectory
from pilotage.perception import LaserScan, Odometry, PerceptionSettings
from pilotage.scan_matching import LocalMap, Method, ScanMatcher, ScanMatchingSettings
from shared_data import LOGS, needs_logs

GLITCH = 20  # the reading of the walk that goes wrong


def follow(readings, settings=None):
    scan_matcher = ScanMatcher(settings)
    return scan_matcher, [scan_matcher.update(scan, odometry) for scan, odometry in readings]


def distance(a, b):
    motion = a.inverse() @ b
    return math.hypot(motion.x, motion.y)


def with_glitch(change):
    """The walk, with one reading changed."""
    readings = readings_of(walk())
    readings[GLITCH] = change(*readings[GLITCH])
    return readings


@pytest.fixture(scope="module")
def expected():
    """The motions that are found on the walk when no reading goes wrong."""
    return follow(readings_of(walk()))[1]


def test_a_walk_is_followed():
    poses = walk()
    scan_matcher, motions_found = follow(readings_of(poses))

    assert distance(motions_found[-1].odom_from_base, poses[0].inverse() @ poses[-1]) < 0.1
    assert scan_matcher.odom_from_base == motions_found[-1].odom_from_base
    assert scan_matcher.refused_count == 0
    assert all(motion.inlier_share > 0.4 for motion in motions_found[1:])
    assert not any(motion.was_carried for motion in motions_found)


def test_a_scan_of_another_place_tells_that_the_robot_was_carried_and_it_is_followed_from_there():
    poses = walk()
    before, after = readings_of(poses[:4]), readings_of(poses[12:20])
    here = before[-1][1].odom_from_base @ after[0][1].odom_from_base.inverse()
    later = [
        (scan, replace(odometry, odom_from_base=here @ odometry.odom_from_base)) for scan, odometry in after
    ]
    _, motions_found = follow([*before, *later])
    there, last = motions_found[4], motions_found[-1]

    assert [4] == [index for index, motion in enumerate(motions_found) if motion.was_carried]
    assert distance(there.last_from_base, Pose2.identity()) < 1e-9  # as odometry says
    driven = poses[12].inverse() @ poses[19]
    assert distance(there.odom_from_base.inverse() @ last.odom_from_base, driven) < 0.1


def test_the_first_reading_does_not_move():
    scan, odometry = readings_of(walk())[0]
    motion = ScanMatcher().update(scan, odometry)

    assert motion.odom_from_base == Pose2.identity()
    assert motion.inlier_share == 0.0
    assert not motion.odometry_refused


def test_a_robot_that_stands_still_enters_nothing():
    scan_matcher = ScanMatcher()
    scan, odometry = readings_of(walk())[0]
    scan_matcher.update(scan, odometry)
    local_map = scan_matcher.local_map
    scan_matcher.update(scan, odometry)

    assert scan_matcher.local_map is local_map


@pytest.mark.parametrize("jump", [30.0, 1e2, 1e4, 1e6, 1e7, 1e8, 1e9, 1e13, 1e300])
def test_one_impossible_step_of_odometry_costs_nothing(jump, expected):
    shifted = Pose2(jump, jump / 3.0, 2.0)
    readings = with_glitch(lambda scan, odometry: (scan, Odometry(odometry.stamp, shifted)))
    scan_matcher, found = follow(readings)

    assert scan_matcher.refused_count == 2  # there and back
    assert [GLITCH, GLITCH + 1] == [k for k, motion in enumerate(found) if motion.odometry_refused]
    assert (
        max(distance(a.odom_from_base, b.odom_from_base) for a, b in zip(found, expected, strict=True)) < 0.15
    )


@pytest.mark.parametrize("jump", [1e3, 1e8])
def test_odometry_that_jumps_and_stays_there_is_used_again_at_once(jump, expected):
    readings = readings_of(walk())
    shift = Pose2(jump, 0.0, 1.0)
    readings[GLITCH:] = [(scan, Odometry(o.stamp, shift @ o.odom_from_base)) for scan, o in readings[GLITCH:]]
    scan_matcher, found = follow(readings)

    assert scan_matcher.refused_count == 1
    assert distance(found[-1].odom_from_base, expected[-1].odom_from_base) < 0.15


@pytest.mark.parametrize("value", [1e9, 1e300, math.nan, math.inf, -math.inf, 0.0, 1e-300])
def test_one_scan_of_absurd_ranges_costs_nothing(value, expected):
    readings = with_glitch(
        lambda scan, odometry: (replace(scan, ranges=np.full(len(scan), value), range_max=math.inf), odometry)
    )
    _, found = follow(readings)

    assert distance(found[-1].odom_from_base, expected[-1].odom_from_base) < 0.1


def test_one_absurd_range_among_good_ones_costs_nothing(expected):
    def spoilt(scan, odometry):
        ranges = scan.ranges.copy()
        ranges[::7] = 1e300
        return replace(scan, ranges=ranges, range_max=math.inf), odometry

    _, found = follow(with_glitch(spoilt))

    assert distance(found[-1].odom_from_base, expected[-1].odom_from_base) < 0.1


def test_an_update_that_raises_leaves_the_state_as_it_was(monkeypatch):
    readings = readings_of(walk())
    scan_matcher, _ = follow(readings[:10])
    before = dict(vars(scan_matcher))

    def fail(*_):
        raise MemoryError

    with monkeypatch.context() as patch:
        patch.setattr(LocalMap, "extended", fail)
        with pytest.raises(MemoryError):
            scan_matcher.update(*readings[12])

    assert before == vars(scan_matcher)


def test_with_no_scan_to_tell_an_impossible_step_does_not_move():
    scan_matcher = ScanMatcher()
    blind = LaserScan(0.0, 0.0, 0.1, np.full(5, math.inf))
    scan_matcher.update(blind, Odometry(0.0, Pose2.identity()))
    motion = scan_matcher.update(blind, Odometry(0.5, Pose2(1e6, 0.0, 0.0)))

    assert motion.last_from_base == Pose2.identity()
    assert motion.odometry_refused


@needs_logs
@pytest.mark.parametrize("jump", [1e2, 1e9])
def test_one_jump_in_a_real_log_costs_nothing(jump):
    log = open_log(LOGS / "freiburg-101.log.gz")
    readings = [(reading.scan, reading.odometry) for reading in log.readings[:90]]
    _, expected = follow(readings)
    scan, odometry = readings[40]
    readings[40] = (scan, Odometry(odometry.stamp, Pose2(jump, 0.0, 0.0)))
    _, found = follow(readings)

    assert distance(found[-1].odom_from_base, expected[-1].odom_from_base) < 0.5


@needs_logs
@pytest.mark.parametrize("name", ["freiburg-101", "belgioioso"])
def test_real_logs_are_followed_even_with_bad_odometry(name):
    log, truth = open_log(LOGS / f"{name}.log.gz"), read_trajectory(LOGS / f"{name}.truth.tum")
    poses = [truth.pose(i) for i in associate(np.array([r.scan.stamp for r in log]), truth)]
    kept = thin(poses, 0.5, math.radians(20.0))[:60]
    readings = [log.readings[i] for i in kept]
    reported = motions([reading.odometry.odom_from_base for reading in readings])
    spoilt = spoil(reported, np.random.default_rng(0), place_per_meter=0.3, turn_per_meter=math.radians(20.0))
    _, found = follow(
        (reading.scan, Odometry(reading.odometry.stamp, pose))
        for reading, pose in zip(readings, chain(spoilt), strict=True)
    )
    errors = motion_errors([m.last_from_base for m in found[1:]], motions([poses[i] for i in kept]))

    assert np.mean((errors.place < 0.2) & (errors.turn < math.radians(3.0))) >= 0.95


def test_shape_alone_follows_more_roughly():
    readings = readings_of(walk())[:8]
    _, found = follow(readings, ScanMatchingSettings(method=Method.SHAPES))
    _, expected = follow(readings)

    assert distance(found[-1].odom_from_base, expected[-1].odom_from_base) < 0.5


@pytest.mark.parametrize("wrong", [{"window": 0.0}, {"keyframe_distance": math.nan}, {"keyframe_turn": -0.1}])
def test_invalid_settings_are_rejected(wrong):
    with pytest.raises(ValueError, match=f"{next(iter(wrong))} must be"):
        ScanMatchingSettings(**wrong)


def test_the_settings_of_perception_reach_the_shapes():
    settings = ScanMatchingSettings(perception=PerceptionSettings(min_relevance=0.0))
    scan, odometry = readings_of(walk())[0]
    fine, coarse = (ScanMatcher(s).update(scan, odometry).shapes for s in (settings, None))

    assert sum(len(shape.polyline) for shape in fine) > sum(len(shape.polyline) for shape in coarse)
