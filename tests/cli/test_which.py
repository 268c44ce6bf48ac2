"""`pilotage which` ranks the drawing of the right building first, whatever the order of its arguments."""

import pickle

import pytest

from pilotage import FileError, worlds


@pytest.mark.slow
def test_the_right_building_comes_first(pilotage, tmp_path):
    broken = tmp_path / "broken.svg"
    broken.write_text("<svg", encoding="utf-8")
    outcome = pilotage(
        "which", worlds.MUSEUM.careful, worlds.LOG, worlds.OFFICE.careful, broken, "--travel", "25"
    )
    lines = outcome.out.splitlines()

    assert 0 == outcome.code
    assert 2 == len(lines)
    assert str(worlds.OFFICE.careful) in lines[0]
    assert "left out" in outcome.err


@pytest.mark.slow
def test_a_mirrored_drawing_is_told(pilotage, tmp_path):
    content = worlds.OFFICE.careful.read_text(encoding="utf-8")
    opening = content.index(">", content.index("<svg")) + 1
    flipped = tmp_path / "flipped.svg"
    flipped.write_text(
        f'{content[:opening]}<g transform="scale(-1,1)">{content[opening:].replace("</svg>", "</g></svg>")}',
        encoding="utf-8",
    )
    lines = pilotage("which", flipped, worlds.LOG, "--mirrored", "--travel", "25").out.splitlines()

    assert 2 == len(lines)
    assert lines[0].endswith("flipped.svg, mirrored")
    assert lines[1].endswith("flipped.svg")


@pytest.mark.parametrize("words", [(worlds.LOG,), (worlds.OFFICE.careful,)])
def test_a_drawing_and_a_log_are_needed(pilotage, words):
    outcome = pilotage("which", *words)

    assert 1 == outcome.code
    assert "is missing" in outcome.err


def test_errors_pass_from_one_process_to_another():
    error = pickle.loads(pickle.dumps(FileError("the file is empty", "a.svg")))  # noqa: S301  # our own

    assert ("the file is empty", "the file is empty: a.svg") == (error.rule, str(error))
