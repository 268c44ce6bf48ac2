"""Compare the simulator's odometry with that of real robots, on the trajectories that they drove.

    python -m benchmarks odometry

For each log, its own odometry is compared with the truth over stretches of a few metres, and so is what the
simulator's wheels report along the same truth. Printed are the medians over all stretches of the error of
position, as a share of the distance, and of heading, in degrees.
"""

import argparse
import math
from itertools import pairwise

import numpy as np

from benchmarks.lib.arguments import names_of
from benchmarks.lib.data import LOG_NAMES, LOGS
from benchmarks.lib.results import Figures
from pilotage.evaluation.trajectory import motion_errors
from pilotage.geometry import Pose2
from pilotage.io.logs import open_log
from pilotage.io.tum import read_trajectory
from pilotage.simulation import OdometrySettings, reckon

STRETCHES = (1.0, 5.0, 20.0)  # [m]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose logs."""
    parser.add_argument(
        "--logs", type=names_of(LOG_NAMES), default=",".join(LOG_NAMES), help="(default: %(default)s)"
    )


def measure(arguments: argparse.Namespace) -> Figures:
    """Print two lines for each log, and return the medians over logs."""
    everything: dict[str, list[np.ndarray]] = {"real": [], "simulated": []}
    for name in arguments.logs:
        readings = open_log(LOGS / f"{name}.log.gz").readings
        truth = list(read_trajectory(LOGS / f"{name}.truth.tum"))
        real = [reading.odometry.odom_from_base for reading in readings]
        simulated = reckon(truth, np.random.default_rng(0), OdometrySettings())
        for kind, reported in (("real", real), ("simulated", simulated)):
            medians = np.array([median_errors(truth, reported, stretch) for stretch in STRETCHES])
            everything[kind].append(medians)
            tell(f"{name:18s} {kind:10s}", medians)
    for kind, medians_of_logs in everything.items():
        tell(f"{'median of logs':18s} {kind:10s}", np.median(medians_of_logs, axis=0))
    return {
        kind: {
            f"{stretch:.0f} m": {"place": float(place), "turn_deg": float(turn)}
            for stretch, (place, turn) in zip(STRETCHES, np.median(of_logs, axis=0), strict=True)
        }
        for kind, of_logs in everything.items()
    }


def median_errors(truth: list[Pose2], reported: list[Pose2], stretch: float) -> tuple[float, float]:
    """Return the medians of the errors of place [share] and heading [deg] over stretches of a length [m]."""
    steps = [math.hypot(b.x - a.x, b.y - a.y) for a, b in pairwise(truth)]
    stations = np.concatenate([[0.0], np.cumsum(steps)])
    ends = np.searchsorted(stations, stations + stretch)
    pairs = [(k, int(end)) for k, end in enumerate(ends) if end < len(truth)]
    errors = motion_errors(
        [reported[a].inverse() @ reported[b] for a, b in pairs],
        [truth[a].inverse() @ truth[b] for a, b in pairs],
    )
    ways = np.array([stations[b] - stations[a] for a, b in pairs])
    return float(np.median(errors.place / ways)), float(np.degrees(np.median(errors.turn)))


def tell(title: str, medians: np.ndarray) -> None:
    """Print place and heading for each stretch."""
    parts = (
        f"{stretch:3.0f} m: {100.0 * place:4.1f} % {turn:5.2f} deg"
        for stretch, (place, turn) in zip(STRETCHES, medians, strict=True)
    )
    print(title, "   ".join(parts))
