"""Run all with default options, many at a time; those that tell times run alone, at the end.

    python -m benchmarks all

Each benchmark is a task, in processes of this machine or on workers of a Dask scheduler. What is measured is
kept as it comes. A task whose process is killed is tried again. A benchmark that fails stops no other.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.__main__ import NAMES, accepts_jobs
from benchmarks.lib import results
from benchmarks.lib.arguments import positive
from benchmarks.lib.data import ROOT
from pilotage.errors import PilotageError
from pilotage.workers import Cluster, Processes, Workers

ALONE = ("which", "registration", "plans", "logs", "ros", "shape", "simulation", "soak", "table")
"""Benchmarks that tell times by the clock, or use all of the machine."""
SECOND = ("calibration", "kidnap", "mismatch")
"""Benchmarks that score the traces that `localization` leaves behind."""
FIRST = tuple(name for name in NAMES if name not in (*ALONE, *SECOND))


@dataclass(frozen=True, slots=True)
class Answer:
    """What came of a benchmark."""

    text: str  # that it printed
    seconds: float
    measurement: results.Measurement | None  # None if it failed, or has no figures
    failure: str = ""


def main(words: Sequence[str]) -> None:
    """Run all, and tell at the end which of them failed."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks all",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--jobs", type=positive, default=2, help="processes (default: %(default)s)")
    where.add_argument("--scheduler", metavar="ADDRESS", help="a scheduler of Dask, whose workers to use")
    arguments = parser.parse_args(words)
    try:
        with Cluster(arguments.scheduler) if arguments.scheduler else Processes(arguments.jobs) as workers:
            failed = [
                *carry_out(FIRST, measure_beside_others, workers),
                *carry_out(SECOND, measure_beside_others, workers),
            ]
        with Processes(1) as workers:
            failed += carry_out(ALONE, measure_alone, workers)
    except PilotageError as error:
        sys.exit(f"benchmarks: {error}")
    except KeyboardInterrupt:
        sys.exit("benchmarks: interrupted")
    if failed:
        sys.exit(f"benchmarks: failed: {', '.join(failed)}")


def carry_out(
    names: Sequence[str],
    measure: Callable[[str], Answer],
    workers: Workers,
    save: Callable[[results.Measurement], Path] = results.save,
) -> list[str]:
    """Run benchmarks, keep what they measure as it comes, and return the names of those that failed."""
    failed = []
    for done, (name, answer) in enumerate(workers.run(measure, names), start=1):
        head = f"\n== {name} ({done} of {len(names)}"
        if isinstance(answer, PilotageError):
            failed.append(name)
            print(f"{head}) failed: {answer}", flush=True)
            continue
        print(f"{head}, {answer.seconds:.0f} s)\n{answer.text}", end="", flush=True)
        if answer.failure:
            failed.append(name)
            print(f"{name} failed: {answer.failure}", flush=True)
        elif answer.measurement:
            print(f"kept in {save(answer.measurement)}", flush=True)
    return failed


def measure_alone(name: str) -> Answer:
    """Run a benchmark with its defaults, in a process of its own that ends with this one."""
    return answer_of(name, [])


def measure_beside_others(name: str) -> Answer:
    """Run a benchmark in one process: others have the other cores."""
    return answer_of(name, ["--jobs", "1"] if accepts_jobs(name) else [])


def answer_of(name: str, words: Sequence[str]) -> Answer:
    """Run a benchmark with options that leave its figures as they are."""
    with tempfile.TemporaryDirectory() as folder:
        path, began = Path(folder) / "figures.json", time.monotonic()
        command = [sys.executable, "-m", "benchmarks.lib.tied", name, *words]
        with subprocess.Popen(  # noqa: S603  # our own words
            [*command, "--no-save", "--json", str(path)],
            cwd=ROOT,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        ) as process:
            assert process.stdout is not None
            text = process.stdout.read()
            code = process.wait()
        seconds = time.monotonic() - began
        if code:
            last = (text.splitlines() or [""])[-1]
            return Answer(text, seconds, None, f"{last} (exit code {code})")
        figures = json.loads(path.read_text(encoding="utf-8"))
        return Answer(text, seconds, results.measured(name, [], figures) if figures else None)
