"""The demo from its command to its picture."""

import json
import math

import pytest

from pilotage import demo, open_map
from pilotage.cli.demo import claim


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


def test_the_demo_leaves_files_of_others_alone(pilotage, tmp_path):
    precious = tmp_path / "estimates.jsonl"
    precious.write_text("precious")

    assert 1 == pilotage("demo", "-o", tmp_path).code
    assert "precious" == precious.read_text()
    assert [precious] == list(tmp_path.iterdir())


def test_the_demo_may_make_its_own_files_anew(tmp_path):
    file = tmp_path / "demo" / "where.png"
    claim(file.parent, [file], force=False)
    file.write_text("made by the demo")

    claim(file.parent, [file], force=False)


def test_the_packed_drawing_has_its_cells_named():
    words = {label.text for label in open_map(demo.SKETCH).labels}

    assert {"office", "library", "lab", "hall", "workshop", "kitchen"} <= words
