"""Score registration on real logs: errors of each step against the truth, and time.

    python benchmarks/registration.py [--logs DIR] [--only LOG ...] [--seed N] [--shapes] [--json FILE]

Pairs of consecutive scans, thinned to a motion of at least 0.5 m or 20 degrees, ranges cut at 30 m. The guess
is the raw odometry, as it is and spoilt by noise of 30 % of the distance and 20 degrees a meter. Each scan is
registered into the local map of the scans before it. A step is good when it errs by less than 0.2 m and
3 degrees. Settings were chosen on csail, aces, freiburg-079 and the first 500 steps of infinite-corridor; the
rest of it, freiburg-101, belgioioso and fhw were held back.

`--shapes` adds a row for the registration of the paper, by shape alone; it is slow.
"""

import argparse
import json
import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from pilotage.evaluation.intervals import bootstrap_interval
from pilotage.evaluation.relations import read_relations, relation_errors
from pilotage.evaluation.trajectory import (
    MotionErrors,
    associate,
    chain,
    motion_errors,
    motions,
    spoil,
    thin,
)
from pilotage.geometry import Array, Pose2, Trajectory
from pilotage.io.logs import open_log
from pilotage.io.tum import read_trajectory
from pilotage.perception import Odometry, Reading
from pilotage.scan_matching import Method, ScanMatcher, ScanMatchingSettings

LOGS = Path(__file__).resolve().parents[2] / "shared" / "data" / "logs"
NAMES = ("freiburg-079", "freiburg-101", "csail", "aces", "infinite-corridor", "belgioioso", "fhw")
MIN_DISTANCE, MIN_TURN = 0.5, math.radians(20.0)  # [m, rad] between scans
MAX_RANGE = 30.0  # [m]
GOOD_PLACE, GOOD_TURN = 0.2, math.radians(3.0)  # [m, rad]
SPOILT_PLACE, SPOILT_TURN = 0.3, math.radians(20.0)  # [m/m, rad/m]
WARM_UP = 30  # readings registered before the clock runs


@dataclass(frozen=True)
class Run:
    """A log as it was registered."""

    steps: list[Pose2]
    elapsed_ms: Array  # (n,) for each step: perceive, register and merge


def cut(reading: Reading) -> Reading:
    """Limit the ranges."""
    scan = reading.scan
    return replace(reading, scan=replace(scan, range_max=min(scan.range_max, MAX_RANGE)))


def run(readings: Sequence[Reading], odometry: Sequence[Pose2], method: Method = Method.SEGMENTS) -> Run:
    """Register each reading into the map of those before it."""
    scan_matcher = ScanMatcher(ScanMatchingSettings(method=method))
    steps, elapsed = [], []
    for reading, odom_from_base in zip(readings, odometry, strict=True):
        start = time.perf_counter()
        motion = scan_matcher.update(reading.scan, Odometry(reading.odometry.stamp, odom_from_base))
        elapsed.append((time.perf_counter() - start) * 1e3)
        steps.append(motion.last_from_base)
    return Run(steps[1:], np.array(elapsed[1:]))


def is_good(errors: MotionErrors) -> Array:
    """Return 1.0 for a good step and 0.0 for others, (n,)."""
    return ((errors.place < GOOD_PLACE) & (errors.turn < GOOD_TURN)).astype(float)


def report(
    name: str, errors: MotionErrors, elapsed_ms: Array | None, rng: np.random.Generator
) -> dict[str, float]:
    """Print a line and return its numbers."""
    good = is_good(errors)
    low, high = bootstrap_interval(good, rng)
    t_median, t_p95 = np.quantile(errors.place, [0.5, 0.95]).tolist()
    r_median, r_p95 = np.rad2deg(np.quantile(errors.turn, [0.5, 0.95])).tolist()
    line = (
        f"  {name:10s} {100 * good.mean():6.2f} % good [{100 * low:.1f}, {100 * high:.1f}]"
        f"   {t_median:.3f} {t_p95:.3f} m   {r_median:.2f} {r_p95:.2f} deg"
    )
    values = {"good": float(good.mean()), "t_median": t_median, "t_p95": t_p95}
    values |= {"r_median_deg": r_median, "r_p95_deg": r_p95}
    if elapsed_ms is not None:
        ms_median, ms_p95 = np.quantile(elapsed_ms, [0.5, 0.95]).tolist()
        line += f"   {ms_median:.1f} {ms_p95:.1f} ms"
        values |= {"ms_median": ms_median, "ms_p95": ms_p95}
    print(line, flush=True)
    return values


