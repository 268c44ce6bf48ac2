"""A robot in a room of known walls is found where it is."""

import math

import numpy as np
import pytest

from pilotage.geometry import Pose2
from pilotage.perception import LaserScan, PerceptionSettings, perceive
from pilotage.scan_matching import LocalMap, Method, MotionPrior, OdometryNoise, register
from pilotage.scan_matching.register import find_unmatched

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
    """The local map of a robot that took one scan, in the frame of the room."""
    shapes = tuple(shape.moved(pose) for shape in shapes_at(pose, 0, walls))
    return LocalMap().extended(shapes, 0.0, window=10.0)


def prior_of(motion, noise=None):
    """What odometry tells of a robot that stood at the start."""
    return MotionPrior.of(motion, START, noise or OdometryNoise())


def error(registration, true):
    off = true.inverse() @ registration.odom_from_base
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
    shapes = shapes_at(START @ motion, seed=1)
    registration = register(shapes, map_seen_from(START), prior_of(reported))
    position, heading = error(registration, START @ motion)

    assert position < 0.05
    assert heading < math.radians(1.0)
    assert registration.inlier_share > 0.5


@pytest.mark.parametrize("motion", [Pose2(0.5, 0.1, -0.4), Pose2(-1.0, 0.2, 0.3)])
def test_an_unknown_motion_is_found(motion):
    shapes = shapes_at(START @ motion, seed=1)
    registration = register(shapes, map_seen_from(START), MotionPrior.unknown(START))
    position, heading = error(registration, START @ motion)

    assert position < 0.05
    assert heading < math.radians(1.0)


def test_into_an_empty_map_all_is_new():
    shapes = shapes_at(START)
    registration = register(shapes, LocalMap(), prior_of(Pose2.identity()))

    assert registration.odom_from_base == START
    assert registration.inlier_share == 0.0
    assert find_unmatched(shapes, LocalMap(), registration.odom_from_base) == tuple(range(len(shapes)))


def test_a_scan_that_shows_nothing_moves_by_odometry():
    motion = Pose2(0.4, 0.0, 0.2)
    local_map = map_seen_from(START)
    registration = register((), local_map, prior_of(motion))

    assert registration.odom_from_base == START @ motion
    assert registration.fit is None
    assert find_unmatched((), local_map, registration.odom_from_base) == ()


def test_what_is_seen_again_is_not_new():
    local_map, motion = map_seen_from(START), Pose2(0.4, 0.0, 0.0)
    shapes = shapes_at(START @ motion, seed=1)
    registration = register(shapes, local_map, prior_of(motion))

    assert len(find_unmatched(shapes, local_map, registration.odom_from_base)) < len(shapes)


def test_along_a_corridor_good_odometry_holds():
    corridor = [((-20, -1), (20, -1)), ((20, 1), (-20, 1))]
    good = OdometryNoise(position_per_meter=0.02, heading_per_meter=math.radians(3.0))
    motion = Pose2(0.5, 0.0, 0.0)
    prior = MotionPrior.of(motion, Pose2.identity(), good)
    registration = register(shapes_at(motion, 1, corridor), map_seen_from(Pose2.identity(), corridor), prior)

    assert registration.odom_from_base.x == pytest.approx(0.5, abs=0.05)


def test_equal_input_gives_equal_output():
    local_map, prior = map_seen_from(START), prior_of(Pose2(0.5, 0.1, 0.2))
    shapes = shapes_at(START @ Pose2(0.4, 0.0, 0.0))
    first, second = (register(shapes, local_map, prior) for _ in range(2))

    assert first.odom_from_base == second.odom_from_base


def test_shape_alone_finds_the_room_more_roughly():
    motion = Pose2(0.3, 0.0, 0.1)
    registration = register(
        shapes_at(START @ motion, seed=1),
        map_seen_from(START),
        prior_of(Pose2(0.35, 0.02, 0.15)),
        Method.SHAPES,
    )
    position, heading = error(registration, START @ motion)

    assert position < 0.3
    assert heading < math.radians(3.0)
