import json
import subprocess
import sys

import pytest
import typer
from typer.testing import CliRunner

from pilotage import worlds
from pilotage.cli.cells import cells
from pilotage.errors import FileError, PilotageError

SVG = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 150 50">
<g fill="none" stroke="black">
<polyline points="0,0 150,0 150,50 0,50 0,0"/>
<polyline points="50,0 50,20"/><polyline points="50,30 50,50"/>
<polyline points="100,0 100,20"/><polyline points="100,30 100,50"/>
</g>
<text x="20" y="20" font-size="5">office</text>
<text x="70" y="20" font-size="5">kitchen</text>
<text x="120" y="20" font-size="5">office</text>
</svg>"""


@pytest.fixture
def drawing(tmp_path):
    path = tmp_path / "suite.svg"
    path.write_text(SVG)
    return path


def call(*words):
    app = typer.Typer()
    app.command()(cells)
    outcome = CliRunner().invoke(app, [str(word) for word in words])
    if isinstance(outcome.exception, PilotageError):
        raise outcome.exception
    return outcome


def test_cells_are_listed_with_their_neighbors(drawing):
    lines = call(drawing).stdout.splitlines()

    assert "3 cells, 2 gateways" == lines[0]
    assert "'kitchen', medium, next to" in " ".join(lines)


def test_a_route_is_told_step_by_step(drawing):
    outcome = call(drawing, "--start", "10,10", "--goal", "kitchen")

    assert 0 == outcome.exit_code
    assert "'office', through g" in outcome.stdout
    assert "cost 0." in outcome.stdout


def test_figure_and_geojson_are_written(drawing, tmp_path):
    figure, output = tmp_path / "cells.png", tmp_path / "cells.geojson"
    call(drawing, "--figure", figure, "-o", output)

    assert figure.read_bytes().startswith(b"\x89PNG")
    assert 5 == len(json.loads(output.read_text())["features"])


def test_files_that_are_there_are_not_replaced(drawing, tmp_path):
    output = tmp_path / "cells.geojson"
    output.write_text("mine")

    with pytest.raises(PilotageError, match="already there"):
        call(drawing, "-o", output)
    assert 0 == call(drawing, "-o", output, "--force").exit_code


@pytest.mark.parametrize(
    ("goal", "rule"),
    [
        ("500,10", "goal lies outside the drawing"),
        ("office", "stands in 2 cells"),
        ("ballroom", "stands in no cell, labels in cells are: kitchen, office"),
    ],
)
def test_a_goal_that_cannot_be_gone_to_is_refused(drawing, goal, rule):
    with pytest.raises(PilotageError, match=rule):
        call(drawing, "--start", "10,10", "--goal", goal)


def test_a_route_needs_both_ends(drawing):
    outcome = call(drawing, "--goal", "kitchen")

    assert 2 == outcome.exit_code
    assert "needs a start" in " ".join(outcome.stderr.replace("│", " ").split())


def test_a_drawing_without_a_room_is_refused_with_its_name(tmp_path):
    path = tmp_path / "lines.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H100M0 60H100" stroke="black"/></svg>'
    )

    with pytest.raises(PilotageError, match=r"no closed room: .*lines\.svg"):
        call(path)


def test_only_pictures_have_a_shading(drawing):
    assert 2 == call(drawing, "--shading", "dim").exit_code
    with pytest.raises(FileError, match="only pictures have a shading"):
        call(drawing, "--shading", "lines")


def test_the_command_starts_without_the_compiler(drawing):
    code = (
        "import sys, typer; from pilotage.cli.cells import cells; app = typer.Typer(); app.command()(cells); "
        "app([sys.argv[1]], standalone_mode=False); assert 'numba' not in sys.modules"
    )
    outcome = subprocess.run([sys.executable, "-c", code, str(drawing)], capture_output=True, check=False)  # noqa: S603

    assert b"" == outcome.stderr
    assert 0 == outcome.returncode


def test_a_point_beyond_all_drawings_is_refused_in_one_line(pilotage):
    outcome = pilotage("cells", worlds.OFFICE.quick, "--start", "1e308,0", "--goal", "5,5")

    assert 1 == outcome.code
    assert 1 == outcome.err.count("\n")
    assert "1e308,0" in outcome.err
