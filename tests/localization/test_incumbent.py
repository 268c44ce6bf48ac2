"""Who is believed when two beliefs disagree."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Pose2, Similarity2
from pilotage.localization import Hypothesis
from pilotage.localization.belief import Belief
from pilotage.localization.incumbent import Incumbent, IncumbentSettings, gain_of, incumbent_at

SETTINGS = IncumbentSettings(odds=10.0, most=2.0, least=1.0, reach=3.0, count=50)
SURE = 1.0


def belief_at(*places, log_weights=None, scale=1.0):
    """One hypothesis at each place."""
    states = np.zeros((6, len(places)))
    states[:2] = np.array(places, dtype=float).T
    states[3] = math.log(scale)
    return Belief(states, np.zeros(len(places)) if log_weights is None else np.array(log_weights))


SOMEWHERE = belief_at((0.0, 0.0))
HERE = Hypothesis("", Similarity2(1.0, Pose2.identity()), 0.9)


def defending(confidence, settings=SETTINGS):
    return incumbent_at(HERE, SOMEWHERE, confidence, settings, np.random.default_rng(0))


def after(incumbent, gains, settings=SETTINGS):
    """Contest it look by look until it is beaten; how many looks that took, and what is left."""
    for count, gain in enumerate(gains, start=1):
        incumbent = incumbent.contested(SOMEWHERE, gain, settings)
        if incumbent.is_beaten:
            return count, incumbent
    return math.inf, incumbent


def test_one_look_beats_no_incumbent_that_was_sure():
    count, incumbent = after(defending(SURE), [1e9])

    assert math.inf == count
    assert 0.5 < incumbent.credit


def test_only_the_last_of_a_great_worth_is_missed():
    told = Incumbent(SOMEWHERE, confidence=1.0, odds=40.0, stake=40.0)
    left = [replace(told, lead=lead).credit for lead in (0.0, 32.0, 36.0, 40.0)]

    assert [1.0, 1.0, 0.5, 0.0] == left


def test_a_challenger_that_goes_on_to_explain_better_wins():
    count, incumbent = after(defending(SURE), [5.0] * 100)

    assert math.ceil(SETTINGS.odds / SETTINGS.most) == count
    assert 0.0 == incumbent.credit


@given(st.floats(0.15, 1.0), st.floats(0.15, 1.0), st.floats(0.1, 5.0))
def test_the_surer_the_robot_was_the_longer_it_keeps_to_its_place(first, second, gain):
    (few, _), (many, _) = (
        after(defending(confidence), [gain] * 200) for confidence in sorted((first, second))
    )

    assert few <= many < math.inf


@given(st.lists(st.floats(-1e3, 0.0), max_size=20), st.floats(0.5, 1.0))
def test_whom_the_challenger_does_not_explain_better_loses_nothing(gains, confidence):
    count, incumbent = after(defending(confidence), gains)

    assert math.inf == count
    assert (0.0, 1.0) == (incumbent.lead, incumbent.credit)


def test_what_a_challenger_gained_it_can_lose_again():
    count, incumbent = after(defending(SURE), [1.5, -1.5] * 50)

    assert math.inf == count
    assert 0.0 == incumbent.lead


def test_one_look_that_the_challenger_explains_badly_does_not_undo_all():
    _, incumbent = after(defending(SURE), [2.0, 2.0, 2.0, -1e9])

    assert 0.0 < incumbent.lead < 6.0


@given(st.lists(st.floats(-10.0, 10.0), max_size=40), st.floats(0.2, 1.0))
def test_an_incumbent_that_is_not_beaten_has_credit(gains, confidence):
    incumbent = defending(confidence)
    for gain in gains:
        incumbent = incumbent.contested(SOMEWHERE, gain, SETTINGS)

        assert (0.0 < incumbent.credit) is not incumbent.is_beaten
        assert 0.0 <= incumbent.credit <= 1.0


def test_its_worth_is_settled_when_the_challenger_begins_to_lead():
    faded = Incumbent(SOMEWHERE, confidence=0.3, odds=SETTINGS.odds, stake=10.0, lead=1.0)

    assert 10.0 == faded.contested(SOMEWHERE, 1.0, SETTINGS).stake
    assert SETTINGS.odds * 0.3 == faded.contested(SOMEWHERE, -1.0, SETTINGS).stake


def test_its_belief_is_carried_on():
    moved = belief_at((1.0, 0.0))

    assert moved is defending(SURE).contested(moved, 0.0, SETTINGS).belief


def test_a_robot_that_is_not_sure_has_nothing_to_defend():
    assert defending(SETTINGS.least / SETTINGS.odds * 0.99) is None
    assert defending(SETTINGS.least / SETTINGS.odds * 1.01) is not None


@pytest.mark.parametrize("scale", [1.0, 40.0])
def test_only_what_stands_about_the_place_is_defended(scale):
    near, far = (scale * 1.0, scale * 2.0), (scale * 3.0, scale * 3.0)
    belief = belief_at(near, far, log_weights=[0.0, 5.0], scale=scale)
    place = Hypothesis("", Similarity2(scale, Pose2.identity()), 0.9)

    incumbent = incumbent_at(place, belief, SURE, SETTINGS, np.random.default_rng(0))

    assert SETTINGS.count == len(incumbent.belief)
    assert {near} == set(map(tuple, incumbent.belief.states[:2].T.tolist()))


def test_where_nothing_stands_nothing_is_defended():
    rng = np.random.default_rng(0)

    assert incumbent_at(HERE, belief_at((9.0, 9.0)), SURE, SETTINGS, rng) is None


def test_a_belief_gains_by_what_it_predicted_better():
    before, its_before = belief_at((0, 0), (1, 0)), belief_at((5, 5))
    after_look = Belief(before.states, np.log([0.5, 0.25]))  # it predicted .75 / 2 of what was seen
    its_after = Belief(its_before.states, np.log([0.05]))

    gain = gain_of((before, after_look), (its_before, its_after))
    back = gain_of((its_before, its_after), (before, after_look))
    assert math.isclose(math.log(0.375 / 0.05), gain)
    assert math.isclose(-gain, back)


def test_how_many_hypotheses_there_are_is_no_gain():
    before, its_before = belief_at(*[(0, 0)] * 7), belief_at(*[(0, 0)] * 3)
    after_look, its_after = (Belief(one.states, one.log_weights - 2.0) for one in (before, its_before))

    assert math.isclose(0.0, gain_of((before, after_look), (its_before, its_after)), abs_tol=1e-12)


@pytest.mark.parametrize("name", ["told", "odds", "least", "reach"])
def test_worths_are_not_negative(name):
    with pytest.raises(ValueError, match=f"{name} must be >= 0"):
        IncumbentSettings(**{name: -1.0})


@pytest.mark.parametrize(("name", "rule"), [("most", "> 0"), ("count", ">= 1")])
def test_a_look_counts_for_something_and_there_are_hypotheses(name, rule):
    with pytest.raises(ValueError, match=f"{name} must be {rule}"):
        IncumbentSettings(**{name: 0})
