"""When a drawing is claimed to be of another building."""

from dataclasses import replace

import numpy as np
import pytest

from buildings import coarse, flat, readings_of, walk
from pilotage.localization import Localizer, LocalizerSettings, Status, TrackSettings
from pilotage.localization.belief import MISMATCH, NO_MISMATCH
from pilotage.maps import build_atlas

FEW = LocalizerSettings(tracks=TrackSettings(first_count=2_000, max_count=500, min_count=100), proposals=100)


@pytest.fixture(scope="module")
def belief():
    """What is believed after a scan; its evidence is 0."""
    localizer = Localizer(build_atlas(flat(), coarse()), FEW)
    localizer.update(*readings_of(walk()[:1])[0])
    held = localizer.state.belief
    return replace(held, log_elsewhere=held.log_elsewhere + held.log_evidence)


def with_evidence(belief, log_evidence, status=Status.LOST, log_told=0.0):
    return replace(
        belief,
        log_elsewhere=belief.log_elsewhere - log_evidence,
        at_keyframe=replace(belief.at_keyframe, status=status),
        posterior=replace(belief.posterior, log_told=log_told),
    )


def test_a_drawing_is_to_blame_if_other_buildings_explain_the_way_far_better(belief):
    assert np.isclose(0.0, belief.log_evidence)
    assert not with_evidence(belief, MISMATCH + 0.1).is_mismatch
    assert with_evidence(belief, MISMATCH - 0.1).is_mismatch


def test_it_is_so_until_it_explains_the_way_as_well(belief):
    assert with_evidence(belief, NO_MISMATCH - 0.1, Status.MISMATCH).is_mismatch
    assert not with_evidence(belief, NO_MISMATCH + 0.1, Status.MISMATCH).is_mismatch


def test_a_start_that_was_told_speaks_for_the_drawing(belief):
    assert not with_evidence(belief, MISMATCH - 0.1, log_told=-12.0).is_mismatch
    assert with_evidence(belief, MISMATCH - 12.1, log_told=-12.0).is_mismatch
