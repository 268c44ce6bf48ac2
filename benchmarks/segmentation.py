"""Compare rules for where a scan falls into partial shapes, on real logs.

    python -m benchmarks segmentation

The paper's rule breaks at lines nearly along the line of sight; ours keeps those that prolong others next to
them. Printed are, for every fifth scan, the mean number of shapes, the mean length of the longest and the
share of returns that belong to any.
"""

import argparse
from dataclasses import replace

import numpy as np

from benchmarks.lib.arguments import names_of
from benchmarks.lib.data import LOG_NAMES, LOGS
from benchmarks.lib.results import Figures
from pilotage.io.logs import open_log
from pilotage.perception import PerceptionSettings, perceive
from pilotage.perception.perceive import find_runs

MAX_RANGE = 30.0  # [m]
EVERY = 5
RULES = {"ours": PerceptionSettings(), "paper": PerceptionSettings(max_line_ratio=0.0)}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose logs."""
    parser.add_argument(
        "--logs", type=names_of(LOG_NAMES), default=",".join(LOG_NAMES), help="(default: %(default)s)"
    )


def measure(arguments: argparse.Namespace) -> Figures:
    """Print a line for each log and rule, and return the figures."""
    figures: Figures = {}
    for name in arguments.logs:
        scans = [reading.scan for reading in open_log(LOGS / f"{name}.log.gz").readings[::EVERY]]
        scans = [replace(scan, range_max=min(scan.range_max, MAX_RANGE)) for scan in scans]
        for rule, settings in RULES.items():
            shapes = [perceive(scan, settings) for scan in scans]
            longest = [max((shape.polyline.length for shape in seen), default=0.0) for seen in shapes]
            used = [sum(len(run.beams) for run in find_runs(scan, settings)) for scan in scans]
            share = sum(used) / sum(int(scan.returned.sum()) for scan in scans)
            figures.setdefault(name, {})[rule] = {
                "shapes": float(np.mean([len(seen) for seen in shapes])),
                "longest": float(np.mean(longest)),
                "returns": share,
            }
            print(
                f"{name:18s} {rule:6s} {np.mean([len(seen) for seen in shapes]):5.1f} shapes"
                f"   longest {np.mean(longest):5.2f} m   {100 * share:5.1f} % of returns"
            )
    return figures
