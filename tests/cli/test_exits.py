"""How a run ends: one line, an exit code, and nothing half-written."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from pilotage import worlds
from pilotage.cli.exits import Stopped
from pilotage.errors import PilotageError

FEW = """[localizer]
proposals = 500
[localizer.atlas.range_table]
cells = 80
[localizer.tracks]
first_count = 4000
max_count = 2000
min_count = 1000
"""
SCANS = ("localize", worlds.OFFICE.quick, worlds.LOG)


@pytest.fixture
def failing(pilotage, monkeypatch):
    """Call a command line that raises this error."""

    def call(error):
        def app():
            raise error

        monkeypatch.setattr("pilotage.cli.app.app", app)
        return pilotage("settings")

    return call


@pytest.mark.parametrize(
    ("error", "code", "line"),
    [
        (PilotageError("a rule\nbroken"), 1, "pilotage: error: a rule broken\n"),
        (OSError(28, "No space left"), 1, "pilotage: error: output cannot be written (No space left)\n"),
        (OSError(5, "Input/output error", "a.svg"), 1, "pilotage: error: Input/output error: a.svg\n"),
        (BrokenPipeError(), 1, ""),
        (KeyboardInterrupt(), 130, "pilotage: interrupted\n"),
        (Stopped(signal.SIGTERM), 143, "pilotage: interrupted\n"),
        (Stopped(signal.SIGHUP), 129, "pilotage: interrupted\n"),
    ],
)
def test_what_goes_wrong_is_one_line_and_an_exit_code(failing, error, code, line):
    outcome = failing(error)

    assert code == outcome.code
    assert line == outcome.err


def test_too_little_memory_is_said_in_one_line(failing):
    outcome = failing(MemoryError())

    assert 70 == outcome.code
    assert 1 == outcome.err.count("\n")
    assert outcome.err.startswith("pilotage: error: there is not enough memory for this input")


@pytest.mark.parametrize("error", [RecursionError("too deep"), OverflowError("too large"), IndexError("3")])
def test_a_mistake_of_ours_is_one_line_that_says_how_to_report_it(failing, error):
    outcome = failing(error)

    assert 70 == outcome.code
    assert 1 == outcome.err.count("\n")
    assert f"({type(error).__name__}: {error})" in outcome.err
    assert "PILOTAGE_TRACEBACK=1" in outcome.err


def test_the_traceback_is_printed_if_it_is_asked_for(failing, monkeypatch):
    monkeypatch.setenv("PILOTAGE_TRACEBACK", "1")
    outcome = failing(IndexError("3"))

    assert outcome.err.startswith("Traceback")
    assert outcome.err.splitlines()[-1].startswith("pilotage: error: ")


def shell(command, **environment):
    """Run `pilotage` in a shell that redirects its streams."""
    line = f'"{sys.executable}" -c "from pilotage.cli import main; main()" {command}'
    return subprocess.run(  # noqa: S602
        line, shell=True, capture_output=True, text=True, env={**os.environ, **environment}, check=False
    )


@pytest.mark.parametrize("words", ["--help", "localize --help"])
def test_help_is_readable_where_only_ascii_can_be_shown(words):
    done = shell(words, PYTHONIOENCODING="ascii")

    assert 0 == done.returncode
    assert "Usage" in done.stdout


@pytest.mark.parametrize(
    ("redirection", "code", "line"),
    [
        (">/dev/full", 1, "pilotage: error: output cannot be written (No space left on device)\n"),
        (">&-", 0, ""),
        ("2>&-", 0, ""),
        ("2>/dev/full", 0, ""),
        ("| true", 0, ""),
    ],
)
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
def test_a_stream_that_is_full_or_closed_is_no_reason_to_fall_over(redirection, code, line):
    done = shell(f"settings {redirection}")

    assert code == done.returncode
    assert line == done.stderr


def interrupted(number, *words):
    """Run `pilotage` and send it a signal once it has written something to its temporary file.

    Jobs in the background of a shell ignore Ctrl-C, and so do those that they start: ours must hear it.
    """
    folder = words[-1].parent
    heeding = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    command = [sys.executable, "-c", f"{heeding}; from pilotage.cli import main; main()", *map(str, words)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as run:  # noqa: S603
        deadline = time.monotonic() + 60.0
        while not any(path.stat().st_size for path in folder.glob(".*.unfinished*")):
            assert run.poll() is None, run.stderr.read()
            assert time.monotonic() < deadline
            time.sleep(0.02)
        run.send_signal(number)
        _, err = run.communicate()
    return run.returncode, err


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_localizing_that_is_interrupted_keeps_what_it_had(tmp_path, number):
    settings = tmp_path.with_suffix(".toml")
    settings.write_text(FEW)
    code, err = interrupted(number, *SCANS, "--settings", settings, "-o", tmp_path / "out.jsonl")
    partial = tmp_path / "out.partial.jsonl"

    assert 128 + number == code, err
    assert f"pilotage: interrupted; what was written so far is kept in {partial}\n" == err
    assert [partial] == list(tmp_path.iterdir())
    assert partial.read_text().startswith("{")
    assert partial.read_text().endswith("}\n")


def test_the_same_file_twice_is_refused(pilotage, tmp_path):
    twice = tmp_path / "q.png"
    outcome = pilotage(*SCANS, "-o", twice, "--figure", tmp_path / "." / "q.png")

    assert 1 == outcome.code
    assert "two outputs must not be the same file" in outcome.err
    assert not twice.exists()
