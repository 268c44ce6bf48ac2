import math

import numpy as np
import pytest

from buildings import flat, readings_of, walk
from pilotage.geometry import Pose2, Similarity2
from pilotage.localization import Localizer, LocalizerSettings, Status
from pilotage.maps import SchematicMap
from pilotage.perception import LaserScan, Odometry

SKETCH_FROM_WORLD = Similarity2(12.0, Pose2(40.0, -300.0, 2.0))


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
