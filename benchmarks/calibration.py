"""Compare the probability of estimates with how often they are right, over the episodes of localization.

    python -m benchmarks calibration

An estimate is right if it lies in the true room. Expected calibration error (ECE) over ten intervals of equal
width, AUROC and Brier score; every episode has the same weight, however many scans it has. Episodes that
`localization` has run on the same commit are not run again. Intervals are 95 %, bootstrap over episodes.
A default run draws docs/images/reliability.png.
"""

import argparse
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from benchmarks.lib.arguments import add_drawings, add_jobs, positive
from benchmarks.lib.data import ROOT, TUNED, drawings
from benchmarks.lib.protocols import Followed, Task, all_traces, follow_all
from benchmarks.lib.reliability import write_reliability
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import percent, prose, table
from benchmarks.localization import EPISODES
from pilotage.evaluation.calibration import calibration

PICTURE = ROOT / "docs" / "images" / "reliability.png"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose drawings, the number of episodes, and where the picture goes."""
    add_drawings(parser)
    parser.add_argument(
        "--episodes", type=positive, default=EPISODES, help="for each drawing (default: %(default)s)"
    )
    add_jobs(parser)
    parser.add_argument("--figure", type=Path, help="draw the reliability diagram here")


def measure(arguments: argparse.Namespace) -> Figures:
    """Gather episodes, print how well probabilities are calibrated, and return the figures."""
    tasks = [
        Task(building, hand, arguments.episodes)
        for building, hand in drawings(arguments.buildings, arguments.hands)
    ]
    followed = list(follow_all(tasks, arguments.jobs, reuse=True))
    print(f"{'':12s}{'episodes':>9s}{'ECE':>20s}{'AUROC':>8s}{'Brier':>8s}")
    figures = calibrated("all", followed)
    figures["by_hand"] = {
        hand: calibrated(hand, [one for one in followed if one.task.hand == hand]) for hand in arguments.hands
    }
    for name, is_tuned in (("tuned", True), ("held_out", False)):
        part = [one for one in followed if (one.task.building in TUNED) == is_tuned]
        if part:
            figures[name] = calibrated(name.replace("_", " "), part)
    path = arguments.figure
    if path is None and not arguments.no_save and is_whole(tasks):
        path = PICTURE
    if path is not None:
        write_reliability(path, figures["bins"], figures["ece"])
    return figures


def is_whole(tasks: Sequence[Task]) -> bool:
    """Tell whether these are the tasks of a default run."""
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    default = parser.parse_args([])
    return list(tasks) == [
        Task(building, hand, default.episodes)
        for building, hand in drawings(default.buildings, default.hands)
    ]


def calibrated(title: str, followed: Sequence[Followed]) -> Figures:
    """Print a line and return its figures; AUROC is None if all scans are right or all wrong."""
    found = calibration(all_traces(followed), np.random.default_rng(0))
    low, high = found.ece_interval
    print(
        f"{title:12s}{found.episodes:9d}{found.ece:7.3f} [{low:.3f}, {high:.3f}]"
        f"{found.auroc:7.3f}{found.brier:8.3f}",
        flush=True,
    )
    figures = asdict(found)
    if np.isnan(found.auroc):
        figures["auroc"] = None
    return figures


def render(figures: Figures) -> str:
    """Write the table of README."""
    parts = {
        "all": figures,
        **{f"`{hand}`": row for hand, row in figures["by_hand"].items()},
        **{
            f"{name.replace('_', '-')} buildings": figures[name]
            for name in ("tuned", "held_out")
            if name in figures
        },
    }
    rows = [
        (
            name,
            str(row["episodes"]),
            "{:.3f} [{:.3f}, {:.3f}]".format(row["ece"], *row["ece_interval"]),
            "-" if row["auroc"] is None else f"{row['auroc']:.2f}",
            f"{row['brier']:.3f}",
        )
        for name, row in parts.items()
    ]
    last = figures["bins"][-1]
    return "\n".join(
        [
            prose(
                "How far the probability of an estimate is from the share of estimates in the right room;"
                f" every episode has the same weight. Between {percent(last['low'])} and"
                f" {percent(last['high'])} it is {percent(last['probability'])} on average, and"
                f" {percent(last['right'])} are right."
            ),
            "",
            table(("drawings", "episodes", "expected calibration error", "AUROC", "Brier score"), rows),
            "",
            "![Share right against probability](docs/images/reliability.png)",
        ]
    )
