"""A journal is read back as it was written."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from made_up_drive import SKETCH, through_the_door
from pilotage.errors import FileError
from pilotage.io.estimates import estimates_file
from pilotage.io.journal import journal_file, step_record
from pilotage.io.journal_reader import read_journal
from pilotage.navigation import Outcome, Visit

DRIVE = through_the_door()
PLACE = {"cell": "a", "x": 0, "y": 0, "heading": 0, "scale": 1, "probability": 1}


@pytest.fixture
def journal(tmp_path):
    path = tmp_path / "journal.jsonl"
    with journal_file(path, SKETCH) as write:
        for step, scene in zip(DRIVE.steps, DRIVE.scenes, strict=True):
            write(step, scene)
    return path


def test_what_was_written_is_read(journal):
    moments = read_journal(journal, SKETCH)

    assert len(DRIVE.steps) == len(moments)
    for moment, step, scene in zip(moments, DRIVE.steps, DRIVE.scenes, strict=True):
        written, read = (step_record(one, scene, SKETCH) for one in (step, moment.step))
        del written["position_std"], read["position_std"]  # the reader does not need it
        assert written == read
        assert np.allclose(scene.world_from_base.position, moment.world_from_base.position)
        assert scene.collisions == moment.collisions


def test_the_goals_of_a_tour_that_are_over_are_read(tmp_path):
    path = tmp_path / "tour.jsonl"
    visits = (
        Visit("kitchen", Outcome.REACHED, 12.0, "'kitchen' is reached"),
        Visit((3.0, -4.5), Outcome.GAVE_UP, 40.0, "no way leads there"),
    )
    with journal_file(path, SKETCH) as write:
        write(replace(DRIVE.steps[0], visits=visits), DRIVE.scenes[0])

    assert visits == read_journal(path, SKETCH)[0].step.visits


def test_a_file_of_estimates_is_a_journal_of_a_robot_that_stands(tmp_path):
    path = tmp_path / "estimates.jsonl"
    with estimates_file(path, SKETCH) as write:
        for step in DRIVE.steps:
            write(step.estimate)
    moment = read_journal(path, SKETCH)[-1]

    assert DRIVE.steps[-1].estimate.place == moment.step.estimate.place
    assert moment.world_from_base is None
    assert math.inf == moment.step.distance


@pytest.mark.parametrize(
    "spoilt",
    [
        {"status": "happy"},
        {"hypotheses": [{**PLACE, "probability": 7}]},
        {"hypotheses": [{**PLACE, "x": 1e300}]},
        {"hypotheses": [{**PLACE, "scale": 0}]},
        {"hypotheses": [{"cell": "a"}]},
        {"behavior": "dance"},
        {"goals": [{"goal": "kitchen", "outcome": "happy", "stamp": 1}]},
        {"goals": [{"goal": [1], "outcome": "reached", "stamp": 1}]},
        {"behavior": []},
        {"command": 3},
        {"distance": "far"},
        {"truth": {"x": 1}},
        {"truth": 4},
        {"outcome": "won"},
        {"closed_gateways": 5},
        {"stamp": -1},
    ],
)  # fmt: skip
def test_a_spoilt_line_is_named(journal, spoilt):
    lines = journal.read_text().splitlines()
    lines[7] = json.dumps({**json.loads(lines[7]), **spoilt})
    journal.write_text("\n".join(lines))

    with pytest.raises(FileError, match="line 8 must"):
        read_journal(journal, SKETCH)


def test_an_empty_journal_is_refused(tmp_path):
    path = tmp_path / "journal.jsonl"
    path.write_text("")

    with pytest.raises(FileError, match="at least one line"):
        read_journal(path, SKETCH)
