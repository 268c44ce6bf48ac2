"""Localize on drawings of six real buildings from an unknown start, and tell how often the room is right.

    python -m benchmarks localization

Each episode puts the robot down somewhere in the log of a building and takes the next 40 m of travel: no
start, no heading, no scale. Scans in rooms that a drawing leaves out are not counted. The hands `freehand`
and `plan` are drawings of one building by people. Intervals are 95 % bootstrap intervals over episodes.
Milliseconds are told for all scans, for those of a settled robot (probability above 0.9 for the last 5 m)
and of a lost one (below 0.5). Defaults were chosen on aces, belgioioso, csail and freiburg-079; fhw and
freiburg-101 are held out.
"""

import argparse
import math

import numpy as np

from benchmarks.lib.arguments import add_drawings, add_jobs, positive
from benchmarks.lib.data import BUILDINGS, HANDS, PEOPLE, drawings
from benchmarks.lib.protocols import Followed, Task, follow_all
from benchmarks.lib.results import Figures, means_of_groups
from benchmarks.lib.tables import percent, percent_in, prose, table
from pilotage.evaluation.episodes import lost, score, settled
from pilotage.evaluation.intervals import bootstrap_interval
from pilotage.geometry import Array

EPISODES = 10

HEAD = (
    f"{'building':13s}{'hand':11s}{'room at end':>19s}{'last 10 m':>19s}{'m to fix':>9s}{'sure':>7s}"
    f"{'sure+wrong':>11s}{'ms':>6s}{'p95':>6s}{'settled':>9s}{'p95':>6s}{'lost':>6s}{'atlas s':>8s}"
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose drawings and the number of episodes."""
    hands = (*HANDS, *PEOPLE)
    add_drawings(parser, BUILDINGS, hands, known_hands=hands)
    parser.add_argument(
        "--episodes", type=positive, default=EPISODES, help="for each drawing (default: %(default)s)"
    )
    add_jobs(parser)


def measure(arguments: argparse.Namespace) -> Figures:
    """Run all episodes, print a line for each drawing, and return the figures."""
    tasks = [
        Task(building, hand, arguments.episodes)
        for building, hand in drawings(arguments.buildings, arguments.hands)
    ]
    print(HEAD)
    rows: Figures = {}
    for followed in follow_all(tasks, arguments.jobs, reuse=False):
        row = summarize(followed)
        rows.setdefault(followed.task.building, {})[followed.task.hand] = row
        print(line(followed.task.building, followed.task.hand, row), flush=True)
    hands = list(dict.fromkeys(task.hand for task in tasks))
    means = means_of_groups(rows, arguments.buildings, hands)
    for name, by_hand in means.items():
        for hand, row in by_hand.items():
            print(line(name.replace("_", " "), hand, row))
    return {**rows, **means}


def summarize(followed: Followed) -> Figures:
    """Return the figures of one drawing."""
    scores = [score(trace) for trace in followed.traces]
    ends = [float(one.right_at_end) for one in scores]
    lasts = [one.right_last for one in scores]
    scan_ms = np.concatenate([trace.scan_ms for trace in followed.traces])
    settled_ms = np.concatenate([trace.scan_ms[settled(trace)] for trace in followed.traces])
    lost_ms = np.concatenate([trace.scan_ms[lost(trace)] for trace in followed.traces])
    return {
        "room_end": float(np.mean(ends)),
        "room_end_interval": bootstrap_interval(ends, np.random.default_rng(0)),
        "room_last10": float(np.mean(lasts)),
        "room_last10_interval": bootstrap_interval(lasts, np.random.default_rng(0)),
        "metres_to_fix": float(np.median([one.meters_to_fix for one in scores])),
        "confident_wrong": float(np.mean([one.sure_and_wrong for one in scores])),
        "confident": float(np.mean([one.sure for one in scores])),
        "ms_median": quantile(scan_ms, 0.5),
        "ms_p95": quantile(scan_ms, 0.95),
        "settled_ms_median": quantile(settled_ms, 0.5),
        "settled_ms_p95": quantile(settled_ms, 0.95),
        "lost_ms_median": quantile(lost_ms, 0.5),
        "atlas_s": followed.atlas_s,
        "episodes": len(scores),
    }


def quantile(values: Array, share: float) -> float | None:
    """Return a quantile; None if there is nothing."""
    return float(np.quantile(values, share)) if len(values) else None


def line(building: str, hand: str, row: Figures) -> str:
    """Format the figures of one drawing, or of a mean."""
    cells = [f"{building:13s}{hand:11s}"]
    for name in ("room_end", "room_last10"):
        span = "[{:4.2f}, {:4.2f}]".format(*row[f"{name}_interval"]) if f"{name}_interval" in row else ""
        cells.append(f"{row[name]:6.2f} {span:12s}")
    cells.append(f"{row['metres_to_fix']:9.1f}{row['confident']:7.2f}{row['confident_wrong']:11.3f}")
    for name, width in (
        ("ms_median", 6),
        ("ms_p95", 6),
        ("settled_ms_median", 9),
        ("settled_ms_p95", 6),
        ("lost_ms_median", 6),
    ):
        value = row.get(name)
        cells.append(f"{'-':>{width}s}" if value is None else f"{value:{width}.0f}")
    return f"{''.join(cells)}{row['atlas_s']:8.2f}"


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = []
    for hand, row in figures["mean"].items():
        held_out = figures.get("held_out", {}).get(hand, {})
        ends = [figures[name][hand]["room_end"] for name in BUILDINGS if hand in figures.get(name, {})]
        rows.append(
            (
                f"`{hand}`",
                str(len(ends)),
                percent(row["room_end"]),
                percent(held_out.get("room_end")),
                percent(row["room_last10"]),
                f"{row['metres_to_fix']:.0f} m",
                percent(row["confident_wrong"], 1),
                milliseconds(row, "settled_ms_median", "settled_ms_p95"),
                milliseconds(row, "lost_ms_median"),
            )
        )
    aside = [name for name in figures["mean"] if name in PEOPLE]
    spans = [
        f"`{hand}` is one drawing: {percent_in(row['room_end'], row['room_end_interval'])} at the end."
        for hand in aside
        for row in [figures["belgioioso"][hand]]
    ]
    return "\n".join(
        [
            prose(
                "The robot is put down in real logs of the buildings, told neither start nor heading nor"
                " scale, and travels 40 m. Figures are means over buildings."
            ),
            "",
            table(
                (
                    "drawings",
                    "buildings",
                    "right room at the end",
                    "of these in held-out buildings",
                    "right in the last 10 m",
                    "travel until right for good, median",
                    "sure (> .9) and wrong",
                    "ms a scan when settled, median and 95th percentile",
                    "when lost",
                ),
                rows,
            ),
            *(["", *spans] if spans else []),
        ]
    )


def milliseconds(row: Figures, *names: str) -> str:
    """Write times of a scan."""
    found = [row.get(name) for name in names]
    return ", ".join("-" if value is None or math.isnan(value) else f"{value:.0f}" for value in found)
