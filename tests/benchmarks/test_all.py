"""All benchmarks are measured, whatever becomes of some of them."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from benchmarks.__main__ import NAMES
from benchmarks.all import ALONE, FIRST, SECOND, Answer, answer_of, carry_out
from benchmarks.lib import results
from benchmarks.lib.data import ROOT

import worker_tasks
from benchmarks import all as program
from pilotage.workers import Processes
from shared_data import needs_logs


def test_every_benchmark_is_measured_once():
    assert sorted(NAMES) == sorted((*FIRST, *SECOND, *ALONE))


@pytest.mark.slow
def test_what_fails_stops_no_other_and_is_named(tmp_path, capsys):
    names = ["failing", "good", "deadly", "other"]
    with Processes(2) as workers:
        failed = carry_out(names, worker_tasks.measured, workers, lambda one: results.save(one, tmp_path))
    out = capsys.readouterr().out

    assert ["deadly", "failing"] == sorted(failed)
    assert ["good.json", "other.json"] == sorted(path.name for path in tmp_path.iterdir())
    assert {"name": "good"} == json.loads((tmp_path / "good.json").read_text())["figures"]
    assert "failing failed: it fell over" in out
    assert "== deadly (4 of 4) failed: the processes that tried it were killed" in out


@pytest.mark.parametrize(("broken", "code"), [("", None), ("shape", "benchmarks: failed: shape")])
def test_the_exit_code_tells_whether_one_failed(monkeypatch, broken, code):
    said = lambda name: Answer("", 0.0, None, "broken" if name == broken else "")  # noqa: E731
    monkeypatch.setattr(program, "Processes", lambda _count: Here())
    monkeypatch.setattr(program, "measure_beside_others", said)
    monkeypatch.setattr(program, "measure_alone", said)

    if code is None:
        program.main([])
    else:
        with pytest.raises(SystemExit, match=code):
            program.main([])


class Here:
    """A worker that is this process."""

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        pass

    def run(self, function, tasks):
        yield from ((task, function(task)) for task in tasks)


def test_a_scheduler_that_is_not_there_is_told_in_one_line(monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr("pilotage.workers.PATIENCE", "1s")

    with pytest.raises(SystemExit, match="benchmarks: there is no scheduler of Dask at tcp:"):
        program.main(["--scheduler", "tcp://127.0.0.1:1"])


def test_a_benchmark_that_cannot_start_says_why():
    answer = answer_of("nonsense", [])

    assert answer.measurement is None
    assert answer.failure.startswith("there is no benchmark nonsense")
    assert answer.failure.endswith("(exit code 1)")


@needs_logs
@pytest.mark.slow
def test_a_benchmark_gives_its_figures_and_what_it_printed():
    answer = answer_of("odometry", ["--logs", "freiburg-079"])

    assert "" == answer.failure
    assert answer.text
    assert "python -m benchmarks odometry" == answer.measurement.command
    assert answer.measurement.figures


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_a_benchmark_ends_with_who_started_it():
    command = [sys.executable, "-m", "benchmarks.lib.tied", "soak"]
    with subprocess.Popen(  # noqa: S603  # our own words
        command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, start_new_session=True
    ) as process:
        time.sleep(0.5)
        assert process.poll() is None
        process.stdin.close()
        assert -signal.SIGKILL == process.wait(10.0)
    with pytest.raises(ProcessLookupError):
        wait_for_end_of(process.pid)


def wait_for_end_of(group):
    """Wait until no process of a group is left."""
    deadline = time.monotonic() + 10.0
    while time.monotonic() < deadline:
        os.killpg(group, 0)
        time.sleep(0.05)
