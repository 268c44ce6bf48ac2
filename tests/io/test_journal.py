"""A drive is written step by step, what was believed apart from what was true."""

import json
import math

import numpy as np
import pytest

from knowing import estimate_of, hypothesis_at
from pilotage.geometry import Polyline, Pose2, Twist
from pilotage.io.journal import journal_file
from pilotage.maps import SchematicMap
from pilotage.navigation import Behavior, Outcome, Step
from pilotage.perception import LaserScan
from pilotage.simulation import Scene

SKETCH = SchematicMap((Polyline.through([(0, 0), (9, -9)]),), y_down=True)
HERE = hypothesis_at(
    Pose2(30.0, -40.0, math.pi / 2), scale=20.0, cell_id="c1", probability=0.75, position_std=0.25
)
ESTIMATE = estimate_of(HERE, stamp=1.5, cell_probability=0.9, y_down=True)
SCAN = LaserScan(1.5, -1.0, 1.0, np.array([1.0, 2.0, 3.0]))
SCENE = Scene(Pose2(2.0, 3.0, 0.5), SCAN, np.empty((0, 2)), np.empty((0, 4)), collisions=1)
FIRST = Step(1.5, Twist(0.5, -0.1), Behavior.LOOK_AROUND, ESTIMATE)
LAST = Step(
    1.6, Twist(0.0, 0.0), Behavior.REST, ESTIMATE, next_cell_id="c2",
    gateway_id="g1", target=(1.0, -0.5), distance=4.0, closed_gateway_ids=("g3",), times_lost=1,
    outcome=Outcome.REACHED, reason="there it is",
)  # fmt: skip


@pytest.fixture
def records(tmp_path):
    path = tmp_path / "journal.jsonl"
    with journal_file(path, SKETCH) as write:
        write(FIRST, SCENE)
        write(LAST, SCENE)
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_a_line_holds_what_it_should(records):
    line = records[1]

    assert {
        "stamp": 1.6,
        "status": "located",
        "cell": "c1",
        "x": 30.0,
        "y": 40.0,
        "heading": 1.57079633,
        "scale": 20.0,
        "behavior": "rest",
        "cell_probability": 0.9,
        "position_std": 0.25,
        "next_cell": "c2",
        "gateway": "g1",
        "target": [1.0, -0.5],
        "distance": 4.0,
        "command": {"linear": 0.0, "angular": 0.0},
        "closed_gateways": ["g3"],
        "times_lost": 1,
        "outcome": "reached",
        "reason": "there it is",
        "truth": {"x": 2.0, "y": 3.0, "heading": 0.5, "collisions": 1},
    }.items() <= line.items()
    assert ["c1"] == [one["cell"] for one in line["hypotheses"]]


def test_what_is_unknown_is_null(records):
    unknown = {key for key, value in records[0].items() if value is None}

    assert {"target", "distance", "outcome"} == unknown


def test_a_drive_that_breaks_leaves_no_journal(tmp_path):
    with pytest.raises(ZeroDivisionError), journal_file(tmp_path / "journal.jsonl", SKETCH) as write:
        write(FIRST, 1 / 0)

    assert [] == list(tmp_path.iterdir())
