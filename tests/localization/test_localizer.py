"""The localizer in a small flat that was drawn turned, moved and scaled."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from buildings import coarse, flat, readings_of, walk
from pilotage.errors import PilotageError
from pilotage.geometry import Pose2, Similarity2
from pilotage.localization import Localizer, LocalizerSettings, Status, Tracks, TrackSettings
from pilotage.localization.global_search import global_search
from pilotage.localization.keyframes import append_keyframe
from pilotage.localization.observation import observe
from pilotage.localization.particle_filter import Posterior, log_birth_factor
from pilotage.localization.particles import HEADING, LOG_SCALE, X, Y
from pilotage.localization.sensor_model import SensorModel
from pilotage.maps import SchematicMap, build_atlas
from pilotage.perception import LaserScan, Odometry
from pilotage.scan_matching import ScanMatcher

SKETCH_FROM_WORLD = Similarity2(12.0, Pose2(40.0, -300.0, 2.0))
SMALL = LocalizerSettings(
    tracks=TrackSettings(first_count=20_000, max_count=6_000, min_count=2_000), proposals=3_000
)
PATH = walk()


@pytest.fixture(scope="module")
def atlas():
    return build_atlas(replace(flat(12.0, SKETCH_FROM_WORLD.pose), y_down=True), coarse(120, 120))


def true_pose(pose):
    """Carry a pose of the world to the sketch, y up."""
    return (SKETCH_FROM_WORLD @ pose).pose


def in_file(pose):
    """Tell a pose of the world as a user does: in the axes of the drawing's file, y down."""
    there = true_pose(pose)
    return there.x, -there.y, there.theta


def errors(estimates, poses):
    """Distance to the truth [m]."""
    found = np.array([(estimate.x, -estimate.y) for estimate in estimates])
    true = np.array([true_pose(pose).position for pose in poses])
    return np.hypot(*(found - true).T) / SKETCH_FROM_WORLD.scale


def run(localizer, readings):
    return [localizer.update(*reading) for reading in readings]


@pytest.mark.parametrize("seed", range(3))
def test_a_robot_put_down_anywhere_finds_itself_on_a_turned_and_scaled_drawing(atlas, seed):
    estimates = run(Localizer(atlas, SMALL, seed=seed), readings_of(PATH))

    assert errors(estimates, PATH)[-1] < 1.0
    assert abs(math.log(estimates[-1].scale / 12.0)) < 0.3
    turn = estimates[-1].heading - true_pose(PATH[-1]).theta
    assert abs(math.remainder(turn, math.tau)) < math.radians(20.0)


def test_equal_input_and_seed_give_equal_output(atlas):
    readings = readings_of(PATH[:12])
    first, second, other = (run(Localizer(atlas, SMALL, seed=seed), readings) for seed in (7, 7, 8))

    assert first == second
    assert first != other


def test_a_start_and_a_scale_are_kept(atlas):
    localizer = Localizer(atlas, SMALL, start=in_file(PATH[0]), scale=12.0)
    estimates = run(localizer, readings_of(PATH))

    assert errors(estimates, PATH).max() < 1.0
    assert Status.LOCATED is estimates[-1].status
    assert abs(math.log(estimates[-1].scale / 12.0)) < 0.2


def test_a_start_without_a_heading_is_kept(atlas):
    localizer = Localizer(atlas, SMALL, start=in_file(PATH[0])[:2], scale=12.0)
    estimates = run(localizer, readings_of(PATH[:16]))

    assert errors(estimates, PATH[:16]).max() < 2.0
    assert errors(estimates, PATH[:16])[-1] < 1.0


def test_the_same_start_serves_drawings_with_y_up_and_y_down(atlas):
    x, y, heading = in_file(PATH[0])
    upright = replace(atlas, sketch=replace(atlas.sketch, y_down=False))
    (reading,) = readings_of(PATH[:1])
    down = Localizer(atlas, SMALL, start=(x, y, heading), scale=12.0).update(*reading)
    up = Localizer(upright, SMALL, start=(x, -y, heading), scale=12.0).update(*reading)

    assert (down.x, down.y, down.heading) == (up.x, -up.y, up.heading)
    assert down.sketch_from_base == up.sketch_from_base


