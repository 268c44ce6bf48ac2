import json
import subprocess

import pytest
from benchmarks.lib import results
from benchmarks.lib.results import Measurement, commit_of, load, means_of_groups, save


def measurement(name="cells", commit="abc", date="2026-01-01"):
    machine = {"cpu": "some", "cores": 2, "python": "3.11"}
    return Measurement(name, f"python -m benchmarks {name}", commit, date, machine, {"a": 1.0})


def test_a_measurement_is_read_as_it_was_saved(tmp_path):
    save(measurement(), tmp_path)

    assert measurement() == load("cells", tmp_path)
    assert load("mpeg7", tmp_path) is None


@pytest.fixture
def repository(tmp_path):
    def git(*words):
        subprocess.run(  # noqa: S603  # fixed words
            ["git", "-c", "user.name=a", "-c", "user.email=a@b.c", *words],  # noqa: S607
            cwd=tmp_path,
            check=True,
        )

    git("init", "-q")
    (tmp_path / "code.py").write_text("1")
    git("add", "-A")
    git("commit", "-qm", "begin")
    return tmp_path


def test_changes_of_the_code_mark_the_commit_and_results_do_not(repository):
    clean = commit_of(repository)
    (repository / "benchmarks" / "results").mkdir(parents=True)
    (repository / "benchmarks" / "results" / "cells.json").write_text("{}")
    with_results = commit_of(repository)
    (repository / "code.py").write_text("2")

    assert clean == with_results
    assert f"{clean}+" == commit_of(repository)


def test_where_git_is_not_used_the_commit_is_unknown(tmp_path):
    assert "unknown" == commit_of(tmp_path)


def test_a_measurement_tells_of_what_and_where(monkeypatch):
    monkeypatch.setattr(results, "commit_of", lambda _folder: "abc+")

    made = results.measured("cells", ["--seed", "1"], {"a": 1.0})

    assert "python -m benchmarks cells --seed 1" == made.command
    assert "abc+" == made.commit
    assert {"cpu", "cores", "python"} == set(made.machine)
    json.dumps(made.machine)


def test_held_out_buildings_are_averaged_apart_and_those_that_a_hand_did_not_draw_left_out():
    rows = {"csail": {"quick": {"a": 1.0}}, "fhw": {"quick": {"a": 2.0}, "plan": {"a": 5.0}}}
    means = means_of_groups(rows, ["csail", "fhw", "aces"], ["quick", "plan"])

    assert {"quick": {"a": 1.5}, "plan": {"a": 5.0}} == means["mean"]
    assert {"quick": {"a": 1.0}} == means["tuned"]
    assert {"quick": {"a": 2.0}, "plan": {"a": 5.0}} == means["held_out"]
