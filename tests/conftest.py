"""What all tests share: the command line within a test, one range table of each drawing, examples."""

import gc
import sys
from typing import NamedTuple

import pytest
from hypothesis import settings

from pilotage.cli import main
from pilotage.maps import atlas

collect_ignore = ["io/bags/record_with_rosbag.py"]  # runs on a Python that has the rosbag of ROS 1

settings.register_profile(
    "patient",
    deadline=None,  # the first call compiles
    max_examples=50,  # laws break early or, with derandomized examples, never
    derandomize=True,  # the same code gives the same answer
)
settings.load_profile("patient")


TABLES = 16
"""So many range tables are kept, 6 MB each."""


def pytest_collection_finish():
    """Keep the garbage collector off modules and tests: they stay, and each full pass would visit them."""
    gc.collect()
    gc.freeze()


class Outcome(NamedTuple):
    code: int
    out: str
    err: str


@pytest.fixture
def pilotage(monkeypatch, capsys):
    """Call `pilotage` with these words and tell its exit code and what it wrote."""

    def call(*words):
        monkeypatch.setattr(sys, "argv", ["pilotage", *map(str, words)])
        with pytest.raises(SystemExit) as caught:
            main()
        captured = capsys.readouterr()
        return Outcome(caught.value.code or 0, captured.out, captured.err)

    return call


@pytest.fixture(scope="session", autouse=True)
def _one_range_table_of_each_drawing():
    """Look around once on drawings on which many tests drive: it is most of what a drive costs to begin."""
    look_around, tables = atlas.build_range_table, {}

    def kept(sketch, settings):
        seen = sketch.bounds, sketch.segments.tobytes(), settings
        if seen not in tables:
            tables[seen] = look_around(sketch, settings)
            if len(tables) > TABLES:
                del tables[next(iter(tables))]
        return tables[seen]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(atlas, "build_range_table", kept)
        yield
