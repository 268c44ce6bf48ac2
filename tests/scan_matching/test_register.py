"""A robot in a room of known walls is found where it is."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pilotage.evaluation.trajectory import associate, chain, motion_errors, motions, spoil, thin
from pilotage.geometry import Pose2
from pilotage.io.logs import open_log
from pilotage.io.tum import read_trajectory
from pilotage.perception import LaserScan, Odometry, PerceptionSettings, Reading, perceive
from pilotage.scan_matching import OdometryNoise, PerceptionMap
from pilotage.scan_matching.overlap import OverlapSettings
from pilotage.scan_matching.register import Method, RegistrationSettings, register
from pilotage.scan_matching.settings import SearchSettings
from shared_data import LOGS, needs_logs

WALLS = (
    ((-4, -3), (5, -3)),
    ((5, -3), (5, 2)),
    ((5, 2), (2, 2)),
    ((2, 2), (2, 4)),
    ((2, 4), (-4, 4)),
    ((-4, 4), (-4, -3)),
    ((-2, 0), (-1, 0.5)),
    ((-1, 0.5), (-1.5, 1.5)),
    ((-1.5, 1.5), (-2, 0)),
)
SETTINGS = RegistrationSettings()


def scan_at(pose, seed=0, walls=WALLS, noise=0.01):
    """What a laser of 360 beams a full turn sees in the room."""
    directions = np.radians(np.arange(-180.0, 180.0))
    ranges = np.full(360, np.inf)
    for (ax, ay), (bx, by) in walls:
        dx, dy = bx - ax, by - ay
        c, s = np.cos(directions + pose.theta), np.sin(directions + pose.theta)
        px, py = ax - pose.x, ay - pose.y
        det = c * dy - s * dx
        with np.errstate(divide="ignore", invalid="ignore"):
            r, along = (px * dy - py * dx) / det, (px * s - py * c) / det
        hit = (r > 0.0) & (along >= 0.0) & (along <= 1.0)
        ranges = np.where(hit & (r < ranges), r, ranges)
    ranges += np.random.default_rng(seed).normal(0.0, noise, 360)
    return LaserScan(0.0, -math.pi, math.radians(1.0), ranges, range_max=30.0)


def shapes_at(pose, seed=0, walls=WALLS):
    return perceive(scan_at(pose, seed, walls), PerceptionSettings())


def map_seen_from(pose, walls=WALLS):
    first = register(shapes_at(pose, 0, walls), PerceptionMap(), Odometry(0.0, pose), SETTINGS)
    return PerceptionMap().merged(first)


def error(registration, true):
    off = true.inverse() @ registration.last_from_base
    return math.hypot(off.x, off.y), abs(off.theta)


START = Pose2(0.0, -1.0, 0.3)


@pytest.mark.parametrize(
    ("motion", "reported"),
    [
        (Pose2(0.5, 0.0, 0.1), Pose2(0.5, 0.0, 0.1)),
        (Pose2(0.5, 0.0, 0.1), Pose2(0.7, 0.1, 0.3)),
        (Pose2(0.5, 0.1, -0.6), Pose2(0.6, 0.0, 0.0)),
        (Pose2(-0.6, 0.0, 0.1), Pose2(0.6, 0.0, 0.1)),  # odometry that does not know forward from backward
    ],
)
def test_motion_is_found_although_odometry_errs(motion, reported):
    perception_map = map_seen_from(START)
    shapes = shapes_at(START @ motion, seed=1)
    registration = register(shapes, perception_map, Odometry(1.0, START @ reported), SETTINGS)
    place, turn = error(registration, motion)

    assert place < 0.05
    assert turn < math.radians(1.0)
    assert registration.support > 0.5
    assert registration.residual < 0.05


def test_the_first_reading_does_not_move():
    registration = register(shapes_at(START), PerceptionMap(), Odometry(0.0, Pose2(3, 4, 1)), SETTINGS)

    assert registration.odom_from_base == Pose2.identity()
    assert registration.support == 0.0
    assert registration.unmatched == tuple(range(len(registration.shapes)))


def test_a_scan_that_shows_nothing_moves_by_odometry():
    perception_map = map_seen_from(START)
    motion = Pose2(0.4, 0.0, 0.2)
    registration = register((), perception_map, Odometry(1.0, START @ motion), SETTINGS)
    place, turn = error(registration, motion)

    assert place == pytest.approx(0.0, abs=1e-12)
    assert turn == pytest.approx(0.0, abs=1e-12)
    assert registration.correspondences == ()


@pytest.mark.parametrize("jump", [50.0, 1e6])
def test_odometry_that_jumps_costs_no_more_than_a_step(jump):
    perception_map = map_seen_from(START)
    registration = register(
        shapes_at(START), perception_map, Odometry(1.0, START @ Pose2(jump, 0.0, 0.0)), SETTINGS
    )
    after = perception_map.merged(registration)

    assert registration.last_from_base.x == pytest.approx(jump, rel=0.1)
    assert len(after.shapes) <= len(registration.shapes)


def test_what_is_seen_again_corresponds_and_is_not_entered_twice():
    perception_map = map_seen_from(START)
    motion = Pose2(0.4, 0.0, 0.0)
    registration = register(
        shapes_at(START @ motion, seed=1), perception_map, Odometry(1.0, START @ motion), SETTINGS
    )

    assert len(registration.correspondences) > 0
    assert {c.seen for c in registration.correspondences}.isdisjoint(registration.unmatched)
    assert all(c.dissimilarity <= OverlapSettings().distance for c in registration.correspondences)
    assert len(perception_map.merged(registration).shapes) < 2 * len(perception_map.shapes)


def test_along_a_corridor_good_odometry_holds_and_the_covariance_is_long():
    corridor = [((-20, -1), (20, -1)), ((20, 1), (-20, 1))]
    good = OdometryNoise(place_per_meter=0.02, turn_per_meter=math.radians(3.0))
    perception_map = replace(map_seen_from(Pose2.identity(), corridor), noise=good)
    motion = Pose2(0.5, 0.0, 0.0)
    registration = register(shapes_at(motion, 1, corridor), perception_map, Odometry(1.0, motion), SETTINGS)
    along, across = registration.covariance[0, 0], registration.covariance[1, 1]

    assert along > 3.0 * across
    assert registration.last_from_base.x == pytest.approx(0.5, abs=0.05)


def test_equal_input_gives_equal_output():
    perception_map = map_seen_from(START)
    odometry = Odometry(1.0, START @ Pose2(0.5, 0.1, 0.2))
    shapes = shapes_at(START @ Pose2(0.4, 0.0, 0.0))
    first, second = (register(shapes, perception_map, odometry, SETTINGS) for _ in range(2))

    assert first.odom_from_base == second.odom_from_base


def test_shape_alone_finds_the_room_more_roughly():
    motion = Pose2(0.3, 0.0, 0.1)
    perception_map = map_seen_from(START)
    registration = register(
        shapes_at(START @ motion, seed=1),
        perception_map,
        Odometry(1.0, START @ Pose2(0.35, 0.02, 0.15)),
        replace(SETTINGS, method=Method.SHAPES),
    )
    place, turn = error(registration, motion)

    assert place < 0.3
    assert turn < math.radians(3.0)


def follow(readings, steps):
    perception_map, found = PerceptionMap(), []
    for reading, odom_from_base in zip(readings, chain(steps), strict=True):
        shapes = perceive(reading.scan, PerceptionSettings())
        odometry = Odometry(reading.odometry.stamp, odom_from_base)
        registration = register(shapes, perception_map, odometry, SETTINGS)
        perception_map = perception_map.merged(registration)
        found.append(registration.last_from_base)
    return found[1:]


@needs_logs
@pytest.mark.parametrize("name", ["freiburg-101", "belgioioso"])
def test_real_logs_are_followed_even_with_bad_odometry(name):
    log, truth = open_log(LOGS / f"{name}.log.gz"), read_trajectory(LOGS / f"{name}.truth.tum")
    poses = [truth.pose(i) for i in associate(np.array([r.scan.stamp for r in log]), truth)]
    kept = thin(poses, 0.5, math.radians(20.0))[:80]
    readings: list[Reading] = [log.readings[i] for i in kept]
    reported = motions([reading.odometry.odom_from_base for reading in readings])
    spoilt = spoil(reported, np.random.default_rng(0), place_per_meter=0.3, turn_per_meter=math.radians(20.0))
    errors = motion_errors(follow(readings, spoilt), motions([poses[i] for i in kept]))

    assert np.mean((errors.place < 0.2) & (errors.turn < math.radians(3.0))) >= 0.95


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: RegistrationSettings(widths=()),
        lambda: RegistrationSettings(widths=(0.1, 0.0)),
        lambda: RegistrationSettings(sample_step=math.nan),
        lambda: RegistrationSettings(penalty=-1.0),
        lambda: SearchSettings(count=0),
        lambda: SearchSettings(turn_step=0.0),
        lambda: SearchSettings(max_place=math.inf),
        lambda: OverlapSettings(share=0.0),
        lambda: OverlapSettings(distance=-0.1),
    ],
)
def test_settings_that_cannot_be_meant_are_refused(wrong):
    with pytest.raises(ValueError, match="must"):
        wrong()
