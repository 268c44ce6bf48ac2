"""`pilotage which` ranks the drawing of the right building first, whatever the order of its arguments."""

import pickle
from contextlib import nullcontext

import pytest

from pilotage import FileError, LocalizerSettings, ranking, workers, worlds
from pilotage.cli import which
from pilotage.ranking import Evidence, Score
from pilotage.ranking.evidence import reduced


class Here:
    """A worker that is this process."""

    def run(self, function, tasks):
        yield from ((task, function(task)) for task in tasks)


@pytest.mark.slow
def test_the_right_building_comes_first(pilotage, tmp_path):
    broken = tmp_path / "broken.svg"
    broken.write_text("<svg", encoding="utf-8")
    outcome = pilotage(
        "which",
        worlds.MUSEUM.careful,
        worlds.LOG,
        worlds.OFFICE.careful,
        broken,
        "--travel",
        "6",
        "--workers",
        "1",
    )
    lines = outcome.out.splitlines()

    assert 0 == outcome.code
    assert 2 == len(lines)
    assert str(worlds.OFFICE.careful) in lines[0]
    assert "left out" in outcome.err


@pytest.mark.slow
def test_a_mirrored_drawing_is_told(pilotage, tmp_path, monkeypatch):
    monkeypatch.setattr(which, "opened", lambda *_: nullcontext(Here()))
    monkeypatch.setitem(ranking.rank.__globals__, "SETTINGS", reduced(LocalizerSettings(), 1 / 8))
    content = worlds.OFFICE.careful.read_text(encoding="utf-8")
    opening = content.index(">", content.index("<svg")) + 1
    flipped = tmp_path / "flipped.svg"
    flipped.write_text(
        f'{content[:opening]}<g transform="scale(-1,1)">{content[opening:].replace("</svg>", "</g></svg>")}',
        encoding="utf-8",
    )
    lines = pilotage("which", flipped, worlds.LOG, "--mirrored", "--travel", "6").out.splitlines()

    assert 2 == len(lines)
    assert lines[0].endswith("flipped.svg, mirrored")
    assert lines[1].endswith("flipped.svg")


def test_an_interrupted_ranking_shows_what_it_has(pilotage, monkeypatch):
    def interrupted(drawings, logs, _workers, board, **_rest):
        board.scores = {
            logs[0]: {(drawings[1], False): Score(drawings[1], Evidence(2.5, "hall", 0.5), is_refined=False)}
        }
        raise KeyboardInterrupt
        yield

    monkeypatch.setattr(ranking, "rank", interrupted)
    outcome = pilotage("which", worlds.OFFICE.careful, worlds.OFFICE.quick, worlds.LOG)

    assert 130 == outcome.code
    assert f"1 ~     +2.5  0.50  hall  {worlds.OFFICE.quick}" in outcome.out
    assert "interrupted; run.log.gz was compared with 1 of 2 drawings" in outcome.err


def test_a_cluster_that_is_not_there_is_told(pilotage, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr(workers, "PATIENCE", "1s")
    outcome = pilotage("which", worlds.OFFICE.careful, worlds.LOG, "--scheduler", "tcp://127.0.0.1:1")

    assert 1 == outcome.code
    assert "there is no scheduler of Dask at tcp://127.0.0.1:1" in outcome.err


@pytest.mark.parametrize("words", [(worlds.LOG,), (worlds.OFFICE.careful,)])
def test_a_drawing_and_a_log_are_needed(pilotage, words):
    outcome = pilotage("which", *words)

    assert 1 == outcome.code
    assert "is missing" in outcome.err


def test_errors_pass_from_one_process_to_another():
    error = pickle.loads(pickle.dumps(FileError("the file is empty", "a.svg")))  # noqa: S301  # our own

    assert ("the file is empty", "the file is empty: a.svg") == (error.rule, str(error))
