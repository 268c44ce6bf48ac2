"""Each stage of localization alone, on a drawing where the truth is known."""

import math
from dataclasses import replace

import numpy as np
import pytest

from buildings import flat, readings_of, scan_at, walk
from pilotage.geometry import Pose2
from pilotage.localization import EstimateSettings, TrackingSettings, VisibilitySettings
from pilotage.localization.alignment import (
    AlignmentSettings,
    View,
    align,
    choose_views,
    extend_views,
    score_views,
    trust_in,
)
from pilotage.localization.belief import Belief, similarity_of
from pilotage.localization.estimate import find_places, steady_confidence
from pilotage.localization.proposals import Prior, propose_anywhere, propose_by_corners, propose_near
from pilotage.localization.tracking import predict, thin, weigh
from pilotage.localization.visibility import VisibilityModel, look
from pilotage.maps import AtlasSettings, build_atlas
from pilotage.perception import LaserScan, PerceptionSettings, perceive
from pilotage.shape import Simplification, simplify_all
from pilotage.shape.corners import find_corners

VISIBILITY = VisibilitySettings()
TRUE = Pose2(1.5, 4.0, -1.2)
NO_CORNERS = find_corners([])


@pytest.fixture(scope="module")
def atlas():
    return build_atlas(flat(), AtlasSettings())


@pytest.fixture(scope="module")
def model(atlas):
    return VisibilityModel(atlas, VISIBILITY)


def state_at(pose):
    """The one hypothesis that is true of an undistorted drawing in metres, (6, 1)."""
    return np.array([[pose.x], [pose.y], [pose.theta], [0.0], [0.0], [0.0]])


def views_of(poses):
    return tuple(
        View(look(scan, VISIBILITY), NO_CORNERS, odometry.odom_from_base, 0.25 * k)
        for k, (scan, odometry) in enumerate(readings_of(poses))
    )


def test_the_truth_explains_a_look_better_than_almost_any_other_place(atlas, model):
    seen = look(scan_at(TRUE), VISIBILITY)
    others = propose_anywhere(atlas, Prior(), 20_000, np.random.default_rng(0))

    better = model.score(others, seen) > model.score(state_at(TRUE), seen)[0]

    assert better.mean() < 0.002


def test_a_look_sees_from_the_base_and_not_from_the_laser():
    mounted = scan_at(TRUE)
    turned = LaserScan(0.0, -math.pi / 2, math.pi / 180, mounted.ranges, base_from_laser=Pose2(0, 0, 0.5))

    there, here = look(mounted, VISIBILITY), look(turned, VISIBILITY)

    assert (there.levels == here.levels).all()
    steps = np.remainder(here.beams - there.beams, 240)
    assert set(steps.tolist()) <= {19, 20}  # 0.5 rad are 19.1 steps of 1.5 degrees


def test_a_look_leaves_out_what_is_invalid_or_too_close():
    ranges = np.array([np.nan, -np.inf, 0.01, 2.0, np.inf])
    seen = look(LaserScan(0.0, -1.0, 0.5, ranges), VISIBILITY)

    assert 2 == len(seen)


def test_no_beams_say_nothing(model):
    blind = look(LaserScan(0.0, 0.0, 1.0, np.array([np.nan])), VISIBILITY)

    assert [0.0] == model.score(state_at(TRUE), blind).tolist()


def test_hypotheses_move_as_the_robot_does(atlas):
    motion = Pose2(0.5, 0.1, 0.3)
    belief = Belief(np.repeat(state_at(TRUE), 4000, axis=1), np.zeros(4000))

    moved = predict(belief, motion, atlas, TrackingSettings(), np.random.default_rng(0))

    expected = TRUE @ motion
    np.testing.assert_allclose(moved.states[:2].mean(axis=1), expected.position, atol=0.02)
    assert math.isclose(moved.states[2].mean(), expected.theta, abs_tol=0.01)


