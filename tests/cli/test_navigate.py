"""Driving from the command line: what it leaves, and what it refuses before anything moves."""

import json

import pytest
from PIL import Image

from pilotage.cli.drive import ANIMATION, FIGURE, JOURNAL

WALLS = """<rect x="0" y="0" width="150" height="50"/>
<polyline points="50,0 50,20"/><polyline points="50,30 50,50"/>
<polyline points="100,0 100,20"/><polyline points="100,30 100,50"/>
<rect x="170" y="0" width="30" height="30"/>"""
"""Three rooms in a row, and one apart."""
WORDS = """<text x="20" y="15" font-size="5">office</text><text x="75" y="15" font-size="5">kitchen</text>
<text x="120" y="15" font-size="5">office</text><text x="180" y="15" font-size="5">shed</text>"""
MARKS = '<circle id="start" cx="25" cy="25" r="2"/><circle id="goal" cx="75" cy="35" r="2"/>'
FEW = """[localizer.atlas.range_table]
cells = 80
directions = 60
"""
SOUTH_WEST = ("--from", "2.5,-2.5,0")


def svg(path, body, scale=1.0):
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {200 * scale} {50 * scale}">'
        f'<g transform="scale({scale})" fill="none" stroke="black">{body}</g></svg>'
    )
    return path


@pytest.fixture
def site(tmp_path):
    """Return a drawing, its building at a tenth of its size in metres, and a folder to write to."""
    settings = tmp_path / "few.toml"
    settings.write_text(FEW)
    drawing, world = svg(tmp_path / "suite.svg", WALLS + WORDS), svg(tmp_path / "world.svg", WALLS, 0.1)
    return drawing, world, tmp_path / "run", settings


@pytest.fixture
def call(pilotage, site):
    """Call `pilotage navigate` on the site; options come later and so win."""
    drawing, world, folder, settings = site
    return lambda *words, drawing=drawing: pilotage(
        "navigate", drawing, "--world", world, "-o", folder, "--settings", settings, *words
    )


def test_a_drive_leaves_journal_figure_and_animation(call, site):
    folder = site[2]
    outcome = call(
        "--goal", "kitchen", "--start", "25,25,0", *SOUTH_WEST, "--scale", "10", "--time-limit", "6"
    )
    records = [json.loads(line) for line in (folder / JOURNAL).read_text().splitlines()]
    progress = outcome.err.splitlines()

    assert 0 == outcome.code
    assert {JOURNAL, FIGURE, ANIMATION} == {path.name for path in folder.iterdir()}
    assert {"x": 2.5, "y": -2.5, "heading": 0.0, "collisions": 0} == records[0]["truth"]
    assert [None] * (len(records) - 1) == [record["outcome"] for record in records[:-1]]
    assert records[-1]["outcome"] in ("reached", "gave up")
    assert 6.0 >= records[-1]["stamp"]
    assert (folder / FIGURE).read_bytes().startswith(b"\x89PNG")
    with Image.open(folder / ANIMATION) as picture:
        assert 1 < picture.n_frames
    assert "no door leads into 'shed'" in progress[0]
    assert progress[1].startswith("0:00   ")
    assert f"See {folder}." == progress[-1]
    assert outcome.out.startswith("After ")
    assert 1 == outcome.out.count("\n")


@pytest.mark.parametrize("severity", ["0", "0.5"])
def test_without_a_world_the_robot_drives_in_a_building_made_of_the_drawing(pilotage, site, severity):
    drawing, _, folder, settings = site
    words = ("--goal", "kitchen", "--start", "25,25,0", "--severity", severity, "--no-animation")
    outcome = pilotage("navigate", drawing, *words, "--settings", settings, "-o", folder)
    last = json.loads((folder / JOURNAL).read_text().splitlines()[-1])

    assert 0 == outcome.code
    assert "reached" == last["outcome"]


