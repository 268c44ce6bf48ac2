"""Estimates are written in the drawing's own units and axes."""

import json
import math

import pytest

from knowing import estimate_of, hypothesis_at
from pilotage.geometry import Polyline, Pose2
from pilotage.io.estimates import estimates_file
from pilotage.maps import SchematicMap

SKETCH = SchematicMap((Polyline.through([(0, 0), (9, -9)]),), y_down=True)
HERE = Pose2(30.0, -40.0, math.pi / 2)
ESTIMATE = estimate_of(
    hypothesis_at(HERE, scale=20.0, cell_id="c1", probability=0.75),
    hypothesis_at(HERE, scale=20.0, cell_id="c2", probability=0.25),
    stamp=1.5,
    fit=0.5,
    y_down=True,
)


def test_a_line_holds_what_it_should(tmp_path):
    path = tmp_path / "estimates.jsonl"
    with estimates_file(path, SKETCH) as write:
        write(ESTIMATE)
        write(ESTIMATE)
    first, second = path.read_text().splitlines()
    place = {"x": 30.0, "y": 40.0, "heading": 1.57079633, "scale": 20.0}

    assert first == second
    assert {
        "stamp": 1.5,
        "status": "located",
        "place": "c1",
        "cell": "c1",
        **place,
        "probability": 0.75,
        "fit": 0.5,
        "evidence": 0.0,
        "hypotheses": [
            {"cell": "c1", **place, "probability": 0.75},
            {"cell": "c2", **place, "probability": 0.25},
        ],
    } == json.loads(first)


def test_a_run_that_breaks_leaves_no_file(tmp_path):
    with pytest.raises(ZeroDivisionError), estimates_file(tmp_path / "estimates.jsonl", SKETCH) as write:
        write(1 / 0)

    assert [] == list(tmp_path.iterdir())
