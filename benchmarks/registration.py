"""Score registration on real logs: errors of each step against the truth, and time.

    python -m benchmarks registration

Pairs of consecutive scans, thinned to a motion of at least 0.5 m or 20 degrees, ranges cut at 30 m. The guess
is the raw odometry, as it is and spoilt by noise of 30 % of the distance and 20 degrees a meter. Each scan is
registered into the local map of the scans before it. A step is good when it errs by less than 0.2 m and
3 degrees. Settings were chosen on csail, aces, freiburg-079 and the first 500 steps of infinite-corridor; the
rest of it, freiburg-101, belgioioso and fhw were held back.

`--shapes` adds a row for the registration of the paper, by shape alone; it is slow.
"""

import argparse
import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchmarks.lib.arguments import names_of
from benchmarks.lib.data import LOG_NAMES, LOGS
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import percent, prose, table
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

CHOICES = (*LOG_NAMES, "relations")
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
    values = {
        "good": float(good.mean()),
        "good_low": low,
        "good_high": high,
        "t_median": t_median,
        "t_p95": t_p95,
    }
    values |= {"r_median_deg": r_median, "r_p95_deg": r_p95}
    if elapsed_ms is not None:
        ms_median, ms_p95 = np.quantile(elapsed_ms, [0.5, 0.95]).tolist()
        line += f"   {ms_median:.1f} {ms_p95:.1f} ms"
        values |= {"ms_median": ms_median, "ms_p95": ms_p95}
    print(line, flush=True)
    return values


def score_log(name: str, seed: int, *, shapes: bool) -> dict[str, float]:
    """Register a log with its odometry as it is and spoilt."""
    rng = np.random.default_rng(seed)
    log = open_log(LOGS / f"{name}.log.gz")
    truth = read_trajectory(LOGS / f"{name}.truth.tum")
    indices = associate(np.array([reading.scan.stamp for reading in log]), truth)
    poses = [truth.pose(index) for index in indices]
    kept = thin(poses, MIN_DISTANCE, MIN_TURN)
    readings = [cut(log.readings[index]) for index in kept]
    true = motions([poses[index] for index in kept])
    reckoned = motions([reading.odometry.odom_from_base for reading in readings])
    spoilt = spoil(reckoned, rng, place_per_meter=SPOILT_PLACE, turn_per_meter=SPOILT_TURN)
    run(readings[:WARM_UP], chain(reckoned[: WARM_UP - 1]))

    print(f"{name}: {len(true)} steps; median and 95th percentile of errors", flush=True)
    raw = report("odometry", motion_errors(reckoned, true), None, rng)
    plain = run(readings, chain(reckoned))
    values = report("registered", motion_errors(plain.steps, true), plain.elapsed_ms, rng)
    values["good_odometry"] = raw["good"]
    if shapes:
        paper = run(readings, chain(reckoned), Method.SHAPES)
        report("by shape", motion_errors(paper.steps, true), paper.elapsed_ms, rng)
    report("spoilt", motion_errors(spoilt, true), None, rng)
    robust = run(readings, chain(spoilt))
    values["good_spoilt"] = report("registered", motion_errors(robust.steps, true), robust.elapsed_ms, rng)[
        "good"
    ]
    return values


def score_relations() -> dict[str, float]:
    """Register every scan of freiburg-079 and score the chain by relations checked by hand."""
    log = open_log(LOGS / "freiburg-079.log.gz")
    readings = [cut(reading) for reading in log]
    steps = run(readings, [reading.odometry.odom_from_base for reading in readings]).steps
    stamps = np.array([reading.scan.stamp for reading in readings])
    poses = np.array([(pose.x, pose.y, pose.theta) for pose in chain(steps)])
    errors = relation_errors(Trajectory(stamps, poses), read_relations(LOGS / "freiburg-079.relations")).place
    values = {"mean": float(errors.mean()), "std": float(errors.std())}
    print(f"relations: {values['mean']:.3f} +- {values['std']:.3f} m, {len(readings)} scans chained")
    return values


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose logs, the seed of noise, and the paper's own registration."""
    parser.add_argument(
        "--logs", type=names_of(CHOICES), default=",".join(CHOICES), help="(default: %(default)s)"
    )
    parser.add_argument("--seed", type=int, default=0, help="of the noise that spoils odometry")
    parser.add_argument(
        "--shapes", action="store_true", help="also register by shape alone, as the paper does"
    )


def measure(arguments: argparse.Namespace) -> Figures:
    """Score each log, and return the figures."""
    scores = {
        name: score_log(name, arguments.seed, shapes=arguments.shapes)
        for name in arguments.logs
        if name != "relations"
    }
    if scores:
        mean = np.mean([score["good_spoilt"] for score in scores.values()])
        print(f"mean share of good steps with spoilt odometry: {100 * mean:.2f} %")
    if "relations" in arguments.logs:
        scores["relations"] = score_relations()
    return scores


BEST_KNOWN = {
    "freiburg-079": 0.989,
    "freiburg-101": 1.0,
    "csail": 0.960,
    "aces": 0.991,
}  # of nine public matchers
PUBLISHED = "published: scan matching .258 +- .427, a Rao-Blackwellized filter with loop closing .061 +- .044"


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = [
        (
            name,
            percent(row["good_odometry"], 1),
            f"{percent(row['good'], 1)} [{100 * row['good_low']:.1f}, {100 * row['good_high']:.1f}]",
            percent(BEST_KNOWN.get(name), 1),
            f"{row['t_median']:.3f} m, {row['r_median_deg']:.2f} deg",
            percent(row["good_spoilt"], 1),
            f"{row['ms_median']:.1f}",
        )
        for name, row in figures.items()
        if name != "relations"
    ]
    lines = [
        prose(
            "Each scan is registered into the local map of those before it. Good is an error below 0.2 m and"
            " 3 degrees over a step of 0.5 m or 20 degrees; *best known* is the best of nine public matchers"
            " under this protocol."
        ),
        "",
        table(
            (
                "log",
                "odometry: good",
                "registered: good",
                "best known",
                "median error",
                "odometry spoilt by 30 %, 20 deg/m: registered, good",
                "ms a scan",
            ),
            rows,
        ),
    ]
    if relations := figures.get("relations"):
        lines += [
            "",
            prose(
                "Against the hand-checked relations of freiburg-079, all scans chained:"
                f" {relations['mean']:.3f} +- {relations['std']:.3f} m ({PUBLISHED})."
            ),
        ]
    return "\n".join(lines)
