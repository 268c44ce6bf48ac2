import json
import sys
from importlib import import_module
from types import SimpleNamespace

import pytest
from benchmarks.__main__ import NAMES, is_default, main, overview, parser_of, run
from benchmarks.lib import results
from benchmarks.lib.data import BUILDINGS, HANDS

from benchmarks import __main__ as program


def measure_nothing(arguments):
    print("a line")  # noqa: T201
    return {"episodes": arguments.episodes}


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """Keep results in a folder of the test, and measure nothing."""
    module = SimpleNamespace(
        __doc__="Measure nothing.",
        add_arguments=lambda parser: parser.add_argument("--episodes", type=int, default=3),
        measure=measure_nothing,
    )
    monkeypatch.setattr(program, "import_module", lambda _name: module)
    monkeypatch.setattr(program, "WITHOUT_DATA", ("nothing",))
    save = results.save
    monkeypatch.setattr(results, "save", lambda measurement: save(measurement, tmp_path))
    return tmp_path / "nothing.json"


def test_all_benchmarks_are_listed_with_a_sentence():
    text = overview()

    for name in NAMES:
        assert any(line.startswith(f"  {name} ") and line.endswith(".") for line in text.splitlines())


@pytest.mark.parametrize("name", NAMES)
def test_every_benchmark_explains_itself_and_starts_with_its_defaults(name):
    module = import_module(f"benchmarks.{name}")
    parser = parser_of(module, name)

    assert f"python -m benchmarks {name}" in parser.format_help()
    assert is_default(parser, parser.parse_args(["--no-save"]))
    assert callable(module.measure)


def test_names_of_buildings_and_hands_are_checked(capsys):
    parser = parser_of(import_module("benchmarks.localization"), "localization")

    for words, known in ((["--buildings", "aces,nowhere"], BUILDINGS), (["--hands", "nobody"], HANDS)):
        with pytest.raises(SystemExit):
            parser.parse_args(words)
        assert f"must be of {', '.join(known)}" in capsys.readouterr().err


def test_a_run_with_defaults_is_kept(kept):
    run("nothing", [])

    assert {"episodes": 3} == json.loads(kept.read_text())["figures"]


@pytest.mark.parametrize("words", [["--episodes", "1"], ["--no-save"]])
def test_other_runs_are_not_kept(kept, words):
    run("nothing", words)

    assert not kept.exists()


def test_other_runs_are_kept_if_asked_for(kept):
    run("nothing", ["--episodes", "1", "--save"])

    assert "python -m benchmarks nothing --episodes 1" == json.loads(kept.read_text())["command"]


def test_json_goes_to_standard_output_alone(kept, capsys):
    run("nothing", ["--json", "--no-save"])

    captured = capsys.readouterr()
    assert {"episodes": 3} == json.loads(captured.out)
    assert "a line" in captured.err
    assert not kept.exists()


def test_json_goes_to_a_file(kept, tmp_path):
    run("nothing", ["--json", str(tmp_path / "figures.json"), "--no-save"])

    assert {"episodes": 3} == json.loads((tmp_path / "figures.json").read_text())
    assert not kept.exists()


def test_an_unknown_benchmark_is_named(monkeypatch):
    monkeypatch.setattr(sys, "argv", ["benchmarks", "nonsense"])

    with pytest.raises(SystemExit, match="there is no benchmark nonsense"):
        main()
