"""Localize in one building by the drawing of another, and tell how often the mismatch is noticed.

    python -m benchmarks mismatch

The log of each building is localized on the drawings of all others, 40 m at a time. A mismatch is noticed if
that is the status at the end. False alarms are counted over the episodes of `localization`, where the drawing
is right. Intervals are 95 % bootstrap intervals over episodes.
"""

import argparse
from collections.abc import Sequence

import numpy as np

from benchmarks.lib.arguments import add_drawings, add_jobs, positive
from benchmarks.lib.data import BUILDINGS, drawings
from benchmarks.lib.protocols import Followed, Task, all_traces, follow_all
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import percent, percent_in, prose, table
from benchmarks.localization import EPISODES
from pilotage.evaluation.episodes import Trace
from pilotage.evaluation.intervals import bootstrap_interval


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose drawings and the number of episodes."""
    add_drawings(parser)
    parser.add_argument(
        "--episodes", type=positive, default=2, help="for each pair of log and drawing (default: %(default)s)"
    )
    parser.add_argument(
        "--right-episodes", type=positive, default=EPISODES, help="on right drawings (default: %(default)s)"
    )
    add_jobs(parser)


def measure(arguments: argparse.Namespace) -> Figures:
    """Run all pairs, print how often the status is mismatch, and return the figures."""
    chosen = drawings(arguments.buildings, arguments.hands)
    wrong = [
        Task(building, hand, arguments.episodes, drawing=other)
        for other, hand in chosen
        for building in BUILDINGS
        if building != other
    ]
    right = [Task(building, hand, arguments.right_episodes) for building, hand in chosen]
    on_wrong = list(follow_all(wrong, arguments.jobs, reuse=True))
    on_right = list(follow_all(right, arguments.jobs, reuse=True))
    return summarize(on_wrong, on_right, arguments.hands)


def summarize(on_wrong: Sequence[Followed], on_right: Sequence[Followed], hands: Sequence[str]) -> Figures:
    """Print a line for each hand and for all, and return the figures."""
    print(f"{'':12s}{'episodes':>9s}{'noticed':>20s}{'at any time':>13s}{'false alarm':>20s}{'of scans':>9s}")
    rows = {
        hand: row_of(
            hand,
            all_traces(one for one in on_wrong if one.task.hand == hand),
            all_traces(one for one in on_right if one.task.hand == hand),
        )
        for hand in hands
    }
    figures = row_of("all", all_traces(on_wrong), all_traces(on_right))
    figures["by_hand"] = rows
    figures["by_drawing"] = {
        f"{one.task.building} on {one.task.drawing}/{one.task.hand}": share_at_end(one.traces)
        for one in on_wrong
    }
    return figures


def row_of(title: str, wrong: Sequence[Trace], right: Sequence[Trace]) -> Figures:
    """Print one line and return its figures."""
    noticed, alarmed = ([float(trace.mismatch[-1]) for trace in traces] for traces in (wrong, right))
    row: Figures = {
        "noticed": float(np.mean(noticed)),
        "noticed_interval": bootstrap_interval(noticed, np.random.default_rng(0)),
        "noticed_at_any_time": float(np.mean([trace.mismatch.any() for trace in wrong])),
        "episodes": len(wrong),
        "false_alarm": float(np.mean(alarmed)),
        "false_alarm_interval": bootstrap_interval(alarmed, np.random.default_rng(0)),
        "false_alarm_scans": float(np.mean([trace.mismatch.mean() for trace in right])),
        "right_episodes": len(right),
    }
    spans = [
        "{:.2f} [{:.2f}, {:.2f}]".format(row[name], *row[f"{name}_interval"])
        for name in ("noticed", "false_alarm")
    ]
    print(
        f"{title:12s}{len(wrong):9d}{spans[0]:>20s}{row['noticed_at_any_time']:13.2f}{spans[1]:>20s}"
        f"{row['false_alarm_scans']:9.3f}",
        flush=True,
    )
    return row


def share_at_end(traces: Sequence[Trace]) -> float:
    """Return the share of episodes that end with a mismatch."""
    return float(np.mean([trace.mismatch[-1] for trace in traces]))


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = [
        (
            name,
            str(row["episodes"]),
            percent_in(row["noticed"], row["noticed_interval"]),
            str(row["right_episodes"]),
            percent_in(row["false_alarm"], row["false_alarm_interval"]),
            percent(row["false_alarm_scans"], 1),
        )
        for name, row in (("all", figures), *((f"`{hand}`", row) for hand, row in figures["by_hand"].items()))
    ]
    return "\n".join(
        [
            prose(
                "The log of each building is localized on the drawings of the others; `mismatch` should be"
                " the status after 40 m. On the right drawing it should not. The limit was chosen with all"
                " six buildings in view."
            ),
            "",
            table(
                (
                    "drawings",
                    "episodes on a wrong drawing",
                    "mismatch at the end",
                    "on the right one",
                    "mismatch at the end",
                    "of all scans",
                ),
                rows,
            ),
        ]
    )
