"""The drawing is corrected beside a drive, no more often than can be afforded."""

import itertools
import math
import multiprocessing
import os
import sys
import time
from multiprocessing.connection import wait

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from buildings import WALLS, coarse, flat, scan_at, walk
from pilotage.correction import Sighting, correct_drawing
from pilotage.geometry import Affine2
from pilotage.localization import Estimate, PoseHypothesis, Status
from pilotage.maps import build_atlas
from pilotage.web import bending
from pilotage.web.bending import REST, SIGHTINGS, Bending, describe_corrected

SCALE = 10.0
ATLAS = build_atlas(flat(SCALE), coarse())
FORKS = pytest.mark.skipif(sys.platform == "win32", reason="Windows cannot fork")
pytestmark = pytest.mark.filterwarnings(
    "ignore:.*multi-threaded:DeprecationWarning"
)  # drives have one thread
FOUND = {"seen_share": 0.5}


def sightings(probability=0.9):
    """Walk through the flat and look around, each place estimated as it is."""
    found = []
    for number, pose in enumerate(walk()[::2]):
        place = Affine2(SCALE * pose.rotation, SCALE * pose.position)
        hypothesis = PoseHypothesis("", place, probability)
        estimate = Estimate(0.0, Status.LOCATED, (hypothesis,), probability, 1.0, "")
        scan = scan_at(pose, fov=1.5 * math.pi, beams=271)
        found.append(Sighting.of(scan, pose, 0.5 * number, estimate))
    return found


def heard(corrector):
    """Wait for the fit that goes on, and return what it found."""
    assert wait(corrector.pipes, 60.0)
    return corrector.result()


def test_a_right_drawing_is_laid_over_itself_where_it_was_seen() -> None:
    told = describe_corrected(correct_drawing(ATLAS, sightings()), ATLAS.sketch)

    places = np.vstack([wall.vertices for wall in WALLS]) * (SCALE, -SCALE)
    corners = np.array([point for line in told["seen"] + told["unseen"] for point in line])
    for place in places:
        assert np.hypot(*(corners - place).T).min() < 0.15 * SCALE
    assert told["seen_share"] > 0.6
    assert {"open"} == {one["state"] for one in told["passages"]}


@FORKS
def test_a_fit_is_made_beside_the_drive_and_one_that_is_not_sure_tells_nothing() -> None:
    _, drive = multiprocessing.Pipe()
    sure, unsure = Bending(ATLAS, sightings(), drive), Bending(ATLAS, sightings(0.1), drive)
    for corrector in (sure, unsure):
        corrector.begin_if_due(is_over=False)

    assert heard(sure) == describe_corrected(correct_drawing(ATLAS, sightings()), ATLAS.sketch)
    assert heard(unsure) is None
    assert not drive.closed


@FORKS
def test_a_fit_that_fails_is_left_out_and_the_next_one_is_made(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def failing(*_: object) -> None:
        raise MemoryError

    seen = sightings()
    corrector = Bending(ATLAS, seen, multiprocessing.Pipe()[1])
    monkeypatch.setattr(bending, "fit_drawing", failing)
    corrector.begin_if_due(is_over=True)
    assert heard(corrector) is None
    monkeypatch.undo()
    seen.append(seen[-1])
    corrector.begin_if_due(is_over=True)

    assert heard(corrector) is not None
    assert "" == capfd.readouterr().err


@FORKS
def test_the_last_fit_gives_way_to_nothing_and_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = [None] * SIGHTINGS
    corrector = Bending(ATLAS, seen, multiprocessing.Pipe()[1])

    def work(sightings):
        def fit():
            time.sleep(600.0 if len(sightings) == SIGHTINGS else 0.0)
            return {"niceness": os.nice(0)}, 0.0

        return fit

    def forked(*given, **how):
        begun.append(bending_forked(*given, **how))
        return begun[-1]

    begun, bending_forked = [], bending.forked
    monkeypatch.setattr(bending, "forked", forked)
    monkeypatch.setattr(corrector, "_work", work)
    corrector.begin_if_due(is_over=False)
    seen.append(None)
    corrector.begin_if_due(is_over=False)
    assert 1 == len(begun)
    corrector.begin_if_due(is_over=True)
    last = corrector.pipes
    corrector.begin_if_due(is_over=True)

    assert last == corrector.pipes
    assert {"niceness": os.nice(0)} == heard(corrector)
    with pytest.raises(ProcessLookupError):
        os.kill(begun[0][0], 0)


@settings(deadline=None)
@given(st.floats(0.1, 20.0), st.lists(st.integers(1, 9), min_size=1, max_size=40))
def test_fits_use_less_than_a_tenth_of_a_processor(takes: float, more: list[int]) -> None:
    clock, used, seen = [0.0], 0.0, []
    begun = []

    def forked(*_: object, **__: object):
        here, there = multiprocessing.Pipe(duplex=False)
        there.send((FOUND, takes))
        begun.append(len(seen))
        return 0, here

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bending, "forked", forked)
        patch.setattr(bending.os, "waitpid", lambda *_: None)
        patch.setattr(bending.time, "monotonic", lambda: clock[0])
        corrector = Bending(ATLAS, seen, None)
        for count in more:
            seen += [None] * count
            clock[0] += 1.0
            corrector.begin_if_due(is_over=False)
            if corrector.pipes:
                clock[0] += takes
                used += takes
                assert FOUND == corrector.result()
        corrector.begin_if_due(is_over=True)
        is_last = bool(corrector.pipes)
        if is_last:
            corrector.result()

    assert used <= takes + clock[0] / REST
    assert all(
        later - earlier >= SIGHTINGS
        for earlier, later in itertools.pairwise(begun[: -1 if is_last else None])
    )
    assert begun[-1] == len(seen)
