"""Localize over long ways, and tell whether a robot that has found its place keeps it.

    python -m benchmarks staying

As `localization`, but episodes are 160 m long: longer than most drives. Told are the scans in the right room
in each quarter of the way, and how many are sure (above 0.9) and wrong. A filter whose model is true grows
surer on the way; one that gives up right places, or cannot leave wrong ones, does not. Intervals are 95 %
bootstrap intervals over episodes. Scans in rooms that a drawing leaves out are not counted.
"""

import argparse
from itertools import pairwise

import numpy as np

from benchmarks.lib.arguments import add_drawings, add_jobs, positive
from benchmarks.lib.data import TUNED, drawings
from benchmarks.lib.protocols import Followed, Task, follow_all
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import percent, percent_in, prose, table
from pilotage.evaluation.episodes import Trace, score
from pilotage.evaluation.intervals import bootstrap_interval

LENGTH = 160.0  # [m] of an episode
QUARTERS = (0.0, 40.0, 80.0, 120.0, 160.0)  # [m]
EPISODES = 4


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose drawings and the number of episodes."""
    add_drawings(parser)
    parser.add_argument(
        "--episodes", type=positive, default=EPISODES, help="for each drawing (default: %(default)s)"
    )
    add_jobs(parser)


def measure(arguments: argparse.Namespace) -> Figures:
    """Run all episodes, print a line for each drawing, and return the figures by hand."""
    tasks = [
        Task(building, hand, arguments.episodes, length=LENGTH)
        for building, hand in drawings(arguments.buildings, arguments.hands)
    ]
    followed = list(follow_all(tasks, arguments.jobs, reuse=False))
    print(f"{'':24s}{'right in each 40 m':>28s}{'after 40 m':>12s}{'sure+wrong':>12s}")
    for one in followed:
        print_row(f"{one.task.building} {one.task.hand}", summarize([one]))
    figures = {}
    for hand in arguments.hands:
        own = [one for one in followed if one.task.hand == hand]
        held_out = [one for one in own if one.task.building not in TUNED]
        figures[hand] = summarize(own) | {"held_out": summarize(held_out) if held_out else None}
        print_row(f"all {hand}", figures[hand])
    return figures


def summarize(followed: list[Followed]) -> Figures:
    """Return the figures of some drawings; every episode has the same weight."""
    traces = [trace for one in followed for trace in one.traces]
    later = [share for trace in traces if np.isfinite(share := right_share(trace, QUARTERS[1], LENGTH))]
    quarters = [[right_share(trace, *bounds) for trace in traces] for bounds in pairwise(QUARTERS)]
    return {
        "room_by_40_m": [float(np.nanmean(shares)) for shares in quarters],
        "room_after_40_m": float(np.mean(later)),
        "room_after_40_m_interval": bootstrap_interval(later, np.random.default_rng(0)),
        "confident_wrong": float(np.mean([score(trace).sure_and_wrong for trace in traces])),
        "episodes": len(traces),
    }


def right_share(trace: Trace, begin: float, end: float) -> float:
    """Return the share of scans in the right room over a part of the way [m]; nan if none is counted."""
    right = trace.right[trace.counted & (trace.way >= begin) & (trace.way < end)]
    return float(right.mean()) if len(right) else float("nan")


def print_row(name: str, row: Figures) -> None:
    """Print the figures of a drawing, or of all by one hand."""
    quarters = "".join(f"{share:7.2f}" for share in row["room_by_40_m"])
    print(f"{name:24s}{quarters}{row['room_after_40_m']:12.2f}{row['confident_wrong']:12.3f}", flush=True)


def render(figures: Figures) -> str:
    """Write the table of README."""
    text = """
        The same over ways of 160 m. Shares are of scans in the right room, means over episodes.
    """
    rows = [
        (
            f"`{hand}`",
            str(row["episodes"]),
            ", ".join(percent(share) for share in row["room_by_40_m"]),
            percent_in(row["room_after_40_m"], row["room_after_40_m_interval"]),
            percent((row["held_out"] or {}).get("room_after_40_m")),
            percent(row["confident_wrong"], 1),
        )
        for hand, row in figures.items()
    ]
    head = (
        "drawings",
        "episodes",
        "right in each 40 m",
        "after the first 40 m",
        "of these in held-out buildings",
        "sure (> .9) and wrong",
    )
    return f"{prose(text)}\n\n{table(head, rows)}"
