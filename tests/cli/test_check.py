"""The command `check`, and the options that all commands have for a drawing."""

import json
import re

import pytest

GOOD = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 150 50">
<g fill="none" stroke="black">
<polyline points="0,0 150,0 150,50 0,50 0,0"/>
<polyline points="50,0 50,20"/><polyline points="50,30 50,50"/>
<g id="A-ODD">{odd}</g>
</g>
<text x="20" y="20" font-size="5">office</text>
{more}
</svg>"""
DIVIDED = '<polyline points="100,0 100,50"/>'


@pytest.fixture
def drawing(tmp_path):
    def write(odd="", more=""):
        path = tmp_path / "suite.svg"
        path.write_text(GOOD.format(odd=odd, more=more))
        return path

    return write


def test_a_good_drawing_is_told_in_words(pilotage, drawing):
    outcome = pilotage("check", drawing(more='<text x="120" y="20" font-size="5">lab</text>'))

    assert 0 == outcome.code
    assert "2 rooms (2 with a name), 1 door" in outcome.out
    assert "office 'office': lab" in outcome.out
    assert outcome.out.endswith("nothing looks wrong\n")


def test_a_room_without_a_door_is_a_warning_with_its_place(pilotage, drawing):
    outcome = pilotage("check", drawing(DIVIDED, '<text x="120" y="20" font-size="5">lab</text>'), "--json")
    content = json.loads(outcome.out)
    (found,) = (one for one in content["findings"] if one["severity"] == "warning")

    assert 0 == outcome.code
    assert "'lab'" in found["text"]
    assert 100 <= found["where"][0] <= 150
    assert "cut" == found["mend"]["kind"]
    assert 2 == len(found["mend"]["segment"])
    assert {"file", "cells", "gateways", "marks", "assumed", "findings"} == set(content)


def test_the_names_under_which_walls_are_drawn_are_listed(pilotage, drawing):
    shelf = '<path d="M10,0 V10 H20 V0"/><path d="M30,0 V10 H40 V0"/>'
    told = pilotage("check", drawing(shelf)).out
    without = pilotage("check", drawing(shelf), "--layer", "A-ODD=furniture").out

    assert "walls by name, for --layer: 'A-ODD' (2)" in told
    assert "walls by name" not in without


def test_names_that_are_as_frequent_are_listed_in_the_order_of_the_drawing(pilotage, drawing):
    names = [f"layer {letter}" for letter in "CADBFE"]
    groups = "".join(f'<g id="{name}">' for name in names)
    shelf = f'{groups}<path d="M10,0 V10 H20 V0"/><path d="M30,0 V10 H40 V0"/>{"</g>" * len(names)}'
    told = pilotage("check", drawing(shelf)).out

    assert names == re.findall("layer [A-F]", told[told.index("walls by name") :])


def test_a_goal_that_cannot_be_used_fails(pilotage, drawing):
    assert 1 == pilotage("check", drawing(), "--goal", "900,900").code
    assert 0 == pilotage("check", drawing(), "--goal", "120,20").code


@pytest.mark.parametrize(
    ("option", "words", "told"),
    [
        ("--goal", "nowhere", "error: the label 'nowhere' stands in no cell, labels in cells are: office;"),
        (
            "--start",
            "office",
            "error: the label 'office' stands in 2 cells (office, office-2), name the place",
        ),
        ("--goal", "", "error: a place needs a name or two numbers X,Y, got nothing;"),
    ],
)
def test_an_end_that_no_one_room_is_called_is_a_finding_of_the_report(pilotage, drawing, option, words, told):
    twice = '<text x="120" y="20" font-size="5">office</text>'
    outcome = pilotage("check", drawing(more=twice), option, words)
    content = json.loads(pilotage("check", drawing(more=twice), option, words, "--json").out)

    assert 1 == outcome.code
    assert told in outcome.out
    assert "2 rooms (2 with a name), 1 door" in outcome.out
    assert f"bad-{option[2:]}" == content["findings"][0]["kind"]
    assert content["findings"][0]["where"] is None


def test_a_marked_goal_that_cannot_be_used_fails(pilotage, drawing):
    outcome = pilotage("check", drawing(more='<circle id="goal" cx="300" cy="20" r="2"/>'))

    assert 1 == outcome.code
    assert "1  error at 300,20: the goal lies outside the drawing" in outcome.out


def test_a_drawing_without_rooms_fails_and_is_drawn_all_the_same(pilotage, tmp_path):
    path, figure = tmp_path / "open.svg", tmp_path / "open.png"
    path.write_text('<svg><path d="M0 0 L100 0 L100 50" stroke="black" fill="none"/></svg>')
    outcome = pilotage("check", path, "--figure", figure)

    assert 1 == outcome.code
    assert "encloses none" in outcome.out
    assert figure.read_bytes().startswith(b"\x89PNG")


def test_findings_are_numbered_as_in_the_picture_and_all_of_a_kind_are_listed_if_wanted(pilotage, drawing):
    path = drawing("".join(f'<polyline points="{x},0 {x},50"/>' for x in (80, 90, 100, 115, 130)))
    told, every = (pilotage("check", path, *option).out.splitlines() for option in ((), ("--all",)))
    found = json.loads(pilotage("check", path, "--json").out)["findings"]
    closed = [number for number, one in enumerate(found, 1) if one["kind"] == "room-without-door"]

    assert 5 == len(closed)
    assert "note: 2 more of this kind (room-without-door), listed by --all" in told
    for number, one in enumerate(found, 1):
        assert (number in closed[3:]) is not any(line.startswith(f"{number}  ") for line in told)
        assert [one["text"] in line for line in every if line.startswith(f"{number}  ")] == [True]
    assert not [line for line in every if "more of this kind" in line]


def test_cells_says_the_worst_in_one_line(pilotage, drawing):
    outcome = pilotage("cells", drawing(DIVIDED, '<text x="120" y="20" font-size="5">lab</text>'))

    assert 1 == len(outcome.err.splitlines())
    assert "'lab'" in outcome.err
    assert "`pilotage check suite.svg`" in outcome.err


def test_a_layer_can_be_left_out_and_rooms_named(pilotage, drawing):
    path = drawing(DIVIDED)
    outcome = pilotage("check", path, "--layer", "A-ODD=ignore", "--label", "lab=120,20", "--json")
    content = json.loads(outcome.out)

    assert {"office", "lab"} == {cell["id"] for cell in content["cells"]}
    assert 1 == content["marks"]["ignore"]


def test_a_name_that_is_told_replaces_the_written_one(pilotage, drawing):
    path = drawing(more='<text x="120" y="20" font-size="5">office</text>')
    outcome = pilotage("cells", path, "--label", "lab=110,30", "--start", "office", "--goal", "lab")
    told = pilotage("check", path, "--label", "lab=110,30").out

    assert 0 == outcome.code
    assert "lab 'lab': office" in told
    assert told.endswith("nothing looks wrong\n")


def test_the_table_beside_a_drawing_is_read_and_told(pilotage, drawing):
    path = drawing(DIVIDED)
    path.with_name("suite.svg.toml").write_text('[layers]\nA-ODD = "ignore"\n[labels]\nlab = [120, 20]\n')
    outcome = pilotage("check", path)

    assert "lab 'lab': office" in outcome.out
    assert "suite.svg: hints are taken from suite.svg.toml" in outcome.err


def test_a_layer_that_is_nowhere_is_told(pilotage, drawing):
    assert "nothing in the drawing is named 'X'" in pilotage("check", drawing(), "--layer", "X=wall").err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--layer", "A-ODD"), "NAME=ROLE"),
        (("--layer", "A-ODD=sofa"), "must be one of wall, door"),
        (("--label", "lab"), "NAME=X,Y"),
        (("--label", "lab=1,nan"), "NAME=X,Y"),
        (("--shading", "dim"), "must be one of recognized"),
    ],
)
def test_an_option_that_makes_no_sense_is_refused(pilotage, drawing, words, told):
    outcome = pilotage("check", drawing(), *words)

    assert 2 == outcome.code
    assert told in " ".join(outcome.err.replace("│", " ").split())
