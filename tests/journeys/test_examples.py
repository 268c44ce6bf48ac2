"""The examples do what they say."""

import gzip
import runpy
import sys
from pathlib import Path

import pytest

from pilotage import worlds

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.mark.slow
def test_the_robot_of_the_example_reaches_the_archive(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["02_navigate.py"])
    runpy.run_path(str(EXAMPLES / "02_navigate.py"), run_name="__main__")
    lines = capsys.readouterr().out.splitlines()

    assert "explore, lost in" in lines[0]
    assert "is reached; " in lines[-1]


@pytest.mark.slow
def test_the_robot_of_the_other_example_says_where_it_is(monkeypatch, capsys, tmp_path):
    log = tmp_path / "run.log"
    with gzip.open(worlds.LOG, "rt") as whole:
        log.write_text("".join(list(whole)[:8]))
    monkeypatch.setattr(sys, "argv", ["01_localize.py", str(worlds.OFFICE.quick), str(log)])
    runpy.run_path(str(EXAMPLES / "01_localize.py"), run_name="__main__")
    first, *_ = capsys.readouterr().out.splitlines()

    assert "0.0 s  lost in " in first
    assert ", probability 0." in first
