"""Run the command line inside the test."""

import sys
from typing import NamedTuple

import pytest
from hypothesis import settings

from pilotage.cli import main

collect_ignore = ["io/bags/record_with_rosbag.py"]  # runs on a Python that has the rosbag of ROS 1

settings.register_profile(
    "patient",
    deadline=None,  # the first call compiles
    max_examples=50,  # laws break early or, with derandomized examples, never
    derandomize=True,  # the same code gives the same answer
)
settings.load_profile("patient")


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
