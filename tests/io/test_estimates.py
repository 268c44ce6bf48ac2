"""Estimates are written in the drawing's own units and axes."""

import json
import math

import pytest

from pilotage.geometry import Polyline, Pose2, Similarity2
from pilotage.io.estimates import estimates_file
from pilotage.localization import Estimate, Hypothesis, Status
from pilotage.maps import SchematicMap

SKETCH = SchematicMap((Polyline.through([(0, 0), (9, -9)]),), y_down=True)
HERE = Similarity2(20.0, Pose2(30.0, -40.0, math.pi / 2))
ESTIMATE = Estimate(1.5, Status.LOCATED, "c1", HERE, 0.75, (Hypothesis("c2", HERE, 0.25),))


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
        "cell": "c1",
        **place,
        "confidence": 0.75,
        "hypotheses": [{"cell": "c2", **place, "probability": 0.25}],
    } == json.loads(first)


def test_a_run_that_breaks_leaves_no_file(tmp_path):
    with pytest.raises(ZeroDivisionError), estimates_file(tmp_path / "estimates.jsonl", SKETCH) as write:
        write(1 / 0)

    assert [] == list(tmp_path.iterdir())
