"""Choose among a hundred drawings the one of the building that a log was made in.

    python -m benchmarks which

Pieces of 40 m of the logs of six buildings are compared with drawings of all of them: by draftsmen, quick,
schematic, by people, and of the ladder. A drawing is right if it is of the log's building. One piece is
compared alone, which gives the seconds, the others together, which is faster. The shortest piece is compared
once more on two local workers of Dask, one of which is killed when a fifth of the drawings is done; with
`--only-kill` nothing else is measured.
"""

import argparse
import contextlib
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from benchmarks.lib.arguments import add_names, positive
from benchmarks.lib.data import BUILDINGS
from benchmarks.lib.lineup import line_up, write_pieces
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import percent, prose, table
from pilotage.evaluation.intervals import bootstrap_interval
from pilotage.ranking import Board, Score, rank
from pilotage.workers import Cluster, Processes

TRAVEL = 40.0  # [m]
FIRST_PLACES = 5
STARTED = 60.0  # [s] that a scheduler may take to start


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose how many drawings and logs."""
    add_names(parser, "--buildings", BUILDINGS)
    parser.add_argument("--pieces", type=positive, default=2, help="of each log (default: %(default)s)")
    parser.add_argument("--drawings", type=positive, default=100, help="(default: %(default)s)")
    parser.add_argument("--workers", type=positive, default=2, help="processes (default: %(default)s)")
    killing = parser.add_mutually_exclusive_group()
    killing.add_argument("--no-kill", action="store_true", help="leave the killed worker out")
    killing.add_argument("--only-kill", action="store_true", help="compare the shortest piece only, twice")


def measure(arguments: argparse.Namespace) -> Figures:
    """Print a line for each log, and return shares, times, and whether a killed worker changed anything."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        building_of = line_up(folder, arguments.buildings, arguments.drawings)
        drawings = list(building_of)
        logs = [
            path
            for building in arguments.buildings
            for path in write_pieces(folder, building, arguments.pieces, TRAVEL)
        ]
        shortest = min(logs, key=lambda log: log.stat().st_size)
        if arguments.only_kill:
            rankings, times = ranked(drawings, [shortest], arguments.workers)
            return {**times, **after_kill(drawings, shortest, rankings[shortest])}
        print(
            f"{'log':20s}{'place of a right one':>22s}{'evidence':>10s}{'best wrong':>12s}  first", flush=True
        )
        alone, times = ranked(drawings, logs[:1], arguments.workers)
        rest, times_of_rest = ranked(drawings, logs[1:], arguments.workers)
        rankings = {**alone, **rest}
        figures = summarize({log.name: row_of(log, rankings[log], building_of) for log in logs})
        figures["above_wrong"] = above_wrong(rankings, building_of)
        figures |= {"drawings": len(drawings), **times}
        figures |= {f"{name}_together": value / (len(logs) - 1) for name, value in times_of_rest.items()}
        for kind in times:
            together = figures.get(f"{kind}_together", math.nan)
            print(f"{kind.replace('_', ' ')}: {figures[kind]:.0f} alone, {together:.0f} together", flush=True)
        if not arguments.no_kill:
            figures |= after_kill(drawings, shortest, rankings[shortest])
    return figures


def ranked(
    drawings: Sequence[Path], logs: Sequence[Path], count: int
) -> tuple[dict[Path, tuple[Score, ...]], Figures]:
    """Rank drawings for logs, if there are any, in processes; return the rankings and the times [s]."""
    if not logs:
        return {}, {}
    board, began, spent = Board(), time.perf_counter(), processor_seconds()
    with Processes(count) as workers:
        for log in rank(drawings, logs, workers, board, travel=TRAVEL):
            print(f"{log.name} is ranked", file=sys.stderr, flush=True)
        seconds = time.perf_counter() - began
    times = {"seconds": seconds, "processor_seconds": processor_seconds() - spent}
    return {log: board.ranking(log) for log in logs}, times


