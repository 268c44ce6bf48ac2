"""The command, as a person starts it."""

import re
import subprocess
import sys
import urllib.error
import urllib.request
from pathlib import Path

import pytest
from typer.testing import CliRunner

from pilotage.cli.app import app
from pilotage.errors import FileError
from pilotage.web.serve import Address, ServerError, serve

EXAMPLE = Path(__file__).parents[2] / "examples" / "03_drive_at_the_table.py"


@pytest.mark.slow
def test_the_example_drives_at_a_table_that_runs(address: str) -> None:
    found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\?token=(\S{20,})", address)
    assert found is not None
    with pytest.raises(urllib.error.HTTPError, match="401"):
        urllib.request.urlopen(f"http://127.0.0.1:{found[1]}/api/info")
    said = subprocess.run(  # noqa: S603  # our own example
        [sys.executable, EXAMPLE, found[2], found[1]],
        capture_output=True,
        text=True,
        timeout=200,
        check=False,
    )

    assert "" == said.stderr
    assert "packed:office" in said.stdout
    assert "reached" in said.stdout.splitlines()[-1]


def test_a_server_that_others_can_reach_needs_a_token(folder: Path) -> None:
    with pytest.raises(ServerError, match="needs --token with 16 letters"):
        serve(folder, Address("0.0.0.0", 0, "short"), browse=False, say=print)  # noqa: S104


def test_the_name_of_this_machine_is_no_server_for_others(folder: Path) -> None:
    with pytest.raises(ServerError, match="no port from 70000 on can be opened on localhost"):
        serve(folder, Address("localhost", 70000), browse=False, say=print)


def test_a_folder_must_exist(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="must exist"):
        serve(tmp_path / "none", Address(), browse=False, say=print)
    drawing = tmp_path / "office.svg"
    drawing.touch()
    with pytest.raises(FileError, match="a folder of drawings is expected, found a file"):
        serve(drawing, Address(), browse=False, say=print)


def test_without_the_extra_the_command_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pilotage.cli.table.find_spec", lambda _name: None)

    result = CliRunner().invoke(app, ["table"])

    assert "pip install 'pilotage[web]'" in str(result.exception)