def test_who_walks_through_a_wall_pays(atlas):
    belief = Belief(np.repeat(state_at(Pose2(4.0, 2.8, math.pi / 2)), 500, axis=1), np.zeros(500))

    moved = predict(belief, Pose2(1.5, 0.0, 0.0), atlas, TrackingSettings(), np.random.default_rng(0))

    assert (moved.log_weights < 0.0).all()


def test_belief_is_resampled_only_when_few_carry_the_weight(model):
    settings = TrackingSettings(first_count=2000, count=1000, least=1000)
    seen, rng = look(scan_at(TRUE), VISIBILITY), np.random.default_rng(0)
    same = Belief(np.repeat(state_at(TRUE), 2000, axis=1), np.zeros(2000))
    few = Belief(same.states, np.r_[np.zeros(10), np.full(1990, -50.0)])

    assert 2000 == len(thin(weigh(same, seen, model), settings, rng))
    assert 1000 == len(thin(weigh(few, seen, model), settings, rng))


def test_corners_seen_propose_the_true_pose(atlas):
    shapes = perceive(scan_at(TRUE), PerceptionSettings())
    features = simplify_all([shape.polyline for shape in shapes], Simplification(min_relevance=0.08))
    seen = find_corners(features)

    exact = Prior(log_scale=0.02, stretch=0.02)
    states = propose_by_corners(seen, replace(atlas, log_scale=0.0), exact, 4000, np.random.default_rng(0))

    near = np.hypot(states[0] - TRUE.x, states[1] - TRUE.y) < 0.3
    turned = np.abs(np.remainder(states[2] - TRUE.theta + math.pi, math.tau) - math.pi) < 0.15
    by_chance = 4000 * (math.pi * 0.3**2 / 45.0) * (0.3 / math.tau)
    assert np.count_nonzero(near & turned) > 20 * by_chance


def test_without_corners_there_are_no_such_proposals(atlas):
    assert (6, 0) == propose_by_corners(find_corners([]), atlas, Prior(), 100, np.random.default_rng(0)).shape


def test_proposals_near_a_start_stand_around_it(atlas):
    states = propose_near(TRUE, atlas, Prior(), 4000, np.random.default_rng(0))

    np.testing.assert_allclose(states[:3].mean(axis=1), [TRUE.x, TRUE.y, TRUE.theta], atol=0.2)


def test_alignment_finds_the_place_from_one_walk(atlas, model):
    poses = walk()[:24]
    views = views_of(poses)
    settings, rng = AlignmentSettings(proposals=40_000), np.random.default_rng(1)

    proposals = propose_anywhere(replace(atlas, log_scale=0.0), Prior(log_scale=0.2), 40_000, rng)
    aligned = align(views, proposals, model, settings, rng)

    best = similarity_of(aligned.states[:, aligned.log_weights.argmax()])
    assert np.hypot(*(best.pose.position - poses[-1].position)) < 1.0
    assert score_views(state_at(poses[-1]), choose_views(views, 8), model, settings)[0] > -2.5 * 8


def test_alignment_explains_the_views_no_worse_for_being_refined(atlas, model):
    views, rng = views_of(walk()[:12]), np.random.default_rng(0)
    proposals = propose_anywhere(atlas, Prior(), 8000, rng)

    rough = align(views, proposals, model, AlignmentSettings(rounds=0), np.random.default_rng(0))
    fine = align(views, proposals, model, AlignmentSettings(rounds=8), np.random.default_rng(0))

    assert fine.log_weights.mean() > rough.log_weights.mean()


def test_right_belief_is_kept_and_wrong_belief_is_replaced(atlas, model):
    poses = walk()[:24]
    views, settings, rng = views_of(poses), AlignmentSettings(), np.random.default_rng(0)
    fresh = align(views, propose_anywhere(atlas, Prior(), 16_000, rng), model, settings, rng)
    right = np.repeat(state_at(poses[-1]), 50, axis=1)
    wrong = np.repeat(state_at(Pose2(9.0, 6.0, 2.5)), 50, axis=1)

    assert trust_in(fresh, right, views, model, settings) < 0.5 * settings.trust
    assert settings.trust == trust_in(fresh, wrong, views, model, settings)


