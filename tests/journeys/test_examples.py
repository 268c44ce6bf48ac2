"""The examples do what they say."""

import runpy
import sys
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def test_the_robot_of_the_example_reaches_the_archive(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["02_navigate.py"])
    runpy.run_path(str(EXAMPLES / "02_navigate.py"), run_name="__main__")
    lines = capsys.readouterr().out.splitlines()

    assert "explore, lost in" in lines[0]
    assert "is reached; " in lines[-1]
