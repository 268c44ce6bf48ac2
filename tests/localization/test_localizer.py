import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from buildings import WALLS, flat, readings_of, scan_at, walk
from pilotage.geometry import Polyline, Pose2, Similarity2
from pilotage.localization import AlignmentSettings, Localizer, LocalizerSettings, Status, TrackingSettings
from pilotage.maps import SchematicMap
from pilotage.perception import LaserScan, Odometry

SKETCH_FROM_WORLD = Similarity2(12.0, Pose2(40.0, -300.0, 2.0))
SMALL = LocalizerSettings(
    tracking=TrackingSettings(first_count=20_000, count=5_000, least=2_000),
    alignment=AlignmentSettings(proposals=2_000, kept=(500, 100)),
)


@pytest.fixture(scope="module")
def sketch():
    return flat(12.0, SKETCH_FROM_WORLD.pose)


def errors(estimates, poses):
    """Distance to the truth [m]."""
    found = np.array([estimate.sketch_from_base.pose.position for estimate in estimates])
    true = SKETCH_FROM_WORLD @ np.array([pose.position for pose in poses])
    return np.hypot(*(found - true).T) / SKETCH_FROM_WORLD.scale


@pytest.mark.parametrize("seed", range(3))
def test_a_robot_put_down_anywhere_finds_itself_on_a_turned_and_scaled_drawing(sketch, seed):
    poses = walk()
    localizer = Localizer(sketch, seed=seed)
    estimates = [localizer.update(*reading) for reading in readings_of(poses)]

    assert errors(estimates, poses)[-1] < 1.0
    assert abs(math.log(estimates[-1].sketch_from_base.scale / 12.0)) < 0.25
    turn = estimates[-1].sketch_from_base.pose.theta - (2.0 + poses[-1].theta)
    assert abs(math.remainder(turn, math.tau)) < math.radians(20.0)


def test_equal_input_and_seed_give_equal_output(sketch):
    readings = readings_of(walk()[:8])
    runs = []
    for _ in range(2):
        localizer = Localizer(sketch, seed=7)
        runs.append([localizer.update(*reading) for reading in readings])

    assert runs[0] == runs[1]


def test_a_start_and_a_scale_are_believed(sketch):
    poses = walk()[:6]
    start = (SKETCH_FROM_WORLD @ poses[0]).pose
    localizer = Localizer(sketch, start=start, scale=12.0)
    estimates = [localizer.update(*reading) for reading in readings_of(poses)]

    assert errors(estimates, poses).max() < 1.0
    assert Status.LOCATED is estimates[-1].status


def test_between_looks_the_place_moves_with_the_robot(sketch):
    localizer = Localizer(sketch, LocalizerSettings(step=100.0, turn=math.pi))
    (scan, odometry), *_ = readings_of(walk())
    first = localizer.update(scan, odometry)
    ahead = Odometry(1.0, odometry.odom_from_base @ Pose2(0.0, 0.0, 0.0))
    second = localizer.update(scan, ahead)

    assert first.hypotheses[0].probability == second.hypotheses[0].probability
    step = np.hypot(*(first.sketch_from_base.pose.position - second.sketch_from_base.pose.position))
    assert step / first.sketch_from_base.scale < 0.1


def test_probabilities_are_sane(sketch):
    localizer = Localizer(sketch)
    for reading in readings_of(walk()[:12]):
        estimate = localizer.update(*reading)
        shares = [hypothesis.probability for hypothesis in estimate.hypotheses]

        assert 0.0 <= estimate.confidence <= shares[0] <= 1.0
        assert sum(shares) <= 1.0 + 1e-9
        assert shares == sorted(shares, reverse=True)


def test_a_scan_that_shows_nothing_leaves_the_robot_lost(sketch):
    localizer = Localizer(sketch)
    blind = LaserScan(0.0, -1.0, 0.1, np.full(21, np.inf))

    assert Status.LOST is localizer.update(blind, Odometry(0.0, Pose2.identity())).status


def test_a_drawing_that_encloses_nothing_still_gives_estimates():
    sketch = SchematicMap(flat().strokes[2:])
    localizer = Localizer(sketch)
    estimate = localizer.update(*readings_of(walk())[0])

    assert "" == estimate.cell_id


def test_odometry_that_leaps_off_the_drawing_is_survived(sketch):
    localizer = Localizer(sketch)
    scan, odometry = readings_of(walk())[0]
    for leap in (0.0, 500.0, -1e4, 0.1):
        moved = Odometry(odometry.stamp, Pose2(leap, 0.0, 0.0))
        estimate = localizer.update(scan, moved)

    assert math.isfinite(estimate.sketch_from_base.pose.x)


@pytest.mark.parametrize("scale", [0.0, -2.0, math.nan, math.inf])
def test_a_scale_is_positive(sketch, scale):
    with pytest.raises(ValueError, match="scale must be positive"):
        Localizer(sketch, scale=scale)