def test_a_severity_is_of_a_building_made_of_the_drawing(call):
    outcome = call("--goal", "kitchen", "--severity", "0.2")

    assert 2 == outcome.code
    assert "is of no use with --world" in outcome.err


def test_a_true_start_needs_a_world(pilotage, site):
    outcome = pilotage("navigate", site[0], "--goal", "kitchen", *SOUTH_WEST)

    assert 2 == outcome.code
    assert "is of no use without --world" in outcome.err


def test_without_a_folder_only_the_end_is_told(pilotage, site, tmp_path):
    drawing, world, folder, settings = site
    before = sorted(tmp_path.iterdir())
    outcome = pilotage(
        "navigate", drawing, "--world", world, "--settings", settings, "--goal", "75,35", "--time-limit", 1
    )

    assert 0 == outcome.code
    assert "the robot gave up: the goal was not reached within 1 s" in outcome.out
    assert before == sorted(tmp_path.iterdir())
    assert not folder.exists()


def test_start_and_goal_are_taken_from_the_drawing(call, site, tmp_path):
    marked = svg(tmp_path / "marked.svg", WALLS + WORDS + MARKS)
    outcome = call("--time-limit", "0.3", "--no-animation", *SOUTH_WEST, drawing=marked)
    first = json.loads((site[2] / JOURNAL).read_text().splitlines()[0])

    assert 0 == outcome.code
    assert not (site[2] / ANIMATION).exists()
    assert 20.0 > abs(first["x"] - 25.0)


@pytest.mark.parametrize(
    ("words", "rule"),
    [
        (("--goal", "500,10"), "goal lies outside the drawing"),
        (("--goal", "kitchen,"), "needs a name or two numbers"),
        (("--goal", "kitchen", "--scale", "1e-9"), "units per metre"),
        (("--goal", "160,25"), "goal lies in a wall or in a place that is not free"),
        (("--goal", "office"), "stands in 2 cells"),
        (("--goal", "ballroom"), "stands in no cell, labels in cells are: kitchen, office, shed"),
        (("--goal", "shed"), "no gateways lead from the largest part"),
        (("--goal", "shed", "--start", "25,25,0"), "no gateways join them"),
        (("--goal", "kitchen", "--start", "-80,25,0"), "start lies outside the drawing"),
        (("--goal", "kitchen", "--from", "5,-0.5,0"), "in or at a wall: "),
        (("--goal", "kitchen", "--world", "nowhere.yaml"), ": nowhere.yaml"),
        (("--goal", "kitchen", "--settings", "nowhere.toml"), "there is no such file: nowhere.toml"),
    ],
)
def test_what_cannot_be_driven_is_one_line_before_anything_moves(call, site, words, rule):
    outcome = call(*words)

    assert 1 == outcome.code
    assert "" == outcome.out
    assert outcome.err.startswith("pilotage: error: ")
    assert rule in outcome.err
    assert 1 == outcome.err.count("\n")
    assert not site[2].exists()


def test_a_drawing_without_a_closed_room_is_refused_with_its_name(call, tmp_path):
    lines = svg(tmp_path / "lines.svg", '<path d="M0 0H100M0 40H100"/>')
    outcome = call("--goal", "10,10", drawing=lines)

    assert 1 == outcome.code
    assert "has no closed room" in outcome.err
    assert "lines.svg" in outcome.err


def test_a_world_that_may_be_drawn_in_pixels_is_worth_a_remark(call, site):
    outcome = call("--goal", "ballroom", "--world", svg(site[1], WALLS, 5.0))

    assert "world.svg: this world is 1031 m across; a world is drawn in metres" in outcome.err


@pytest.mark.parametrize(
    ("walls", "rule"),
    [
        ('<path d="M0 0H10"/>', "found none"),
        ('<rect width="9000" height="12000"/>', "at most 2000 m across, this one would be 15000 m"),
        ('<rect width="0.35" height="9"/>', "free space that walls enclose"),
    ],
)
def test_a_world_without_free_space_is_refused_with_its_name(call, tmp_path, walls, rule):
    wall = svg(tmp_path / "wall.svg", walls)
    outcome = call("--goal", "kitchen", "--world", wall)

    assert 1 == outcome.code
    assert rule in outcome.err
    assert "wall.svg" in outcome.err