def test_between_keyframes_the_estimate_moves_with_the_robot(atlas):
    rarely = replace(SMALL, step=100.0, turn=math.pi)
    localizer = Localizer(atlas, rarely, start=in_file(PATH[0]), scale=12.0)
    estimates = run(localizer, readings_of(PATH[:5]))
    base_from_sketch = estimates[0].sketch_from_base.inverse()
    moved = [(base_from_sketch @ one.sketch_from_base).pose.position for one in estimates]

    np.testing.assert_allclose(moved, [(0.25 * k, 0.0) for k in range(5)], atol=0.05)
    assert 1 == len({one.probability for one in estimates})
    assert [0.0, 1.0, 2.0, 3.0, 4.0] == [one.stamp for one in estimates]


def test_probabilities_are_sane(atlas):
    localizer = Localizer(atlas, SMALL)
    for estimate in run(localizer, readings_of(PATH[:12])):
        shares = [hypothesis.probability for hypothesis in estimate.hypotheses]

        assert 0.0 <= estimate.probability == shares[0] <= estimate.cell_probability <= 1.0
        assert 0.0 <= estimate.fit <= 1.0
        assert sum(shares) <= 1.0 + 1e-9
        assert shares == sorted(shares, reverse=True)
    tracks = localizer.tracks
    assert math.isclose(1.0, math.exp(tracks.log_null) + math.exp(tracks.particles.log_mass), rel_tol=1e-9)


def test_a_sample_of_states_stands_where_the_estimate_is(atlas):
    localizer = Localizer(atlas, SMALL, start=in_file(PATH[0]), scale=12.0)
    *_, estimate = run(localizer, readings_of(PATH[:3]))  # a keyframe is the last of them
    states = localizer.sample(200)

    assert (6, 200) == states.shape
    assert math.dist(states[:2].mean(axis=1), estimate.sketch_from_base.pose.position) < 0.5 * 12.0


def test_there_is_no_estimate_before_the_first_scan(atlas):
    with pytest.raises(ValueError, match="at least one scan"):
        _ = Localizer(atlas, SMALL).estimate


def test_a_scan_that_shows_nothing_leaves_the_robot_lost(atlas):
    blind = LaserScan(0.0, -1.0, 0.1, np.full(21, np.nan))

    assert Status.LOST is Localizer(atlas, SMALL).update(blind, Odometry(0.0, Pose2.identity())).status


@pytest.mark.slow
def test_a_drawing_of_a_vast_place_is_no_reason_to_fall_over(atlas):
    blind = LaserScan(0.0, -1.0, 0.1, np.full(21, np.nan))
    localizer = Localizer(atlas, SMALL, scale=0.05)  # as if the flat were 2.4 km long
    estimate = localizer.update(blind, Odometry(0.0, Pose2.identity()))

    assert Status.LOST is estimate.status


def test_a_drawing_that_encloses_nothing_still_gives_estimates():
    localizer = Localizer(SchematicMap(flat().strokes[2:]), SMALL)
    estimate = localizer.update(*readings_of(PATH)[0])

    assert "" == estimate.cell_id == estimate.place


@pytest.mark.parametrize("leap", [500.0, 1e9, 1e300])
def test_an_impossible_step_of_odometry_does_not_spoil_what_follows(atlas, leap):
    localizer = Localizer(atlas, SMALL, start=in_file(PATH[0]), scale=12.0)
    readings = readings_of(PATH)
    run(localizer, readings[:8])
    scan, odometry = readings[8]
    leapt = localizer.update(scan, Odometry(odometry.stamp, Pose2(leap, -leap, 0.3)))
    estimates = run(localizer, readings[9:])

    assert all(map(math.isfinite, (leapt.x, leapt.y, leapt.heading, leapt.scale, leapt.probability)))
    assert errors(estimates, PATH[9:])[-1] < 1.5


