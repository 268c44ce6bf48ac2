"""The demo from its command to its pictures."""

import json
import re

import pytest
from PIL import Image

from pilotage import open_map, worlds
from pilotage.cli.demo import GOAL, claim
from pilotage.cli.drive import ANIMATION, FIGURE, JOURNAL


@pytest.mark.slow
def test_the_demo_drives_to_the_room_and_says_so(pilotage, tmp_path):
    folder = tmp_path / "demo"
    outcome = pilotage("demo", "-o", folder)
    records = [json.loads(line) for line in (folder / JOURNAL).read_text().splitlines()]
    told = re.search(r'In truth it stands in the room called "(.*)"\.', outcome.out)

    assert 0 == outcome.code
    assert "lost" == records[0]["status"]
    assert "reached" == records[-1]["outcome"]
    assert 0 == records[-1]["truth"]["collisions"]
    assert "the robot says that it stands in" in outcome.out
    assert GOAL == told[1]
    assert (folder / FIGURE).read_bytes().startswith(b"\x89PNG")
    assert 3e6 > (folder / ANIMATION).stat().st_size
    with Image.open(folder / ANIMATION) as picture:
        assert 200 >= picture.n_frames > 20


def test_the_demo_leaves_files_of_others_alone(pilotage, tmp_path):
    precious = tmp_path / JOURNAL
    precious.write_text("precious")

    assert 1 == pilotage("demo", "-o", tmp_path).code
    assert "precious" == precious.read_text()
    assert [precious] == list(tmp_path.iterdir())


def test_the_demo_may_make_its_own_files_anew(tmp_path):
    file = tmp_path / "demo" / FIGURE
    claim(file.parent, [file], force=False)
    file.write_text("made by the demo")

    claim(file.parent, [file], force=False)


def test_the_drawing_of_the_demo_names_its_goal():
    assert 1 == [label.text for label in open_map(worlds.OFFICE.quick).labels].count(GOAL)