def test_a_folder_with_other_things_in_it_is_left_alone(call, site):
    folder = site[2]
    folder.mkdir()
    (folder / JOURNAL).write_text("precious")
    outcome = call("--goal", "kitchen")

    assert 1 == outcome.code
    assert "--force writes into it" in outcome.err
    assert "precious" == (folder / JOURNAL).read_text()


def test_a_folder_with_nothing_but_what_a_killed_run_left_is_used(call, site):
    folder = site[2]
    folder.mkdir()
    (folder / f".{JOURNAL}.abcd1234.unfinished").write_text("{}")
    outcome = call("--goal", "kitchen", "--no-animation", "--time-limit", "0.1")

    assert 0 == outcome.code


def test_force_replaces_the_files_of_a_drive_and_no_other(call, site):
    folder = site[2]
    folder.mkdir()
    (folder / JOURNAL).write_text("old")
    (folder / "notes.txt").write_text("precious")
    outcome = call("--goal", "kitchen", "--force", "--no-animation", "--time-limit", "0.1")

    assert 0 == outcome.code
    assert (folder / JOURNAL).read_text().startswith("{")
    assert "precious" == (folder / "notes.txt").read_text()


@pytest.mark.parametrize("is_empty", [True, False])
def test_an_empty_folder_will_do_and_a_file_will_not(call, site, is_empty):
    folder = site[2]
    folder.mkdir() if is_empty else folder.write_text("precious")
    outcome = call("--goal", "kitchen", "--no-animation", "--time-limit", "0.1")

    assert (0 if is_empty else 1) == outcome.code
    assert is_empty or "the folder cannot be made" in outcome.err


@pytest.mark.parametrize(
    "words",
    [
        (),
        ("--goal", "kitchen", "--start", "1,2"),
        ("--goal", "kitchen", "--from", "here"),
        ("--goal", "kitchen", "--from", "1,2,nan"),
        ("--goal", "kitchen", "--time-limit", "0"),
        ("--goal", "kitchen", "--time-limit", "nan"),
        ("--goal", "kitchen", "--scale", "-1"),
        ("--goal", "kitchen", "--seed", "-1"),
    ],
)
def test_a_wrong_call_is_exit_code_2(call, site, words):
    outcome = call(*words)

    assert 2 == outcome.code
    assert (words[-2] if words else "--goal") in outcome.err
    assert not site[2].exists()


def test_several_goals_are_driven_to_in_order_and_each_is_told(call, site):
    words = ("--goal", "kitchen,25,25", "--rounds", "2", "--time-limit", "2", "--no-animation")
    outcome = call(*words, "--start", "25,25,0", *SOUTH_WEST, "--scale", "10")
    last = json.loads((site[2] / JOURNAL).read_text().splitlines()[-1])

    assert 0 == outcome.code
    assert ["kitchen", [25.0, 25.0]] * 2 == [one["goal"] for one in last["goals"]]
    assert "of 4 goals are reached" in outcome.out
    assert outcome.out.count("kitchen: the goal was not reached within 2 s") == 2


@pytest.mark.parametrize("words", ["0.8", "0.4x0.6", "axb", "0.8xnan", "infx0.2", "0.8x0"])
def test_a_footprint_that_is_none_is_refused(call, words):
    outcome = call("--goal", "kitchen", "--footprint", words)

    assert 2 == outcome.code
    assert "LENGTHxWIDTH" in outcome.err


def test_a_corrected_drawing_needs_a_folder(pilotage, site):
    drawing, world, _, _ = site

    outcome = pilotage("navigate", drawing, "--world", world, "--corrected")

    assert 2 == outcome.code
    assert "a corrected drawing needs a folder" in " ".join(outcome.err.split())
