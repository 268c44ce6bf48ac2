"""Score what is read on plans as architects, offices and phones make them.

Three groups: the flat of seven rooms in 28 dialects of SVG, the same flat in 10 simulated photos, and 20 real
plans by others (SVG, DXF, PDF, pictures, draw.io, Excalidraw). Each is opened as a user opens it, without a
hint, in a process of its own.

rooms: a room is found if its point lies in a cell that holds no other room's point, and the cell holds more
than half of the room. Of the real plans only points are known: there a disc stands for the room, a quarter
of the distance to the nearest other point in radius. Two names of one open space may be one cell, as the
truth of the plans says; "strict" is the share if they may not.

names: the cell of a room bears its name, case, accents, areas and sizes apart; of the rooms whose name is in
the file as text. Pictures are not counted: their words are pixels.

connections: pairs of rooms that gateways join, through nothing but unnamed small cells, against those that a
person reads.

A file that cannot be read, or takes a minute, counts 0. Seconds are of the processor, from opening the file
to the cells; MB is the peak of the process, libraries included.
"""

import argparse
import fnmatch
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from benchmarks.lib.arguments import add_jobs
from benchmarks.lib.divide import divide
from benchmarks.lib.plans import Plan, PlanScore, all_plans, score
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import number, table

GROUPS = {
    "dialects": "the flat in 28 dialects of SVG",
    "photos": "the flat in 10 photos",
    "plans": "20 real plans",
}
MEANS = (
    "rooms",
    "rooms_strict",
    "names",
    "connections_p",
    "connections_r",
    "connections_f1",
    "seconds",
    "mb",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Let the user choose files."""
    parser.add_argument(
        "--only",
        metavar="PATTERN",
        default="*",
        help="files to read, as in 'plans/*.dxf', 'photos/*' or 'ikea' (default: all)",
    )
    add_jobs(parser)


def measure(arguments: argparse.Namespace) -> Figures:
    """Print a line a file, and return the figures of all files and their means."""
    pattern = arguments.only if any(sign in arguments.only for sign in "*?[") else f"*{arguments.only}*"
    chosen = [plan for plan in all_plans() if fnmatch.fnmatch(plan.key, pattern)]
    if not chosen:
        return {"failed": f"no file fits {arguments.only}"}
    print(
        f"{'file':46} {'rooms':>6} {'strict':>6} {'names':>6} {'prec.':>6} {'recall':>6} {'F1':>6}"
        f" {'cells':>5} {'s':>6} {'MB':>5}"
    )
    scores: list[PlanScore] = []
    with ThreadPoolExecutor(arguments.jobs) as pool:  # each waits for a process of its own
        for one in pool.map(score_file, chosen):
            print(line_of(one), flush=True)
            scores.append(one)
    figures: Figures = {one.key: one.figures for one in scores}
    for group in GROUPS:
        members = [one.figures for one in scores if one.key.startswith(f"{group}/")]
        if members:
            figures[f"mean of {group}"] = mean_of(members)
            print(words_of(f"mean of {group}", figures[f"mean of {group}"]))
    figures["mean"] = mean_of([one.figures for one in scores])
    print(words_of("mean", figures["mean"]))
    return figures


def score_file(plan: Plan) -> PlanScore:
    """Read a file in a process of its own and score it."""
    return score(plan, divide(plan.path))


def line_of(one: PlanScore) -> str:
    """Write the line of a file, with the rooms that were missed or the error."""
    told = one.error[:100] if one.error else f"misses {', '.join(one.missed)}" if one.missed else ""
    figures = one.figures
    shares = " ".join(f"{share(figures[name]):>6}" for name in MEANS[:6])
    return f"{one.key:46} {shares} {one.cells:5} {one.seconds:6.2f} {one.mb:5.0f}  {told}".rstrip()


def share(value: float | None) -> str:
    """Write a share, a dash if there is none."""
    return number(value, 2)


def mean_of(figures: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Average over files; where a file has no figure it is left out. Also the median and the worst time."""
    seconds = [one["seconds"] for one in figures]
    means: dict[str, Any] = {}
    for name in MEANS:
        known = [one[name] for one in figures if one[name] is not None]
        means[name] = float(np.mean(known)) if known else None
    return {
        **means,
        "seconds_median": float(np.median(seconds)),
        "seconds_max": float(max(seconds)),
        "mb_max": float(max(one["mb"] for one in figures)),
        "files": len(figures),
    }


def words_of(title: str, means: dict[str, Any]) -> str:
    """Write means in one line."""
    shares = " ".join(f"{share(means[name]):>6}" for name in MEANS[:6])
    return (
        f"{title:46} {shares}   {means['files']} files, median {means['seconds_median']:.2f} s,"
        f" worst {means['seconds_max']:.1f} s, {means['mb_max']:.0f} MB"
    )


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = []
    for group, words in GROUPS.items():
        means = figures[f"mean of {group}"]
        rows.append(
            (
                words,
                share(means["rooms"]),
                share(means["names"]),
                share(means["connections_p"]),
                share(means["connections_r"]),
                share(means["connections_f1"]),
                f"{means['seconds_median']:.1f} s, {means['seconds_max']:.1f} s",
                f"{means['mb_max']:.0f} MB",
            )
        )
    head = ("files", "rooms", "names", "precision", "recall", "F1", "time, median and worst", "peak memory")
    return "\n".join(
        [
            "What is read on plans without a hint: rooms found, names right, connections of rooms.",
            "",
            table(head, rows),
        ]
    )
