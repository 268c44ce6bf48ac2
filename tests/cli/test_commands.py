"""What a user types, and what comes back."""

import subprocess
import sys

import pytest

from pilotage import worlds

COMMANDS = (
    "cells",
    "check",
    "demo",
    "localize",
    "navigate",
    "perceive",
    "record",
    "ros2",
    "settings",
    "simplify",
    "table",
    "which",
)


@pytest.mark.parametrize("command", COMMANDS)
def test_help_teaches_with_an_example(pilotage, command):
    outcome = pilotage(command, "--help")

    assert 0 == outcome.code
    assert "Example" in outcome.out
    assert f"pilotage {command}" in outcome.out


def test_help_lists_the_commands(pilotage):
    outcome = pilotage("--help")

    assert all(command in outcome.out for command in COMMANDS)


def test_version_is_told(pilotage):
    assert pilotage("--version").out.startswith("pilotage ")


def test_the_package_can_be_run_as_a_module():
    words = [sys.executable, "-m", "pilotage", "--version"]
    outcome = subprocess.run(words, capture_output=True, check=False)  # noqa: S603

    assert outcome.stdout.startswith(b"pilotage ")


@pytest.mark.parametrize(
    "words",
    [
        ("fly",),
        ("localize",),
        ("localize", "a.svg"),
        ("perceive", "run.log", "--scan", "-1"),
        ("demo", "--seed", "x"),
    ],
)
def test_a_wrong_call_is_exit_code_2(pilotage, words):
    outcome = pilotage(*words)

    assert 2 == outcome.code
    assert "" == outcome.out
    assert "Traceback" not in outcome.err


