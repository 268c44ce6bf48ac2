"""The demo from its command to its picture."""

import json
import math

import pytest

from pilotage import demo, open_map


@pytest.fixture(scope="module")
def truth():
    return [json.loads(line) for line in demo.TRUTH.read_text().splitlines()]


def test_the_demo_finds_the_robot_and_says_so(pilotage, tmp_path, truth):
    outcome = pilotage("demo", "-o", tmp_path / "demo")
    records = [json.loads(line) for line in (tmp_path / "demo" / "estimates.jsonl").read_text().splitlines()]
    final = records[-1]

    assert 0 == outcome.code
    assert [row["stamp"] for row in truth] == [record["stamp"] for record in records]
    assert "located" == final["status"]
    assert 2.0 * final["scale"] > math.dist((final["x"], final["y"]), (truth[-1]["x"], truth[-1]["y"]))
    assert 'near the word "kitchen"' in outcome.out
    assert (tmp_path / "demo" / "where.png").read_bytes().startswith(b"\x89PNG")


def test_the_demo_makes_its_own_files_anew_and_no_others(pilotage, tmp_path, monkeypatch):
    monkeypatch.setattr("pilotage.cli.demo.read_stretch", lambda log, _first, _last: few_of(log))
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "estimates.jsonl").write_text("precious")

    assert 1 == pilotage("demo", "-o", folder).code
    assert "precious" == (folder / "estimates.jsonl").read_text()
    assert ["estimates.jsonl"] == [path.name for path in folder.iterdir()]


def few_of(log):
    raise AssertionError(f"{log} was read before the folder was looked at")


def test_the_packed_drawing_has_its_cells_named():
    words = {label.text for label in open_map(demo.SKETCH).labels}

    assert {"office", "library", "lab", "hall", "workshop", "kitchen"} <= words