def score_log(directory: Path, name: str, seed: int, *, shapes: bool) -> dict[str, float]:
    """Register a log with its odometry as it is and spoilt."""
    rng = np.random.default_rng(seed)
    log = open_log(directory / f"{name}.log.gz")
    truth = read_trajectory(directory / f"{name}.truth.tum")
    indices = associate(np.array([reading.scan.stamp for reading in log]), truth)
    poses = [truth.pose(index) for index in indices]
    kept = thin(poses, MIN_DISTANCE, MIN_TURN)
    readings = [cut(log.readings[index]) for index in kept]
    true = motions([poses[index] for index in kept])
    reckoned = motions([reading.odometry.odom_from_base for reading in readings])
    spoilt = spoil(reckoned, rng, place_per_meter=SPOILT_PLACE, turn_per_meter=SPOILT_TURN)
    run(readings[:WARM_UP], chain(reckoned[: WARM_UP - 1]))

    print(f"{name}: {len(true)} steps; median and 95th percentile of errors", flush=True)
    report("odometry", motion_errors(reckoned, true), None, rng)
    plain = run(readings, chain(reckoned))
    values = report("registered", motion_errors(plain.steps, true), plain.elapsed_ms, rng)
    if shapes:
        paper = run(readings, chain(reckoned), Method.SHAPES)
        report("by shape", motion_errors(paper.steps, true), paper.elapsed_ms, rng)
    report("spoilt", motion_errors(spoilt, true), None, rng)
    robust = run(readings, chain(spoilt))
    values["good_spoilt"] = report("registered", motion_errors(robust.steps, true), robust.elapsed_ms, rng)[
        "good"
    ]
    return values


def score_relations(directory: Path) -> dict[str, float]:
    """Register every scan of freiburg-079 and score the chain by relations checked by hand."""
    log = open_log(directory / "freiburg-079.log.gz")
    readings = [cut(reading) for reading in log]
    steps = run(readings, [reading.odometry.odom_from_base for reading in readings]).steps
    stamps = np.array([reading.scan.stamp for reading in readings])
    poses = np.array([(pose.x, pose.y, pose.theta) for pose in chain(steps)])
    errors = relation_errors(
        Trajectory(stamps, poses), read_relations(directory / "freiburg-079.relations")
    ).place
    values = {"mean": float(errors.mean()), "std": float(errors.std())}
    print(f"relations: {values['mean']:.3f} +- {values['std']:.3f} m, {len(readings)} scans chained")
    return values


def main() -> None:
    """Score, print and write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--logs", type=Path, default=LOGS, help="folder with LOG.log.gz and LOG.truth.tum")
    parser.add_argument("--only", nargs="+", choices=(*NAMES, "relations"), default=(*NAMES, "relations"))
    parser.add_argument("--seed", type=int, default=0, help="of the noise that spoils odometry")
    parser.add_argument(
        "--shapes", action="store_true", help="also register by shape alone, as the paper does"
    )
    parser.add_argument("--json", type=Path, help="write the numbers here")
    arguments = parser.parse_args()
    scores = {
        name: score_log(arguments.logs, name, arguments.seed, shapes=arguments.shapes)
        for name in NAMES
        if name in arguments.only
    }
    if scores:
        mean = np.mean([score["good_spoilt"] for score in scores.values()])
        print(f"mean share of good steps with spoilt odometry: {100 * mean:.2f} %")
    if "relations" in arguments.only:
        scores["relations"] = score_relations(arguments.logs)
    if arguments.json:
        arguments.json.write_text(json.dumps(scores, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