def test_light_commands_load_nothing_heavy():
    """All in one process: what a command loads stays, so the first one that is not light is named."""
    commands = (
        ("--help",),
        ("--version",),
        ("localize", "--help"),
        ("navigate", "--help"),
        ("demo", "--help"),
        ("simplify", str(worlds.OFFICE.quick)),
    )
    code = (
        "import sys\n"
        "from pilotage.cli import main\n"
        f"for words in {commands!r}:\n"
        "    sys.argv = ['pilotage', *words]\n"
        "    try: main()\n"
        "    except SystemExit: pass\n"
        "    heavy = [name for name in ('numba', 'matplotlib', 'scipy') if name in sys.modules]\n"
        "    print('HEAVY', words[0], heavy)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)  # noqa: S603
    told = [line for line in done.stdout.splitlines() if line.startswith("HEAVY")]

    assert [f"HEAVY {words[0]} []" for words in commands] == told


def test_importing_the_package_loads_no_library():
    heavy = ("numba", "numpy", "shapely", "typer")
    code = f"import sys, pilotage\nprint([name for name in {heavy} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)  # noqa: S603

    assert "[]" == done.stdout.strip()


def test_perceive_lists_the_shapes_of_a_scan_and_draws_them(pilotage, tmp_path):
    figure = tmp_path / "scan.png"
    outcome = pilotage("perceive", worlds.LOG, "--scan", 110, "--figure", figure)
    lines = outcome.out.splitlines()

    assert 0 == outcome.code
    assert lines[0].startswith("scan 110 of 292 at ")
    assert f"{len(lines) - 1} shapes" in lines[0]
    assert figure.read_bytes().startswith(b"\x89PNG")


def test_simplify_counts_vertices_and_draws_both(pilotage, tmp_path):
    outcome = pilotage("simplify", worlds.OFFICE.quick, "--figure", tmp_path / "evolution.svg")
    words = outcome.out.split()

    assert 0 == outcome.code
    assert int(words[-1]) < int(words[2])
    assert b"<svg" in (tmp_path / "evolution.svg").read_bytes()


@pytest.mark.parametrize(
    ("words", "rule"),
    [
        (("perceive", "nowhere.log"), "there is no such file"),
        (("simplify", "nowhere.svg"), "there is no such file"),
        (("perceive", worlds.OFFICE.quick), "no laser log"),
        (("simplify", worlds.LOG), "of this kind cannot be read"),
        (("perceive", worlds.LOG, "--scan", "9999"), "scans 0 to 291"),
        (("localize", worlds.LOG, worlds.OFFICE.quick), "of this kind cannot be read"),
        (("localize", worlds.OFFICE.quick, worlds.OFFICE.quick), "no laser log"),
        (("localize", worlds.OFFICE.quick, worlds.LOG, "--from", "500"), "none of them from 500"),
        (
            ("localize", worlds.OFFICE.quick, worlds.LOG, "--from", "5", "--to", "5"),
            "none of them from 5 to 5",
        ),
        (("simplify", worlds.OFFICE.quick, "--figure", "evolution.doc"), "must end in .png, .svg or .pdf"),
        (("check", worlds.OFFICE.quick, "--figure", "check.gif"), "must end in .png, .svg or .pdf"),
        (("check", "."), "a drawing is expected, found a folder"),
        (("localize", worlds.OFFICE.quick, worlds.LOG, "--to", "9", "--scale", "1e-9"), "units per metre"),
        (
            ("localize", worlds.OFFICE.quick, worlds.LOG, "--to", "9", "--start", "9e6,0,0"),
            "start lies outside",
        ),
    ],
)
def test_what_goes_wrong_is_one_line_and_exit_code_1(pilotage, tmp_path, monkeypatch, words, rule):
    monkeypatch.chdir(tmp_path)
    outcome = pilotage(*words)

    assert 1 == outcome.code
    assert outcome.err.startswith("pilotage: error: ")
    assert rule in outcome.err
    assert 1 == outcome.err.count("\n")


@pytest.mark.parametrize(
    "words",
    [
        ("--start", "1,2"),
        ("--start", "here"),
        ("--start", "1,2,nan"),
        ("--scale", "0"),
        ("--scale", "-3"),
        ("--scale", "nan"),
    ],
)
def test_an_impossible_start_or_scale_is_a_wrong_call(pilotage, words):
    outcome = pilotage("localize", worlds.OFFICE.quick, worlds.LOG, *words)

    assert 2 == outcome.code
    assert words[0] in outcome.err


def test_a_figure_that_cannot_be_drawn_is_refused_before_the_work(pilotage, tmp_path):
    estimates = tmp_path / "estimates.jsonl"
    outcome = pilotage(
        "localize",
        worlds.OFFICE.quick,
        worlds.LOG,
        "--to",
        "9",
        "-o",
        estimates,
        "--figure",
        tmp_path / "a.bmp",
    )

    assert 1 == outcome.code
    assert "must end in .png, .svg or .pdf" in outcome.err
    assert not estimates.exists()


def test_a_folder_that_cannot_be_written_to_is_told_before_the_work(pilotage, tmp_path, monkeypatch):
    estimates, file = tmp_path / "estimates.jsonl", tmp_path / "file"
    file.touch()
    words = ("localize", worlds.OFFICE.quick, worlds.LOG, "--to", "9", "-o", estimates, "--figure")
    below = pilotage(*words, file / "a.png")
    monkeypatch.setattr("os.access", lambda folder, _mode: folder.name != "locked")
    (tmp_path / "locked").mkdir()
    locked = pilotage(*words, tmp_path / "locked" / "new" / "a.png")

    assert (1, 1) == (below.code, locked.code)
    assert "file is no folder" in below.err
    assert "Permission denied" in locked.err
    assert not estimates.exists()


@pytest.mark.parametrize(
    "words",
    [
        ("perceive", worlds.LOG, "--figure"),
        ("simplify", worlds.OFFICE.quick, "--figure"),
        ("localize", worlds.OFFICE.quick, worlds.LOG, "--figure"),
        ("localize", worlds.OFFICE.quick, worlds.LOG, "-o"),
    ],
)
def test_no_file_is_replaced_unasked(pilotage, tmp_path, words):
    precious = tmp_path / "precious.png"
    precious.write_text("precious")
    outcome = pilotage(*words, precious)

    assert 1 == outcome.code
    assert "--force replaces it" in outcome.err
    assert "precious" == precious.read_text()


def test_force_replaces_a_file(pilotage, tmp_path):
    old = tmp_path / "old.png"
    old.write_text("old")

    assert 0 == pilotage("perceive", worlds.LOG, "--figure", old, "--force").code
    assert old.read_bytes().startswith(b"\x89PNG")


def test_settings_that_are_printed_can_be_read_back(pilotage, tmp_path):
    first = pilotage("settings")
    (tmp_path / "mine.toml").write_text(first.out)
    again = pilotage("settings", tmp_path / "mine.toml")

    assert 0 == first.code
    assert "[localizer" in first.out
    assert first.out == again.out


def test_a_setting_that_is_not_known_is_refused_by_name(pilotage, tmp_path):
    (tmp_path / "mine.toml").write_text("[localizer.scan_matching.perception]\nmin_relevence = 1.0\n")
    outcome = pilotage("localize", worlds.OFFICE.quick, worlds.LOG, "--settings", tmp_path / "mine.toml")

    assert 1 == outcome.code
    assert "localizer.scan_matching.perception.min_relevence, the nearest known one is" in outcome.err


@pytest.mark.parametrize(
    ("words", "content"),
    [
        (
            ("perceive", worlds.LOG, "--scan", "110"),
            "[localizer.scan_matching.perception]\nmin_relevance = 5.0",
        ),
        (("simplify", worlds.OFFICE.quick), "[localizer.atlas]\ndetail = 0.2"),
        (("cells", worlds.OFFICE.quick), "[localizer.atlas.decomposition]\nmin_cell_area = 0.2"),
        (
            ("cells", worlds.OFFICE.quick, "--start", "kitchen", "--goal", "office"),
            "[navigator.route]\ngateway = 0.5",
        ),
    ],
)
def test_settings_change_what_a_command_does(pilotage, tmp_path, words, content):
    (tmp_path / "mine.toml").write_text(content)
    (tmp_path / "same.toml").write_text("")
    plain, same, changed = (
        pilotage(*words, *options)
        for options in (
            (),
            ("--settings", tmp_path / "same.toml"),
            ("--settings", tmp_path / "mine.toml"),
        )
    )

    assert plain == same
    assert 0 == changed.code
    assert changed.out != plain.out


@pytest.mark.parametrize("command", [name for name in COMMANDS if name not in {"settings", "table", "which"}])
def test_commands_that_have_settings_read_them_from_a_file(pilotage, command):
    assert "--settings" in pilotage(command, "--help").out