def test_views_from_before_the_window_are_forgotten():
    seen = look(scan_at(TRUE), VISIBILITY)
    views = ()
    for _ in range(10):
        views = extend_views(views, Pose2(1.0, 0.0, 0.0), seen, NO_CORNERS, 4.0)

    assert [5.0, 6.0, 7.0, 8.0, 9.0] == [view.way for view in views]
    assert 9.0 == views[-1].odom_from_base.x


def test_places_are_told_apart_and_ranked(atlas):
    here, there = np.repeat(state_at(TRUE), 60, axis=1), np.repeat(state_at(Pose2(8.0, 5.0, 0.0)), 40, axis=1)

    places = find_places(Belief(np.hstack([there, here]), np.zeros(100)), atlas, EstimateSettings())

    assert [0.6, 0.4] == [round(place.probability, 6) for place in places]
    assert places[0].cell_id != places[1].cell_id
    np.testing.assert_allclose(places[0].sketch_from_base.pose.position, TRUE.position)


def test_places_far_off_the_drawing_are_still_places(atlas):
    far = Belief(np.repeat(state_at(Pose2(1e7, -1e7, 0.0)), 10, axis=1), np.zeros(10))

    assert 1.0 == find_places(far, atlas, EstimateSettings())[0].probability


def test_confidence_grows_with_the_way_and_begins_anew_after_a_jump():
    settings = EstimateSettings(confirmation=4.0, jump=2.0)

    grown = [0.0]
    for _ in range(40):
        grown.append(steady_confidence(grown[-1], 0.95, 0.1, 0.5, settings))

    assert grown == sorted(grown)
    assert math.isclose(0.95 * (1 - math.exp(-20.0 / 4.0)), grown[-1], rel_tol=1e-9)
    assert steady_confidence(grown[-1], 0.95, 3.0, 0.5, settings) < 0.2


def test_a_look_that_is_no_news_tells_nothing_and_half_news_half_as_much(model):
    seen = look(scan_at(TRUE), VISIBILITY)
    states = propose_anywhere(model.atlas, Prior(), 200, np.random.default_rng(0))
    belief = Belief(states, np.linspace(-3.0, 0.0, 200))

    none, half, full = (weigh(belief, seen, model, news=news).log_weights for news in (0.0, 0.5, 1.0))

    np.testing.assert_array_equal(belief.log_weights, none)
    np.testing.assert_allclose(half - none, (full - none) / 2.0)
    np.testing.assert_array_equal(full, weigh(belief, seen, model).log_weights)
    assert np.ptp(full - none) > 1.0


def test_the_wider_belief_is_spread_the_more_hypotheses_it_needs():
    settings = TrackingSettings(first_count=9000, count=3000, least=500)
    counts = [settings.count_for(blocks, 3000) for blocks in (0.1, 1.0, 2.0, 1e6)]

    assert counts == sorted(counts)
    assert 500 == counts[0]
    assert 3000 == counts[-1]


def test_hypotheses_from_before_the_first_looks_are_not_dropped_at_once():
    settings = TrackingSettings(first_count=9000, count=3000, least=500)

    assert 9000 == settings.count_for(1.0, 9000)
    assert 4500 <= len(thin(few_that_count(9000), settings, np.random.default_rng(0))) < 9000


def few_that_count(count):
    """Belief of which a few hypotheses have all the weight."""
    states = np.zeros((6, count))
    return Belief(states, np.r_[np.zeros(5), np.full(count - 5, -60.0)])


def test_thinning_keeps_to_what_carries_the_weight():
    belief = few_that_count(1000)
    belief.states[0, 5:] = 1.0
    settings = TrackingSettings(first_count=1000, count=600, least=100)

    thinned = thin(belief, settings, np.random.default_rng(0))

    assert 600 == len(thinned)
    assert (thinned.states[0] == 0.0).all()
    assert (thinned.log_weights == 0.0).all()
    assert thinned is thin(thinned, settings, np.random.default_rng(0))
