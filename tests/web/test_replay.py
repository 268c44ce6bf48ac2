"""A log is replayed scan by scan, each at its time, and a bag is gone through once."""

import pytest
from benchmarks.lib.bag_making import Maker, write_bag

from pilotage.io.bags import reader
from pilotage.web.replay import LONGEST_PAUSE, LogSource

STAMPS = [10.0, 10.1, 10.3, 15.0]


@pytest.fixture
def bag(tmp_path):
    maker = Maker("")
    return write_bag(
        tmp_path / "run", [("/scan", stamp, maker.scan(stamp, [1.0, 2.0])) for stamp in STAMPS], ".mcap"
    )


def test_scans_come_in_order_each_at_its_time(bag):
    source = LogSource(bag)
    steps, read, stamps = [], [], [source.stamp]
    while not source.is_over:
        steps.append(source.time_step)
        read.append(source.read().scan.stamp)
        stamps.append(source.stamp)

    assert STAMPS == read
    assert pytest.approx([0.0, 0.1, 0.2, LONGEST_PAUSE]) == steps
    assert pytest.approx([0.0, 0.0, 0.1, 0.3, 5.0]) == stamps
    assert 0.0 == source.time_step
    with pytest.raises(ValueError, match="has ended"):
        source.read()


def test_a_bag_is_opened_for_its_frames_and_for_its_scans_and_no_more(bag, monkeypatch):
    paths, opened = [], reader.opened
    monkeypatch.setattr(reader, "opened", lambda path: paths.append(path) or opened(path))
    source = LogSource(bag)
    while not source.is_over:
        source.read()

    assert [bag, bag] == paths
