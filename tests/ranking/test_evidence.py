"""What many drawings share of a log tells each of them the same as the log itself."""

from itertools import takewhile

import pytest

from pilotage import Localizer, LocalizerSettings, open_log, open_map, worlds
from pilotage.ranking import observations_of, weigh
from pilotage.ranking.evidence import reduced

TRAVEL = 6.0
SETTINGS = reduced(LocalizerSettings(), 1 / 50)


@pytest.fixture(scope="module")
def readings():
    return list(open_log(worlds.LOG))


def test_the_evidence_is_that_of_a_localizer_that_reads_the_log(readings):
    localizer = Localizer(open_map(worlds.OFFICE.careful), SETTINGS, seed=3)
    observations = observations_of(readings, TRAVEL, SETTINGS)
    last = observations[-1].stamp
    for reading in takewhile(lambda one: one.scan.stamp <= last, readings):
        estimate = localizer.update(reading.scan, reading.odometry)

    found = weigh(localizer.atlas, observations, SETTINGS, seed=3)

    assert localizer.log_evidence == found.log_evidence
    assert (estimate.place, estimate.probability) == (found.place, found.probability)


def test_no_more_is_looked_at_than_was_asked_for(readings):
    observations = observations_of(readings, TRAVEL, SETTINGS)

    assert TRAVEL - 1.0 < sum(abs(complex(one.motion.x, one.motion.y)) for one in observations) < TRAVEL + 0.5


def test_a_log_needs_a_scan():
    with pytest.raises(ValueError, match="a log needs a scan"):
        observations_of([], TRAVEL, SETTINGS)


def test_a_share_of_the_particles_is_a_valid_setting():
    few = reduced(LocalizerSettings(), 1e-6)

    assert 1 == few.tracks.min_count == few.tracks.max_count
    assert 100 == few.proposals
