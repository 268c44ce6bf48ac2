"""Laws of particles, of their motion and of tracks."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from buildings import coarse, flat
from pilotage.geometry import Pose2
from pilotage.localization import Prior, TrackSettings
from pilotage.localization.estimate import calibrate, find_hypotheses
from pilotage.localization.motion_model import propagate
from pilotage.localization.particles import HEADING, LOG_SCALE, Particles, X, Y, join
from pilotage.localization.prior import draw_anywhere, draw_near
from pilotage.localization.tracks import MIN_SHARE, cluster, leave, normalized
from pilotage.maps import build_atlas

ATLAS = build_atlas(flat(), coarse())
FEW = TrackSettings(first_count=4_000, max_count=4_000, min_count=500)
KNOWN_SCALE = Prior(log_scale=0.1, stretch=0.05)
seeds = st.integers(0, 2**32 - 1)
log_weights = st.lists(st.floats(-50.0, 5.0), min_size=1, max_size=60)


def particles_of(weights):
    """Let particles of these weights stand in a row."""
    states = np.zeros((6, len(weights)))
    states[X] = np.arange(len(weights))
    return Particles(states, np.array(weights))


def near(x, y, heading, count, log_mass):
    """Draw particles about a pose whose masses sum up to so much."""
    rng = np.random.default_rng(0)
    states = draw_near(Pose2(x, y, heading), ATLAS, KNOWN_SCALE, count, rng, heading_std=0.05)
    states[[X, Y]] = np.array([[x], [y]]) + 0.1 * rng.standard_normal((2, count))
    states[LOG_SCALE] = 0.0
    return Particles(states, np.full(count, log_mass - math.log(count)))


@given(log_weights, st.integers(1, 200), seeds)
def test_resampling_keeps_the_mass(weights, count, seed):
    particles = particles_of(weights)
    resampled = particles.resampled(count, np.random.default_rng(seed))

    assert count == len(resampled)
    assert math.isclose(particles.log_mass, resampled.log_mass, abs_tol=1e-9)
    assert set(resampled.states[X]) <= set(particles.states[X])


@given(log_weights, seeds)
def test_resampling_takes_each_particle_as_often_as_its_share_says(weights, seed):
    particles = particles_of(weights)
    resampled = particles.resampled(500, np.random.default_rng(seed))
    times = np.bincount(resampled.states[X].astype(np.int64), minlength=len(weights))

    assert (np.abs(times - 500 * particles.shares) <= 1.0 + 1e-6).all()


@given(log_weights, st.floats(-60.0, 5.0))
def test_all_masses_are_normalized_to_one(weights, log_null):
    particles, null, log_total = normalized(particles_of(weights), log_null)

    assert math.isclose(1.0, math.exp(particles.log_mass) + math.exp(null), abs_tol=1e-9)
    assert math.isclose(log_null, null + log_total, abs_tol=1e-9)


@given(log_weights, st.floats(-60.0, 5.0), st.floats(0.0, 1.0))
def test_who_leaves_the_drawing_is_not_lost(weights, log_null, probability):
    particles = particles_of(weights)
    left, null = leave(particles, log_null, probability)

    assert math.isclose(
        np.logaddexp(particles.log_mass, log_null), np.logaddexp(left.log_mass, null), abs_tol=1e-9
    )
    assert null >= log_null


@given(st.floats(-3.0, 0.0), st.floats(-8.0, 0.0), seeds)
def test_clusters_far_apart_are_tracks_that_keep_their_masses(first, second, seed):
    both = join([near(1.5, 1.5, 0.0, 800, first), near(8.0, 5.0, 2.0, 800, second)])
    both, log_null, _ = normalized(both, math.log(0.1))
    tracks = cluster(both, log_null, ATLAS, FEW, np.random.default_rng(seed))

    masses = sorted(math.exp(one.log_evidence) for one in tracks.tracks)
    assert math.isclose(1.0, sum(masses) + math.exp(tracks.log_null), abs_tol=1e-9)
    expected = sorted(np.exp([one - np.logaddexp(first, second) for one in (first, second)]))
    pruned = 100 * MIN_SHARE  # of blocks at the rim
    np.testing.assert_allclose(masses, np.array(expected) * (1.0 - math.exp(log_null)), atol=pruned)
    for one in tracks.tracks:
        assert 4.0 > np.ptp(one.particles.states[X])


def test_a_place_that_a_search_has_just_found_stays_a_track():
    born = math.log(TrackSettings().moving)
    both = join([near(1.5, 1.5, 0.0, 800, 0.0), near(8.0, 5.0, 2.0, 100, born)])
    tracks = cluster(both, math.log(0.1), ATLAS, FEW, np.random.default_rng(0)).tracks

    assert 2 == len(tracks)
    assert born == pytest.approx(tracks[1].log_evidence - tracks[0].log_evidence, abs=0.01)


def test_tracks_that_head_another_way_are_not_merged():
    both = join([near(1.5, 1.5, 0.0, 500, -1.0), near(1.5, 1.5, math.pi, 500, -1.0)])
    tracks = cluster(both, math.log(0.1), ATLAS, FEW, np.random.default_rng(0))

    assert 2 == len(tracks.tracks)
    assert all(0.5 > np.ptp(np.sin(one.particles.states[HEADING])) for one in tracks.tracks)


def test_a_cluster_across_the_heading_of_pi_is_one():
    tracks = cluster(near(1.5, 1.5, math.pi, 500, -1.0), -3.0, ATLAS, FEW, np.random.default_rng(0))

    assert 1 == len(tracks.tracks)


def test_without_particles_there_are_no_tracks():
    tracks = cluster(join([]), 0.0, ATLAS, FEW, np.random.default_rng(0))

    assert () == tracks.tracks
    assert 0 == len(tracks.particles)


def test_a_robot_that_stands_stays_where_it_is():
    particles = near(1.5, 1.5, 0.3, 2_000, 0.0)
    moved = propagate(particles, Pose2.identity(), ATLAS, KNOWN_SCALE, np.random.default_rng(0))

    assert 0.1 > np.abs(moved.states - particles.states).max()
    assert 0.02 > np.hypot(*(moved.states - particles.states)[:2]).mean()
    np.testing.assert_allclose(moved.log_weights, particles.log_weights)


def test_particles_move_by_the_motion_in_the_mean_and_spread():
    particles = near(1.5, 1.5, 0.0, 4_000, 0.0)
    moved = propagate(particles, Pose2(2.0, 0.0, 0.5), ATLAS, KNOWN_SCALE, np.random.default_rng(0))
    (x, y), was = moved.states[:2], particles.states[:2]

    assert 2.0 == pytest.approx((x - was[0]).mean(), abs=0.1)
    assert 0.0 == pytest.approx((y - was[1]).mean(), abs=0.1)
    assert 0.5 == pytest.approx((moved.states[HEADING] - particles.states[HEADING]).mean(), abs=0.02)
    assert np.std(x) > np.std(was[0])


def test_a_step_through_a_wall_costs_and_is_possible():
    through = propagate(
        near(1.5, 1.5, math.pi, 500, 0.0), Pose2(4.0, 0.0, 0.0), ATLAS, KNOWN_SCALE, np.random.default_rng(0)
    )

    assert -3.5 < through.log_mass < -2.0


def test_particles_may_be_anywhere_before_the_first_scan():
    states = draw_anywhere(ATLAS, Prior(), 20_000, np.random.default_rng(0))
    x, y = states[:2]

    assert 0.5 > x.min()
    assert 9.5 < x.max()
    assert not ((x > 8.3) & (y < 2.7)).any()  # outside the walls
    assert 0.05 > abs(np.exp(1j * states[HEADING]).mean())


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_a_probability_is_told_in_the_same_order(first, second):
    low, high = sorted((first, second))

    assert 0.0 <= calibrate(low) <= calibrate(high) < 1.0


@given(st.floats(-6.0, 0.0))
def test_hypotheses_hold_the_mass_of_the_particles_about_them(share):
    both = join([near(1.5, 1.5, 0.0, 300, -0.1), near(8.0, 5.0, 2.0, 300, share)])
    both, _, _ = normalized(both, -20.0)
    hypotheses = find_hypotheses(both, ATLAS)

    assert 1.0 + 1e-9 >= sum(one.probability for one in hypotheses)
    assert 0.9 < sum(one.probability for one in hypotheses)
    assert list(hypotheses) == sorted(hypotheses, key=lambda one: -one.probability)


def test_particles_that_are_all_improbable_are_kept(monkeypatch):
    monkeypatch.setattr("pilotage.localization.tracks.MIN_SHARE", 0.5)
    tracks = cluster(near(1.5, 1.5, 0.0, 500, 0.0), -3.0, ATLAS, FEW, np.random.default_rng(0))

    assert 0 < len(tracks.particles)


def test_a_place_is_told_where_the_densest_point_lies_between_particles_of_a_small_scale():
    small, large = -2.0, 1.0
    few = [[x, 5.0, 0.0, small, 0.0, 0.0] for x in (4.0, 5.0)]
    many = [[0.5 + 0.9 * k, 1.0, 0.0, large, 0.0, 0.0] for k in range(10)]
    states = np.column_stack([*few, *many])
    weights = np.log(np.array([0.2, 0.2, *[0.06] * 10]))

    hypotheses = find_hypotheses(Particles(states, weights), ATLAS)

    assert all(np.isfinite(one.sketch_from_base.pose.position).all() for one in hypotheses)