@pytest.mark.parametrize("far", [1e9, 1e300])
def test_an_impossible_range_does_not_spoil_what_follows(atlas, far):
    localizer = Localizer(atlas, SMALL, start=in_file(PATH[0]), scale=12.0)
    readings = readings_of(PATH)
    for k in range(4, 8):
        scan, odometry = readings[k]
        ranges = np.array(scan.ranges)
        ranges[::3] = far
        readings[k] = (LaserScan(scan.stamp, scan.angle_min, scan.angle_increment, ranges), odometry)
    estimates = run(localizer, readings)

    assert errors(estimates, PATH)[-1] < 1.0


@pytest.mark.parametrize("scale", [0.0, -2.0, math.nan, math.inf])
def test_a_scale_is_positive(atlas, scale):
    with pytest.raises(ValueError, match="scale must be positive"):
        Localizer(atlas, scale=scale)


@pytest.mark.parametrize("scale", [None, 12.0])
def test_a_resumed_localizer_goes_on_with_the_scale_that_was_given(atlas, scale):
    readings = readings_of(PATH)
    unbroken, stopped = (Localizer(atlas, SMALL, scale=scale) for _ in range(2))
    run(stopped, readings[:10])
    resumed = Localizer.resumed(atlas, stopped.state, SMALL)

    assert run(unbroken, readings)[10:] == run(resumed, readings[10:])


@pytest.mark.parametrize("scale", [1e-3, 1e4])
def test_a_scale_that_no_building_has_is_refused(atlas, scale):
    with pytest.raises(PilotageError, match=r"units per metre: at .* m across"):
        Localizer(atlas, scale=scale)


@pytest.mark.parametrize("start", [(1.0,), (math.nan, 0.0), (0.0, 0.0, math.inf), (0.0, 0.0, 0.0, 0.0)])
def test_a_start_is_two_or_three_finite_numbers(atlas, start):
    with pytest.raises(ValueError, match="start must be x, y and a heading"):
        Localizer(atlas, start=start)