def processor_seconds() -> float:
    """Return what processes that were started here and have ended took [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def above_wrong(rankings: dict[Path, tuple[Score, ...]], building_of: dict[Path, str]) -> Figures:
    """Print and return, by hand, how many of the wrong drawings a right one beats, on average."""
    shares: dict[str, list[float]] = {}
    for log, ranking in rankings.items():
        right = [building_of[one.drawing] == building_in(log) for one in ranking]
        for place, (one, is_right) in enumerate(zip(ranking, right, strict=True)):
            if is_right and False in right:
                beaten = right[place:].count(False) / right.count(False)
                shares.setdefault(one.drawing.stem.rpartition("-")[0] or one.drawing.stem, []).append(beaten)
    figures = {hand: float(np.mean(values)) for hand, values in sorted(shares.items())}
    print("a right drawing beats of the wrong ones: " + ", ".join(f"{k} {v:.2f}" for k, v in figures.items()))
    return figures


def building_in(log: Path) -> str:
    """Return the building of a piece of a log, by its name."""
    return log.name.rpartition("-")[0]


def row_of(log: Path, ranking: Sequence[Score], building_of: dict[Path, str]) -> Figures:
    """Print a line for a log, and return its figures."""
    right = [building_of[one.drawing] == building_in(log) for one in ranking]
    evidence = [one.evidence.log_evidence for one in ranking]
    refined = [one.is_refined for one in ranking]
    wrong = [
        value for value, is_right, told in zip(evidence, right, refined, strict=True) if told and not is_right
    ]
    row: Figures = {
        "place": right.index(True) + 1,
        "evidence": evidence[right.index(True)],
        "best_wrong": max(wrong, default=None),
        "first": f"{ranking[0].drawing.parent.name}/{ranking[0].drawing.stem}",
    }
    best_wrong = "-" if row["best_wrong"] is None else f"{row['best_wrong']:.1f}"
    print(
        f"{log.name:20s}{row['place']:22d}{row['evidence']:10.1f}{best_wrong:>12s}  {row['first']}",
        flush=True,
    )
    return row


def summarize(rows: dict[str, Figures]) -> Figures:
    """Print and return the shares."""
    firsts = [float(row["place"] == 1) for row in rows.values()]
    figures: Figures = {
        "first": float(np.mean(firsts)),
        "first_interval": bootstrap_interval(firsts, np.random.default_rng(0)),
        "top5": float(np.mean([row["place"] <= FIRST_PLACES for row in rows.values()])),
        "logs": rows,
    }
    print(f"a right drawing first: {figures['first']:.2f}, among the first five: {figures['top5']:.2f}")
    return figures


def after_kill(drawings: Sequence[Path], log: Path, expected: tuple[Score, ...]) -> Figures:
    """Rank drawings on two workers of Dask of which one is killed in mid-run; tell if that matters."""
    board, compared, began = Board(), 0, time.perf_counter()
    with local_cluster() as (address, victim), Cluster(address) as workers:

        def watch(_text: str) -> None:
            nonlocal compared
            compared += 1
            if compared == max(len(drawings) // 5, 1):
                victim.kill()

        for _ in rank(drawings, [log], workers, board, travel=TRAVEL, say=watch):
            pass
        if victim.poll() is None:
            raise AssertionError("no worker was killed")
    identical = board.ranking(log) == expected
    seconds = time.perf_counter() - began
    print(
        f"{log.name}, {len(drawings)} drawings, a worker killed after {max(len(drawings) // 5, 1)}:"
        f" {'the same' if identical else 'another'} ranking, {seconds:.0f} s"
    )
    return {"after_kill_identical": identical, "after_kill_seconds": seconds}


@contextlib.contextmanager
def local_cluster() -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """Start a scheduler and two workers of Dask on this machine; return its address and one worker."""
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as processes:
        told = Path(folder) / "scheduler.json"

        def start(*words: str) -> subprocess.Popen[bytes]:
            process = subprocess.Popen(  # noqa: S603  # fixed words
                [sys.executable, "-m", "distributed.cli.dask_" + words[0], *words[1:]],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                cwd=folder,
                env={**os.environ, "TMPDIR": folder},  # those that are killed cannot tidy up
            )
            processes.callback(process.wait)
            processes.callback(process.kill)
            return process

        start(
            "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(told)
        )
        deadline = time.monotonic() + STARTED
        while not told.exists() and time.monotonic() < deadline:
            time.sleep(0.1)
        options = ("--scheduler-file", str(told), "--nthreads", "1", "--no-nanny", "--no-dashboard")
        victim, _ = start("worker", *options), start("worker", *options)
        yield address_in(told), victim


def address_in(path: Path) -> str:
    """Return the address of a scheduler from its file."""
    return str(json.loads(path.read_text())["address"])


def render(figures: Figures) -> str:
    """Write the table of README."""
    head = (
        "logs",
        "drawings",
        "a right one first",
        "among the first five",
        "s a log on 2 cores, alone and of many",
        "ranking after a worker was killed",
    )
    killed = {True: "the same", False: "another", None: "-"}[figures.get("after_kill_identical")]
    low, high = figures["first_interval"]
    row = (
        str(len(figures["logs"])),
        str(figures["drawings"]),
        f"{percent(figures['first'])} [{100.0 * low:.0f}, {100.0 * high:.0f}]",
        percent(figures["top5"]),
        f"{figures['seconds']:.0f}, {figures['seconds_together']:.0f}",
        killed,
    )
    return "\n".join(
        [
            prose(
                "Pieces of 40 m of the logs of six buildings, each compared with a hundred drawings:"
                " by draftsmen of all six, quick, schematic, by people, and made in people's manner."
                " A drawing is right if it is of the log's building."
            ),
            "",
            table(head, [row]),
        ]
    )
