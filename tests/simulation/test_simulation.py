"""A simulated robot in a simulated building."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pilotage.geometry import Polyline, Pose2
from pilotage.maps import SchematicMap
from pilotage.simulation import (
    DriveSettings,
    LaserSettings,
    Movers,
    OdometrySettings,
    RunSettings,
    World,
    follow,
    reckon,
    sense,
    simulate,
)

ROOM = World.of(SchematicMap((Polyline.through([(-2, -3), (5, -3), (5, 4), (-2, 4)], closed=True),)))
EXACT = LaserSettings(beams=361, field_of_view=2 * math.pi, noise=0.0, dropout=0.0)
SURE = OdometrySettings(slip=0.0, drift=0.0, turn_slip=0.0)
PATH = [(0, 0), (3, 0), (3, 2), (0, 2), (0, -1)]


@given(
    x=st.floats(-1.9, 4.9),
    y=st.floats(-2.9, 3.9),
    theta=st.floats(-3.1, 3.1),
    mount=st.builds(Pose2, st.floats(-0.05, 0.05), st.floats(-0.05, 0.05), st.floats(-3, 3)),
)
@settings(max_examples=40)
def test_returns_lie_on_the_walls_wherever_the_laser_is_mounted(x, y, theta, mount):
    laser = LaserSettings(beams=90, field_of_view=6.0, noise=0.0, dropout=0.0, base_from_laser=mount)
    pose = Pose2(x, y, theta)
    scan = sense(ROOM, pose, 0.0, np.random.default_rng(0), laser)

    assert scan.returned.all()
    np.testing.assert_allclose(0.0, ROOM.clearance(pose @ scan.points_in_base), atol=1e-9)


def test_noise_and_dropouts_have_the_size_that_was_asked_for():
    rng = np.random.default_rng(3)
    laser = LaserSettings(beams=20_001, noise=0.02, dropout=0.1)
    pose = Pose2(1.0, 0.0, 0.3)
    noisy = sense(ROOM, pose, 0.0, rng, laser)
    true = sense(ROOM, pose, 0.0, rng, LaserSettings(beams=20_001, noise=0.0, dropout=0.0))
    errors = (noisy.ranges - true.ranges)[noisy.returned]

    assert 0.1 == pytest.approx(1.0 - noisy.returned.mean(), abs=0.01)
    assert 0.02 == pytest.approx(errors.std(), abs=0.001)


def test_what_is_beyond_reach_does_not_return():
    scan = sense(
        ROOM,
        Pose2(0, 0, 0),
        0.0,
        np.random.default_rng(0),
        LaserSettings(range_max=4.5, noise=0.0, dropout=0.0),
    )

    assert math.inf == scan.ranges[90]
    assert 3.0 == pytest.approx(scan.ranges[0])


def test_glass_returns_what_meets_it_squarely_and_some_dust():
    glazed = World(ROOM.segments, glass=np.array([[3.0, -3.0, 3.0, 4.0]]))
    clean = LaserSettings(
        beams=7201, noise=0.0, dropout=0.0, glass_angle=math.radians(5.01), glass_return=0.0
    )
    dusty = LaserSettings(beams=7201, noise=0.0, dropout=0.0, glass_angle=0.0, glass_return=0.2)
    rng = np.random.default_rng(0)
    x = sense(glazed, Pose2(0, 0, 0), 0.0, rng, clean).points_in_base[:, 0]
    returned = np.isclose(3.0, sense(glazed, Pose2(0, 0, 0), 0.0, rng, dusty).points_in_base[:, 0])
    off_deg = np.abs(np.linspace(-90, 90, 7201))
    towards = off_deg < 40.0  # nothing but the glass is 3 m ahead there

    np.testing.assert_array_equal(off_deg[towards] <= 5.0, np.isclose(3.0, x[towards]))
    assert 0.2 == pytest.approx(returned[towards].mean(), abs=0.02)


def test_people_and_closed_doors_hide_what_is_behind():
    movers = Movers(np.array([[2.0, 0.0, 0.25]]), np.array([[1.0, 0.5, 1.0, 3.0]]))
    exact = LaserSettings(beams=5, noise=0.0, dropout=0.0)  # 45 degrees apart
    scan = sense(ROOM, Pose2(0, 0, 0), 0.0, np.random.default_rng(0), exact, movers=movers)

    np.testing.assert_allclose([3.0, 3.0 * math.sqrt(2), 1.75, math.sqrt(2), 4.0], scan.ranges)


def test_a_robot_stands_only_where_it_touches_nothing():
    world = World(ROOM.segments, glass=np.array([[3.0, -3.0, 3.0, 4.0]]))

    assert [True, False, False, True] == world.is_free([(0, 0), (4.9, 0), (2.9, 0), (3.5, 0)], 0.2).tolist()


def test_the_robot_keeps_to_its_path_and_arrives():
    poses = [moment.world_from_base for moment in follow(PATH, DriveSettings())]
    path = World.of(SchematicMap((Polyline.through(PATH),)))
    positions = np.array([pose.position for pose in poses])

    assert path.clearance(positions).max() < 0.35
    assert np.hypot(*(positions[-1] - PATH[-1])) < 0.3
    assert [0.0, 0.0] == positions[0].tolist()


def test_the_robot_moves_no_faster_than_it_can():
    drive = DriveSettings(speed=0.5, turn_rate=0.8, time_step=0.1)
    moments = list(follow(PATH, drive))
    moves = [a.world_from_base.inverse() @ b.world_from_base for a, b in pairwise(moments)]

    assert max(math.hypot(move.x, move.y) for move in moves) <= 0.05 + 1e-12
    assert max(abs(move.theta) for move in moves) <= 0.08 + 1e-12


def test_wheels_that_do_not_slip_report_the_truth():
    poses = [moment.world_from_base for moment in follow(PATH, DriveSettings())]
    reported = reckon(poses, np.random.default_rng(0), SURE)
    carried = [poses[0] @ pose for pose in reported]

    np.testing.assert_allclose(
        [[p.x, p.y, math.cos(p.theta)] for p in poses],
        [[p.x, p.y, math.cos(p.theta)] for p in carried],
        atol=1e-9,
    )


def test_odometry_errs_like_that_of_real_robots():
    poses = [Pose2(0.1 * k, 0.0, 0.0) for k in range(5001)]
    reported = reckon(poses, np.random.default_rng(1), OdometrySettings())
    meters = [reported[k].inverse() @ reported[k + 10] for k in range(0, 5000, 10)]
    slips = np.array([move.x - 1.0 for move in meters])
    drifts = np.degrees([move.theta for move in meters])

    assert 0.04 < np.sqrt(np.mean(slips**2)) < 0.10
    assert 1.0 < np.sqrt(np.mean(drifts**2)) < 4.0


def test_the_same_seed_gives_the_same_run():
    first, again = (simulate(ROOM, PATH, np.random.default_rng(7), RunSettings()) for _ in range(2))

    assert first.truth == again.truth
    assert all(
        np.array_equal(a.scan.ranges, b.scan.ranges) and a.odometry == b.odometry
        for a, b in zip(first.readings, again.readings, strict=True)
    )


def test_scans_are_taken_where_the_robot_has_moved_on():
    settings = RunSettings(scan_every=0.5, scan_every_turn=0.4)
    truth = simulate(ROOM, PATH, np.random.default_rng(0), settings).truth
    moves = [a.world_from_base.inverse() @ b.world_from_base for a, b in pairwise(truth)]

    assert all(math.hypot(move.x, move.y) >= 0.5 or abs(move.theta) >= 0.4 for move in moves)
    assert all(math.hypot(move.x, move.y) <= 0.6 for move in moves)


@pytest.mark.parametrize(
    ("make", "rule"),
    [
        (lambda: World(np.zeros((3, 3))), "segments must have shape"),
        (lambda: World(np.full((1, 4), np.nan)), "segments must be finite"),
        (lambda: LaserSettings(beams=1), "beams must be at least 2"),
        (lambda: LaserSettings(field_of_view=7.0), "field_of_view must be in"),
        (lambda: LaserSettings(range_max=-1.0), "range_max must be > 0 m"),
        (lambda: LaserSettings(noise=math.nan), "noise must be >= 0 m"),
        (lambda: LaserSettings(dropout=1.5), "dropout must be in"),
        (lambda: LaserSettings(glass_angle=2.0), "glass_angle must be in"),
        (lambda: LaserSettings(glass_return=-0.1), "glass_return must be in"),
        (lambda: Movers(np.zeros((1, 2)), np.zeros((0, 4))), "people must have shape"),
        (lambda: DriveSettings(speed=0.0), "speed must be > 0"),
        (lambda: OdometrySettings(slip=-0.1), "slip must be >= 0"),
        (lambda: RunSettings(scan_every=0.0), "scan_every must be > 0"),
        (lambda: list(follow([(0, 0)], DriveSettings())), "waypoints must hold at least 2"),
    ],
)
def test_invalid_values_are_rejected(make, rule):
    with pytest.raises(ValueError, match=rule):
        make()
