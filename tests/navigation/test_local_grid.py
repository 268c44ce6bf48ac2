"""What the grid keeps of scans while it moves along, and where a disc can go on it."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from buildings import WALLS, scan_at
from pilotage.geometry import Polyline, Pose2
from pilotage.navigation.local_grid import NO_RETURN, LocalGrid, densified
from pilotage.perception import LaserScan
from strategies import angles, poses

SIZE, CELL = 10.0, 0.05
RADIUS = 0.2
ALL_AROUND = {"beams": 720, "fov": math.tau * 719 / 720}
BLIND = LaserScan(0.0, -1.0, 0.1, np.full(21, np.nan))
HERE = Pose2(1.5, 5.0, -1.2)


def seen_from(pose, walls=WALLS, **laser):
    """Look once, where odometry is right."""
    return LocalGrid.unknown(SIZE).seen(scan_at(pose, walls=walls, **laser), pose)


def evidence_at(grid, points):
    """Look points of odom up; 0 off the square."""
    cells = grid.cells_at(points)
    inside = ((cells >= 0) & (cells < len(grid.evidence))).all(axis=1)
    return np.where(inside, grid.evidence[tuple(np.where(inside[:, None], cells, 0).T)], 0), inside


def test_obstacles_are_where_the_beams_ended():
    pose = Pose2(0.013, 0.017, 0.0) @ HERE  # no wall along the border of cells
    scan = scan_at(HERE, **ALL_AROUND)
    grid = LocalGrid.unknown(SIZE).seen(scan, pose)

    ends = pose @ scan.points_in_base
    seen, inside = evidence_at(grid, ends)
    assert (seen[inside] > 0).all()
    away = shapely.distance(shapely.MultiPoint(ends), shapely.points(grid.obstacles))
    assert grid.cell > away.max()


@pytest.mark.parametrize(("fov", "is_seen_free"), [(math.pi, True), (math.tau * 179 / 180, False)])
def test_the_last_beam_is_beside_the_first_only_if_the_scanner_sees_all_around(fov, is_seen_free):
    ranges = np.full(180, 2.0)
    ranges[:2] = np.inf  # two beams without return are free space, one between returns may be glass
    scan = LaserScan(0.0, 0.0, fov / 179, ranges)
    grid = LocalGrid.unknown(SIZE).seen(scan, Pose2.identity())

    ahead = np.array([[1.5, 0.0]])
    assert is_seen_free == (evidence_at(grid, ahead)[0][0] < 0)


def test_a_laser_that_is_mounted_anywhere_sees_the_same_obstacles():
    base_from_laser = Pose2(-0.3, 0.1, 2.5)
    scan = scan_at(HERE @ base_from_laser, **ALL_AROUND)
    mounted = LaserScan(
        0.0, scan.angle_min, scan.angle_increment, scan.ranges, base_from_laser=base_from_laser
    )
    grid = LocalGrid.unknown(SIZE).seen(mounted, HERE)

    walls = shapely.MultiLineString([wall.ring for wall in WALLS])
    assert len(grid.obstacles) > 100
    assert grid.cell > shapely.distance(walls, shapely.points(grid.obstacles)).max()


@given(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0), angles)
def test_what_was_seen_stays_where_it_is_while_the_square_moves_along(x, y, theta):
    before = seen_from(HERE)
    after = before.seen(BLIND, Pose2(x, y, theta))

    grid = np.mgrid[-6:10:0.21, -2:12:0.21].reshape(2, -1).T + 0.013
    then, _ = evidence_at(before, grid)
    now, kept = evidence_at(after, grid)
    np.testing.assert_array_equal(now[kept], then[kept])
    size, cell = SIZE, CELL
    assert evidence_at(after, np.array([[x, y]]))[1][0]
    middle = after.middles(np.array([[round(SIZE / CELL) // 2] * 2]))[0]
    assert max(abs(middle - (x, y))) < size / 8.0 + cell


def test_looking_changes_nothing_that_was_there_before():
    before = seen_from(HERE)
    evidence = before.evidence.copy()
    before.seen(scan_at(Pose2(1.5, 4.9, 0.0)), Pose2(1.5, 4.9, 0.0))

    np.testing.assert_array_equal(evidence, before.evidence)


@given(poses)
def test_cells_and_their_middles_belong_together(pose):
    grid = LocalGrid.unknown(SIZE).seen(BLIND, pose)
    cells = np.array([[0, 0], [5, 7], [round(SIZE / CELL) - 1, 3]])

    np.testing.assert_array_equal(cells, grid.cells_at(grid.middles(cells)))


@given(st.floats(0.5, 3.0), st.floats(-1.3, 1.3), angles)
def test_no_stripes_stay_unseen_between_the_beams(away, bearing, heading):
    turned = Pose2(4.0, 1.5, heading)
    scan = LaserScan(0.0, -math.pi / 2, math.pi / 180, np.full(181, 3.5))
    grid = LocalGrid.unknown(SIZE).seen(scan, turned)

    point = turned @ np.array([[away * math.cos(bearing), away * math.sin(bearing)]])
    assert evidence_at(grid, point)[0][0] < 0


def test_nothing_is_seen_behind_a_laser_that_looks_ahead():
    scan = LaserScan(0.0, -math.pi / 2, math.pi / 180, np.full(181, 3.5))
    grid = LocalGrid.unknown(SIZE).seen(scan, Pose2.identity())

    seen = grid.middles(np.argwhere(grid.evidence != 0))
    assert -0.1 < seen[:, 0].min()


@given(
    st.integers(2, 60),
    st.floats(-3.0, 3.0),
    st.sampled_from([-1, 1]),
    st.sampled_from([0.5, 0.9, 1.0]),
    st.integers(0, 2**32 - 1),
)
def test_interpolated_beams_lie_between_neighbors_and_are_as_long_as_the_shorter(
    count, first, sense, share, seed
):
    rng = np.random.default_rng(seed)
    directions = first + sense * share * math.tau * np.arange(count) / count
    ranges, returned = rng.uniform(0.0, 9.0, count), rng.random(count) < 0.5

    between, lengths, hits = densified(directions, ranges, returned)

    np.testing.assert_array_equal(directions, between[:count])
    np.testing.assert_array_equal(ranges, lengths[:count])
    np.testing.assert_array_equal(returned, hits[:count])
    assert not hits[count:].any()
    assert len(between) == len(lengths) == len(hits) > count
    ahead = np.remainder(directions - between[count:, np.newaxis], math.tau)
    left, right = ahead.argmin(axis=1), ahead.argmax(axis=1)
    assert (lengths[count:] == np.minimum(ranges[left], ranges[right])).all()


@pytest.mark.parametrize(("share", "closes"), [(1.0, True), (0.9, False), (0.5, False)])
def test_the_last_beam_is_beside_the_first_if_the_laser_looks_all_around(share, closes):
    directions = np.linspace(0.0, share * math.tau, 90, endpoint=False)
    between, _, _ = densified(directions, np.ones(90), np.ones(90, dtype=bool))

    assert closes is bool((between > directions[-1]).any())


def test_one_beam_is_a_scan_too():
    beams = densified(np.zeros(1), np.ones(1), np.ones(1, dtype=bool))

    assert [1, 1, 1] == [len(one) for one in beams]


def test_what_does_not_come_back_is_free_for_a_while_unless_it_stands_alone():
    ranges = np.full(181, np.nan)
    ranges[20:40] = np.inf
    ranges[120] = np.inf
    scan = LaserScan(0.0, -math.pi / 2, math.pi / 180, ranges)
    grid = LocalGrid.unknown(SIZE).seen(scan, Pose2.identity())

    def at(beam, away):
        direction = scan.directions[beam]
        point = np.array([[away * math.cos(direction), away * math.sin(direction)]])
        return int(evidence_at(grid, point)[0][0])

    assert at(30, NO_RETURN - 0.2) < 0
    assert 0 == at(30, NO_RETURN + 0.2)
    assert 0 == at(120, 0.97)


def test_a_person_who_walks_away_is_soon_no_obstacle():
    person = Polyline.through([(1.4, 3.0), (1.6, 3.0), (1.5, 3.2)], closed=True)
    grid = LocalGrid.unknown(SIZE)
    for walls in [(*WALLS, person)] * 20 + [WALLS] * 6:
        grid = grid.seen(scan_at(HERE, walls=walls, **ALL_AROUND), HERE)

    assert 0.5 < np.hypot(*(grid.obstacles - (1.5, 3.1)).T).min()


@pytest.mark.parametrize("pose", [HERE, Pose2(6.5, 1.5, 2.0), Pose2(8.5, 5.0, 0.0)])
def test_paths_lead_from_the_robot_over_free_cells_and_clear_of_all_walls(pose):
    grid = seen_from(pose, **ALL_AROUND)
    reach = grid.reachable_set(RADIUS)
    returns = shapely.MultiPoint(pose @ scan_at(pose, **ALL_AROUND).points_in_base)

    assert len(reach.points) > 500
    for index in range(0, len(reach.points), len(reach.points) // 40):
        path = reach.path_to(index)
        np.testing.assert_allclose(reach.points[index], path[-1])
        assert CELL > np.hypot(*(path[0] - pose.position))
        steps = np.diff(path, axis=0) / CELL
        assert (np.abs(steps).max(axis=1, initial=0.0).round(6) == 1.0).all() or len(path) == 1
        assert (evidence_at(grid, path)[0] < 0).all()
        assert RADIUS < returns.distance(shapely.MultiPoint(path))


def test_a_path_is_no_longer_than_it_costs():
    reach = seen_from(HERE, **ALL_AROUND).reachable_set(RADIUS)

    for index in range(0, len(reach.points), len(reach.points) // 40):
        length = np.hypot(*np.diff(reach.path_to(index), axis=0).T).sum()
        # a diagonal step counts 1.4, a little less than it is long
        assert 0.98 * length <= reach.lengths[index]


def test_the_nearest_place_is_the_nearest_unless_the_path_or_the_place_itself_costs_more():
    reach = seen_from(Pose2(2.0, 2.0, 0.0)).reachable_set(0.2)
    point = reach.points[reach.lengths.argmax()]
    west = reach.points[:, 0] < point[0]

    def gap(index):
        return np.hypot(*(reach.points[index] - point))

    free = np.zeros(len(west))
    assert 0.0 == gap(reach.nearest(point, path_cost=0.0, extra=free))
    assert 0.1 < gap(reach.nearest(point, path_cost=1.5, extra=free))
    assert west[reach.nearest(point, path_cost=0.0, extra=np.where(west, 0.0, 1.0))]
    assert 0.0 == gap(reach.nearest(point, path_cost=0.0, extra=np.where(west, 0.0, 0.01)))


def divided(gap):
    """Two rooms, and a gap so wide in the wall at x = 3 between them [m]."""
    return (
        Polyline.through([(0, 0), (6, 0), (6, 4), (0, 4)], closed=True),
        Polyline.through([(3, 0), (3, 2 - gap / 2)]),
        Polyline.through([(3, 2 + gap / 2), (3, 4)]),
    )


@pytest.mark.parametrize(("gap", "passes"), [(0.0, False), (0.3, False), (0.7, True)])
def test_a_wall_is_gone_through_where_the_robot_fits(gap, passes):
    pose = Pose2(1.0, 2.0, 0.0)
    grid = seen_from(pose, divided(gap), **ALL_AROUND)
    reach = grid.reachable_set(RADIUS)
    free = grid.middles(np.argwhere(grid.evidence < 0))

    assert (gap > 0.0) is bool((free[:, 0] > 3.2).any())
    assert passes is bool((reach.points[:, 0] > 3.0).any())
    if not passes:
        assert 3.0 - RADIUS > reach.points[:, 0].max()


def test_a_larger_robot_reaches_less():
    grid = seen_from(HERE, **ALL_AROUND)
    small, large = (
        {tuple(cell) for cell in grid.reachable_set(radius).cells.tolist()} for radius in (0.1, 0.3)
    )

    assert large < small


@pytest.mark.parametrize("radius", [0.2, 1.0, 1.5])
def test_a_robot_of_any_size_moves_where_there_is_room(radius):
    hall = (Polyline.through([(0, 0), (9, 0), (9, 9), (0, 9)], closed=True),)
    reachable = seen_from(Pose2(4.5, 4.5, 0.0), hall, **ALL_AROUND).reachable_set(radius)

    farthest = np.abs(reachable.points - 4.5).max()
    assert 4.5 - radius == pytest.approx(farthest, abs=0.15)


def test_a_robot_that_stands_at_a_wall_finds_a_way_off_it():
    reach = seen_from(Pose2(1.0 + RADIUS, 2.0, 0.0), divided(0.0), **ALL_AROUND).reachable_set(RADIUS)
    at_wall = seen_from(Pose2(RADIUS + 0.005, 2.0, 0.0), divided(0.0), **ALL_AROUND).reachable_set(RADIUS)

    assert 0.9 < len(at_wall.points) / len(reach.points)


@settings(max_examples=15)
@given(poses)
def test_where_the_robot_can_go_does_not_depend_on_the_frame(odom_from_world):
    wide, scan = LocalGrid.unknown(18.0), scan_at(HERE, **ALL_AROUND)
    here = wide.seen(scan, HERE).reachable_set(RADIUS)
    there = wide.seen(scan, odom_from_world @ HERE).reachable_set(RADIUS)

    assert math.isclose(len(here.points), len(there.points), rel_tol=0.05)
    back = odom_from_world.inverse() @ there.points
    floor = shapely.Polygon(np.vstack([WALLS[0].vertices, WALLS[1].vertices]))
    assert floor.buffer(1e-9).covers(shapely.MultiPoint(back))


def test_a_blind_robot_can_stay_where_it_is():
    reach = LocalGrid.unknown(SIZE).seen(BLIND, HERE).reachable_set(RADIUS)

    assert np.hypot(*(reach.points - HERE.position).T).min() < CELL
