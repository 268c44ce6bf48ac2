"""Compare rules for where a scan falls into partial shapes, on real logs.

    python benchmarks/segmentation.py [--logs DIR]

The paper's rule breaks at lines nearly along the line of sight; ours keeps those that prolong others next to
them. Told are, for every fifth scan, the mean number of shapes, the mean length of the longest and the share
of returns that belong to any.
"""

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from pilotage.io.logs import open_log
from pilotage.perception import PerceptionSettings, perceive
from pilotage.perception.perceive import find_runs

LOGS = Path(__file__).resolve().parents[2] / "shared" / "data" / "logs"
NAMES = ("freiburg-079", "freiburg-101", "csail", "aces", "infinite-corridor", "belgioioso", "fhw")
MAX_RANGE = 30.0  # [m]
EVERY = 5
RULES = {"ours": PerceptionSettings(), "paper": PerceptionSettings(max_line_ratio=0.0)}


def main() -> None:
    """Print a line for each log and rule."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--logs", type=Path, default=LOGS, help="folder with LOG.log.gz")
    arguments = parser.parse_args()
    for name in NAMES:
        scans = [reading.scan for reading in open_log(arguments.logs / f"{name}.log.gz").readings[::EVERY]]
        scans = [replace(scan, range_max=min(scan.range_max, MAX_RANGE)) for scan in scans]
        for rule, settings in RULES.items():
            shapes = [perceive(scan, settings) for scan in scans]
            longest = [max((shape.polyline.length for shape in seen), default=0.0) for seen in shapes]
            used = [sum(len(run.beams) for run in find_runs(scan, settings)) for scan in scans]
            share = sum(used) / sum(int(scan.returned.sum()) for scan in scans)
            print(
                f"{name:18s} {rule:6s} {np.mean([len(seen) for seen in shapes]):5.1f} shapes"
                f"   longest {np.mean(longest):5.2f} m   {100 * share:5.1f} % of returns"
            )


if __name__ == "__main__":
    main()