@pytest.mark.parametrize("apart", [1, 2, 3], ids=["0.25 m", "0.5 m", "0.75 m"])
def test_scans_may_come_close_together_or_far_apart(sketch, apart):
    poses = [*walk(), *reversed(walk())][::apart]
    localizer = Localizer(sketch, SMALL, scale=12.0)
    estimates = [localizer.update(*reading) for reading in readings_of(poses)]

    assert errors(estimates, poses)[-1] < 1.0
    assert Status.LOCATED is estimates[-1].status


def test_a_robot_that_was_told_a_wrong_start_finds_itself_in_the_end(sketch):
    poses = [*walk(), *reversed(walk())] * 2
    localizer = Localizer(sketch, SMALL, start=(SKETCH_FROM_WORLD @ Pose2(9.0, 6.0, 2.5)).pose, scale=12.0)
    estimates = [localizer.update(*reading) for reading in readings_of(poses)]

    assert errors(estimates, poses)[0] > 3.0
    assert errors(estimates, poses)[-1] < 1.0


@pytest.mark.parametrize("seed", [1, 3])
def test_a_place_that_was_sure_is_kept_where_things_stand_that_are_not_drawn(sketch, seed):
    # A row of cupboards makes a corridor of what is drawn as a room.
    cupboards = [[(1.9, 7), (1.9, 2.2), (5, 2.2)], [(0.3, 7), (0.3, 0.8), (6, 0.8)]]
    walls = (*WALLS, *[Polyline.through(corners) for corners in cupboards])
    poses = walk()
    start = (SKETCH_FROM_WORLD @ poses[0]).pose
    localizer = Localizer(sketch, SMALL, seed=seed, start=start, scale=12.0)
    estimates = [
        localizer.update(scan_at(pose, float(k), walls=walls), Odometry(float(k), pose))
        for k, pose in enumerate(poses)
    ]

    assert errors(estimates, poses).max() < 2.5
    assert errors(estimates, poses)[-1] < 0.5


def test_a_robot_is_in_some_cell_most_likely_in_that_of_its_estimate(sketch):
    poses = walk()[:6]
    localizer = Localizer(sketch, SMALL, start=(SKETCH_FROM_WORLD @ poses[0]).pose, scale=12.0)
    for reading in readings_of(poses):
        estimate = localizer.update(*reading)
    graph = localizer.atlas.cell_graph
    beliefs = {cell.cell_id: localizer.belief_in(cell.cell_id) for cell in graph.cells}

    assert len(beliefs) > 1
    assert math.isclose(1.0, sum(beliefs.values()), abs_tol=1e-9)
    assert estimate.cell_id == max(beliefs, key=beliefs.get)
    assert 0.9 < beliefs[estimate.cell_id]


def test_without_cells_there_is_no_belief_in_any():
    localizer = Localizer(SchematicMap(flat().strokes[2:]), SMALL)
    localizer.update(*readings_of(walk())[0])

    assert 0.0 == localizer.belief_in("")


def test_the_placement_is_where_the_estimate_is_at_every_scan(sketch):
    poses = walk()
    localizer = Localizer(sketch, SMALL, start=(SKETCH_FROM_WORLD @ poses[0]).pose, scale=12.0)
    for pose, reading in zip(poses, readings_of(poses), strict=True):
        estimate = localizer.update(*reading)
        placement = localizer.placement

        claimed = estimate.sketch_from_base.pose.position
        assert math.dist(claimed, placement.position) < 0.5 * 12.0
        ahead = placement.sketch_from_base(np.array([[2.0, 0.0]]))
        expected = SKETCH_FROM_WORLD @ (pose @ np.array([[2.0, 0.0]]))
        assert np.hypot(*(ahead - expected)[0]) < 1.5 * 12.0


def test_between_looks_the_placement_moves_with_the_robot(sketch):
    poses = walk()[:5]
    rarely = replace(SMALL, step=100.0, turn=math.pi)
    localizer = Localizer(sketch, rarely, start=(SKETCH_FROM_WORLD @ poses[0]).pose, scale=12.0)
    places = []
    for reading in readings_of(poses):
        localizer.update(*reading)
        places.append(localizer.placement)

    moved = [place.base_from_sketch(np.array([places[0].position]))[0] for place in places]
    np.testing.assert_allclose(moved, [(-0.25 * k, 0.0) for k in range(5)], atol=0.05)


def test_where_scans_come_close_together_the_next_one_searches_for_other_places(sketch):
    poses = walk()[:6]
    wrong = (SKETCH_FROM_WORLD @ Pose2(9.0, 6.0, 2.5)).pose
    localizer = Localizer(sketch, replace(SMALL, step=0.45), start=wrong, scale=12.0)
    beliefs = []
    for reading in readings_of(poses):
        localizer.update(*reading)
        beliefs.append(localizer.belief)

    changed = [second is not first for first, second in itertools.pairwise(beliefs)]
    # with 0.25 m from scan to scan, each second one is weighed, and the one after it searches
    assert [False, True, True, True, True] == changed


def test_there_is_no_placement_before_the_first_scan(sketch):
    with pytest.raises(ValueError, match="at least one scan"):
        _ = Localizer(sketch, SMALL).placement