@pytest.mark.slow
def test_scans_close_together_or_far_apart_lead_to_the_same_place(atlas):
    poses = [*PATH, *reversed(PATH), PATH[0]]
    poses = poses[: len(poses) // 2 * 2 - 1]  # the last one is in both
    often, rarely = (
        run(Localizer(atlas, SMALL, scale=12.0), readings_of(poses[::apart]))[-1] for apart in (1, 2)
    )

    assert often.cell_id == rarely.cell_id
    assert math.dist((often.x, often.y), (rarely.x, rarely.y)) < 12.0
    assert Status.LOCATED is often.status is rarely.status


@pytest.mark.slow
def test_a_robot_that_was_told_a_wrong_start_finds_itself_in_the_end(atlas):
    poses = [*PATH, *reversed(PATH)] * 2
    localizer = Localizer(atlas, SMALL, start=in_file(Pose2(9.0, 6.0, 2.5)), scale=12.0)
    estimates = run(localizer, readings_of(poses))

    assert errors(estimates, poses)[0] > 3.0
    assert errors(estimates, poses)[-1] < 1.0


def test_a_search_of_the_whole_drawing_finds_the_place(atlas):
    readings = readings_of(PATH)
    matcher = ScanMatcher(SMALL.scan_matching)
    window = ()
    for before, (scan, odometry) in itertools.pairwise([readings[0], *readings]):
        seen = matcher.update(scan, odometry)
        motion = before[1].odom_from_base.inverse() @ odometry.odom_from_base
        window = append_keyframe(window, observe(scan, seen.shapes, motion))
    model = SensorModel(atlas, SMALL.sensor)
    found = global_search(window, model, SMALL.prior, 6_000, np.random.default_rng(0))
    best = found.states[:, int(found.log_weights.argmax())]
    true = true_pose(PATH[-1])

    assert window[-1].travel - window[0].travel <= 10.0
    assert math.dist(best[[X, Y]], true.position) < 12.0
    assert abs(math.remainder(best[HEADING] - true.theta, math.tau)) < math.radians(20.0)
    assert abs(best[LOG_SCALE] - math.log(12.0)) < 0.4
    assert 0.0 < found.log_mass  # it explains more than any building does


def test_a_birth_is_weighed_against_what_the_tracks_explained_after_the_first_searched_keyframe():
    readings = readings_of(PATH)
    window = append_keyframe((), observe(readings[0][0], (), Pose2.identity()))
    window = append_keyframe(window, observe(readings[1][0], (), Pose2(1.0, 0.0, 0.0)))
    before = Posterior(Tracks((), 0.0))
    first = before.with_evidence(window[:1], 2.0)
    second = first.with_evidence(window, 0.5)
    factors = [log_birth_factor(one, window, SMALL.tracks) for one in (before, first, second)]

    assert [0.0, 0.0, -0.5] == pytest.approx([factor - factors[0] for factor in factors])


def test_where_a_scan_shows_that_the_robot_was_carried_the_window_begins_anew_and_births_are_likely():
    readings = readings_of(PATH)
    window = append_keyframe((), observe(readings[0][0], (), Pose2.identity()))
    window = append_keyframe(window, observe(readings[1][0], (), Pose2(60.0, 0.0, 0.0)))
    carried = append_keyframe(window, observe(readings[2][0], (), Pose2.identity(), was_carried=True))
    before = replace(Posterior(Tracks((), 0.0)), searched=59.5)
    factors = [log_birth_factor(before, one, SMALL.tracks) for one in (window, carried)]

    assert [60.0] == [one.travel for one in carried]
    assert 1.0 == carried[0].novelty
    assert math.log(0.2 * 0.5 / 10.0) == pytest.approx(factors[1])
    assert factors[0] < factors[1] - 5.0


def test_a_robot_that_is_carried_doubts_at_once_and_finds_itself_again(atlas):
    before, after = readings_of(PATH[:4]), readings_of(PATH[12:])
    here = before[-1][1].odom_from_base @ after[0][1].odom_from_base.inverse()
    later = [
        (scan, replace(odometry, odom_from_base=here @ odometry.odom_from_base)) for scan, odometry in after
    ]
    localizer = Localizer(atlas, SMALL, start=in_file(PATH[0]), scale=12.0)
    known = run(localizer, before)[-1]
    estimates = run(localizer, later)

    assert 0.9 < known.probability
    assert estimates[0].probability < 0.8
    assert errors(estimates, PATH[12:])[-1] < 1.0


@pytest.mark.parametrize(
    ("changes", "rule"),
    [
        ({"step": 0.0}, "step must be > 0"),
        ({"turn": -1.0}, "turn must be > 0"),
        ({"proposals": 99}, "proposals must be >= 100"),
    ],
)
def test_invalid_settings_are_rejected(changes, rule):
    with pytest.raises(ValueError, match=rule):
        LocalizerSettings(**changes)


@pytest.mark.parametrize(
    ("changes", "rule"),
    [
        ({"first_count": 10}, "first_count >= max_count >= min_count"),
        ({"min_count": 0}, "min_count >= 1"),
        ({"count_per_area": 0}, "count_per_area must be >= 1"),
        ({"first_null": 1.0}, "first_null must be in"),
        ({"leaving": 0.0}, "leaving must be in"),
        ({"told_log_odds": math.inf}, "told_log_odds must be finite"),
    ],
)
def test_invalid_settings_of_tracks_are_rejected(changes, rule):
    with pytest.raises(ValueError, match=rule):
        TrackSettings(**changes)


def test_turning_on_the_spot_tells_a_scanner_that_sees_all_around_nothing(atlas):
    turning = [Pose2(*PATH[0].position, PATH[0].theta + math.radians(25.0) * k) for k in range(15)]
    readings = readings_of(turning, fov=math.radians(359.0), beams=360)
    localizer = Localizer(atlas, SMALL, start=in_file(PATH[0]))

    run(localizer, readings[:1])
    once = localizer.log_evidence
    run(localizer, readings[1:])

    assert abs(localizer.log_evidence - once) < 0.5
