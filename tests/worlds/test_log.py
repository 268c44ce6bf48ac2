"""The packed log fits the office that it was driven in."""

import json
import runpy
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from pilotage import open_log, open_map, worlds

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def test_the_truth_lies_inside_the_drawing_at_the_times_of_the_scans():
    truth = [json.loads(line) for line in worlds.TRUTH.read_text().splitlines()]
    sketch = open_map(worlds.OFFICE.quick)
    left, bottom, right, top = sketch.bounds
    x, y = sketch.sketch_from_file(np.array([(row["x"], row["y"]) for row in truth])).T

    assert [reading.scan.stamp for reading in open_log(worlds.LOG)] == [row["stamp"] for row in truth]
    assert (left < x).all()
    assert (x < right).all()
    assert (bottom < y).all()
    assert (y < top).all()


def test_furniture_is_in_the_world_and_not_in_the_sketch():
    world, sketch = open_map(worlds.OFFICE.world), open_map(worlds.OFFICE.quick)
    things = ET.parse(worlds.OFFICE.world).find(".//*[@id='things']")  # noqa: S314  # our own

    assert 30 <= len(things)
    assert 36.0 > world.bounds[2] - world.bounds[0]
    assert not any(stroke.closed for stroke in sketch.strokes)
    assert "kitchen" in [label.text for label in sketch.labels]


def test_the_script_makes_the_packed_log_again(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["make_log.py", str(tmp_path)])
    monkeypatch.syspath_prepend(str(EXAMPLES))
    runpy.run_path(str(EXAMPLES / "make_log.py"), run_name="__main__")

    assert worlds.TRUTH.read_text() == (tmp_path / "truth.jsonl").read_text()
    assert len(open_log(worlds.LOG)) == len(open_log(tmp_path / "run.log.gz"))
