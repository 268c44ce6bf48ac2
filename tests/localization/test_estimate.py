"""What an estimate says, and how it is carried along."""

import math
import tracemalloc

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from buildings import coarse, flat
from knowing import estimate_at, estimate_of, hypothesis_at
from pilotage.geometry import Affine2, Pose2
from pilotage.localization import Status, Track, Tracks
from pilotage.localization.estimate import summarize
from pilotage.localization.particles import Particles
from pilotage.maps import build_atlas
from strategies import poses

ATLAS = build_atlas(flat(), coarse())


@given(poses, poses, st.floats(-2.0, 2.0), st.booleans())
def test_an_estimate_moves_as_its_map_composes(pose, motion, log_scale, y_down):
    other = hypothesis_at(Pose2(1.0, 2.0, 3.0), probability=0.1)
    first = hypothesis_at(pose, scale=math.exp(log_scale), probability=0.5)
    moved = estimate_of(first, other, y_down=y_down).moved(motion)

    for one, was in zip(moved.hypotheses, (first, other), strict=True):
        assert one.sketch_from_base == was.sketch_from_base @ motion
        assert one.probability == was.probability
    there = moved.sketch_from_base.pose
    assert (there.x, -there.y if y_down else there.y, there.theta) == (moved.x, moved.y, moved.heading)


def test_an_estimate_that_moves_into_another_cell_says_so():
    here = ATLAS.cell_at((1.5, 5.0))
    moved = estimate_at(1.5, 5.0, cell_id=here).moved(Pose2(6.5, 0.0, 0.0), ATLAS)

    assert ATLAS.cell_at((8.0, 5.0)) == moved.cell_id != here
    assert moved.place == moved.cell_id


def tracks_at(pose, log_null):
    """Let a hundred particles stand at a pose."""
    state = [pose.x, pose.y, pose.theta, 0.0, 0.0, 0.0]
    states = np.tile(np.array(state)[:, np.newaxis], (1, 100))
    weights = np.full(100, math.log(1.0 - math.exp(log_null)) - math.log(100.0))
    return Tracks((Track(Particles(states, weights)),), log_null)


def test_one_track_is_one_hypothesis_where_it_stands():
    here = Pose2(1.5, 5.0, 0.5)
    estimate = summarize(tracks_at(here, math.log(0.001)), 0.7, 3.0, 20.0, ATLAS, is_mismatch=False)

    assert Status.LOCATED is estimate.status
    assert 1 == len(estimate.hypotheses)
    np.testing.assert_allclose([estimate.x, estimate.y, estimate.heading], [1.5, 5.0, 0.5])
    assert math.isclose(1.0, estimate.scale)
    assert (3.0, 0.7) == (estimate.stamp, estimate.fit)
    assert 1.0 > estimate.cell_probability >= estimate.probability > 0.9
    assert 1e-6 > estimate.position_std
    np.testing.assert_allclose(
        estimate.sketch_from_base.linear, Affine2.from_state(1.5, 5.0, 0.5, 0.0, 0.0, 0.0).linear
    )


def test_a_drawing_is_to_blame_if_that_is_claimed_whatever_its_places():
    tracks = tracks_at(Pose2(1.5, 5.0, 0.5), math.log(0.001))
    estimate = summarize(tracks, 0.1, 0.0, -9.0, ATLAS, is_mismatch=True)

    assert Status.MISMATCH is estimate.status
    assert -9.0 == estimate.log_evidence


def test_places_too_improbable_to_count_are_still_told():
    tracks = tracks_at(Pose2(1.5, 5.0, 0.5), math.log(0.99))
    faint = Tracks((Track(tracks.particles.scaled(-2000.0)),), 0.0)
    estimate = summarize(faint, 0.0, 0.0, -2000.0, ATLAS, is_mismatch=True)

    assert Status.MISMATCH is estimate.status
    assert 0.0 == estimate.probability
    np.testing.assert_allclose([estimate.x, estimate.y], [1.5, 5.0])


def test_particles_apart_at_a_tiny_scale_still_make_a_hypothesis():
    states = np.zeros((6, 42))
    states[0] = [
        1.0,
        1.1,
        *np.linspace(2.0, 8.0, 40),
    ]  # two close on the drawing, metres apart at their scale
    states[1] = 5.0
    states[3, :2] = -4.0
    weights = np.log([0.3, 0.3, *[0.4 / 40] * 40]) + math.log(0.9)
    estimate = summarize(
        Tracks((Track(Particles(states, weights)),), math.log(0.1)), 0.5, 0.0, 1.0, ATLAS, is_mismatch=False
    )

    assert all(math.isfinite(one.sketch_from_base.pose.x) for one in estimate.hypotheses)
    assert 0.0 < estimate.probability < 1.0


def test_a_drawing_of_kilometres_takes_no_more_memory():
    states = np.tile(
        np.array([[9.5], [6.5], [0.0], [math.log(ATLAS.sketch.diagonal / 9e3)], [0.0], [0.0]]), 10
    )
    tracks = Tracks((Track(Particles(states, np.full(10, math.log(0.05)))),), math.log(0.5))
    tracemalloc.start()
    estimate = summarize(tracks, 0.5, 0.0, 1.0, ATLAS, is_mismatch=False)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()

    assert 100e6 > most
    np.testing.assert_allclose([estimate.x, estimate.y], [9.5, 6.5])
