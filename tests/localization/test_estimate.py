"""From belief to places and what is claimed of them."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from buildings import flat
from pilotage.geometry import Pose2, Similarity2
from pilotage.localization import EstimateSettings, Hypothesis, Status
from pilotage.localization.belief import Belief
from pilotage.localization.estimate import (
    agreement,
    area_of,
    defended,
    defended_confidence,
    estimate_from,
    find_places,
    share_at,
)
from pilotage.maps import AtlasSettings, RangeTableSettings, build_atlas

SETTINGS = EstimateSettings(block=1.0, jump=2.0, confirmation=4.0, fading=40.0)
COARSE = AtlasSettings(range_table=RangeTableSettings(cells=60, directions=30))
ATLAS = build_atlas(flat(), COARSE)


def belief_at(*places, weights=None, scale=1.0):
    """One hypothesis at each place, in metres whatever the scale of the drawing."""
    states = np.zeros((6, len(places)))
    states[:2] = scale * np.array(places, dtype=float).T
    states[3] = math.log(scale)
    return Belief(states, np.zeros(len(places)) if weights is None else np.log(weights))


def place(x, y, probability=0.5, scale=1.0):
    return Hypothesis("", Similarity2(scale, Pose2(scale * x, scale * y, 0.0)), probability)


spots = st.tuples(st.floats(0.1, 9.9), st.floats(0.1, 6.9))
beliefs = st.lists(st.tuples(spots, st.floats(0.01, 1.0)), min_size=1, max_size=30).map(
    lambda rows: belief_at(*[spot for spot, _ in rows], weights=[weight for _, weight in rows])
)


@pytest.mark.parametrize("block", [1.0, 1.5, 2.0])
def test_belief_at_one_spot_fills_one_block(block):
    settings = replace(SETTINGS, block=block)

    assert block**2 == pytest.approx(area_of(belief_at(*[(1.6, 4.6)] * 9), ATLAS, settings))


@pytest.mark.parametrize("scale", [1.0, 25.0])
def test_equal_shares_far_apart_count_in_full_whatever_the_scale(scale):
    atlas = build_atlas(flat(scale), COARSE)
    spots = np.array([(1.5, 1.5), (1.5, 5.5), (8.5, 5.5)])
    belief = belief_at(*spots, *(spots + 0.1), scale=scale)

    assert 3.0 == pytest.approx(area_of(belief, atlas, SETTINGS))


@given(beliefs)
def test_belief_is_spread_over_no_more_blocks_than_hypotheses_and_at_least_one(belief):
    blocks = area_of(belief, ATLAS, SETTINGS)

    assert 1.0 - 1e-9 <= blocks <= len(belief) + 1e-9


def test_a_rare_place_counts_less_than_a_likely_one():
    even, rare = (
        area_of(belief_at((1.5, 1.5), (8.5, 5.5), weights=[1.0, other]), ATLAS, SETTINGS)
        for other in (1.0, 0.01)
    )

    assert 1.0 < rare < 1.2 < even


def test_a_place_has_the_share_of_belief_that_stands_about_it():
    belief = belief_at((1.0, 1.0), (2.0, 2.0), (6.0, 6.0), weights=[0.1, 0.2, 0.7])

    assert 0.3 == pytest.approx(share_at(place(1.5, 1.5), belief, SETTINGS))
    assert 0.7 == pytest.approx(share_at(place(6.0, 6.5), belief, SETTINGS))
    assert 0.0 == share_at(place(9.0, 0.5), belief, SETTINGS)


def test_a_share_is_counted_in_metres():
    belief = belief_at((1.0, 1.0), (2.0, 2.0), (6.0, 6.0), weights=[0.1, 0.2, 0.7], scale=40.0)

    assert 0.3 == pytest.approx(share_at(place(1.5, 1.5, scale=40.0), belief, SETTINGS))


@given(beliefs)
def test_belief_agrees_with_itself_and_with_nothing_far_away(belief):
    far = belief_at((500.0, -500.0))

    assert 1.0 == pytest.approx(agreement(belief, belief, ATLAS, SETTINGS), abs=0.05)
    assert 0.0 == agreement(belief, far, ATLAS, SETTINGS)


def test_belief_agrees_by_the_share_that_stands_where_the_other_does():
    other = belief_at((1.5, 1.5), (1.5, 5.5))
    belief = belief_at((1.6, 1.4), (1.5, 5.0), (8.5, 5.5), weights=[0.2, 0.1, 0.7])

    assert 0.3 == pytest.approx(agreement(belief, other, ATLAS, SETTINGS))


def test_belief_in_the_next_block_agrees_too():
    assert 1.0 == agreement(belief_at((1.5, 1.5)), belief_at((2.2, 1.5)), ATLAS, SETTINGS)
    assert 1.0 == agreement(belief_at((2.2, 1.5)), belief_at((1.5, 1.5)), ATLAS, SETTINGS)
    assert 0.0 == agreement(belief_at((1.5, 1.5)), belief_at((4.5, 1.5)), ATLAS, SETTINGS)


@given(beliefs, spots, st.floats(0.0, 1.0))
def test_a_defended_place_comes_first_and_none_stands_beside_it_or_is_more_than_certain(
    belief, spot, confidence
):
    own = place(*spot)
    share = share_at(own, belief, SETTINGS)
    probability = max(share, confidence)

    places = defended(own, probability, share, find_places(belief, ATLAS, SETTINGS), SETTINGS)

    assert own.sketch_from_base == places[0].sketch_from_base
    assert probability == pytest.approx(places[0].probability)
    assert len(places) <= SETTINGS.hypotheses
    for other in places[1:]:
        away = np.hypot(*(other.sketch_from_base.pose.position - spot))
        assert away > SETTINGS.jump
    assert all(0.0 <= one.probability <= 1.0 for one in places)


def test_a_place_that_is_held_by_confidence_alone_leaves_the_rest_to_others():
    others = (place(8.0, 5.0, 0.75), place(8.0, 1.0, 0.25))

    places = defended(place(1.0, 1.0), 0.6, 0.0, others, SETTINGS)

    assert [0.6, 0.3, 0.1] == pytest.approx([one.probability for one in places])


def test_a_place_that_has_its_share_takes_nothing_from_others():
    others = (place(8.0, 5.0, 0.5), place(8.0, 1.0, 0.25))

    places = defended(place(1.0, 1.0), 0.25, 0.25, others, SETTINGS)

    assert [0.25, 0.5, 0.25] == pytest.approx([one.probability for one in places])


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 20.0))
def test_defended_confidence_moves_towards_the_share_and_never_beyond(confidence, share, distance):
    moved = defended_confidence(confidence, share, distance, SETTINGS, is_led=True)

    assert min(confidence, share) - 1e-9 <= moved <= max(confidence, share) + 1e-9
    assert confidence == pytest.approx(defended_confidence(confidence, share, 0.0, SETTINGS, is_led=True))


def test_defended_confidence_grows_faster_than_it_fades():
    grown = defended_confidence(0.2, 0.8, 2.0, SETTINGS, is_led=True) - 0.2
    faded = 0.8 - defended_confidence(0.8, 0.2, 2.0, SETTINGS, is_led=True)

    assert 0.0 < faded < grown
    assert 0.8 == defended_confidence(0.8, 0.2, 2.0, SETTINGS, is_led=False)


def test_the_first_place_is_claimed_no_surer_than_it_is():
    places = (place(1.0, 1.0, 0.6), place(8.0, 5.0, 0.4))

    sure, less = (estimate_from(places, confidence, 3.0, SETTINGS) for confidence in (0.9, 0.2))
    assert (0.6, Status.LOCATED) == (sure.confidence, sure.status)
    assert (0.2, Status.LOST) == (less.confidence, less.status)
    assert places[0].sketch_from_base == sure.sketch_from_base
