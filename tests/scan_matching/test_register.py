"""A robot in a room of known walls is found where it is."""

import math
from dataclasses import replace

import numpy as np
import pytest

from buildings import scan_at
from pilotage.geometry import Polyline, Pose2
from pilotage.perception import PerceptionSettings, perceive
from pilotage.scan_matching import LocalMap, Method, MotionPrior, OdometryNoise, register
from pilotage.scan_matching.register import find_unmatched

ROOM = (
    Polyline.through([(-4, -3), (5, -3), (5, 2), (2, 2), (2, 4), (-4, 4)], closed=True),
    Polyline.through([(-2, 0), (-1, 0.5), (-1.5, 1.5)], closed=True),
)
"""A room with a corner cut out, and a pillar of three sides."""

NOISE = 0.01
"""Standard deviation [m] of a range."""


def shapes_at(pose, seed=0, walls=ROOM):
    """Perceive what a laser that looks all around sees."""
    scan = scan_at(pose, beams=360, fov=math.radians(359.0), walls=walls)
    ranges = scan.ranges + np.random.default_rng(seed).normal(0.0, NOISE, len(scan))
    return perceive(replace(scan, ranges=ranges), PerceptionSettings())


def map_seen_from(pose, walls=ROOM):
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
    new = find_unmatched(shapes, local_map, registration.odom_from_base)

    lengths = np.array([shape.polyline.length for shape in shapes])
    assert lengths[list(new)].sum() < 0.1 * lengths.sum()


def test_along_a_corridor_good_odometry_holds():
    corridor = (Polyline.through([(-20, -1), (20, -1)]), Polyline.through([(20, 1), (-20, 1)]))
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
