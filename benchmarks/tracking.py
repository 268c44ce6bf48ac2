"""Keep track along known ways from a start that is marked, and tell how far off the robot ends.

    python -m benchmarks tracking

In the true worlds of six real buildings (worlds_from_logs) a robot is led along the shortest way from room to
room, a scan every quarter metre; nobody drives, nobody is about. It is told its start on the drawing. What is
left is how well the sensor model and the motion model follow a drawing whose proportions change on the way:
a setting (--settings, TOML) is judged on hundreds of walks.

A walk ends near if the estimate is within 1.5 m of the true place (carried over by the control points) or
within 10 % of the room's longer side, as for a drive; "on the way" is the share of scans within 3 m.
Intervals are 95 % bootstrap intervals over walks; seeds of one walk are averaged.
"""

import argparse
import math
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from multiprocessing import get_context

import numpy as np

from benchmarks.lib.arguments import add_drawings, add_jobs, positive
from benchmarks.lib.data import TUNED
from benchmarks.lib.drives import Job, destination_of, sites
from benchmarks.lib.errands import Errand, choose_errands
from benchmarks.lib.results import Figures
from benchmarks.lib.sites import Drawing, Site, real_site
from benchmarks.lib.tables import percent, percent_in, prose, table
from pilotage.config import Settings, read_settings
from pilotage.errors import PilotageError
from pilotage.evaluation.intervals import bootstrap_interval
from pilotage.geometry import Array, Pose2
from pilotage.localization import Localizer, LocalizerSettings
from pilotage.perception import LaserScan, Odometry
from pilotage.simulation.laser import LaserSettings, sense

ALL_AROUND = LaserSettings(beams=361, field_of_view=math.tau * 360 / 361)
RADII = (0.4, 0.3, 0.2)  # [m] of the disc that takes the way: as far off the walls as there is space
STEP = 0.25  # [m] between scans
PLACE, TURN = 0.01, 0.004  # [m, rad] standard deviations of odometry, a step
ON_THE_WAY = 3.0  # [m]


@dataclass(frozen=True, eq=False)
class Walk:
    """What the robot reads on its way."""

    poses: tuple[Pose2, ...]  # world_from_base at each scan
    scans: tuple[LaserScan, ...]
    odometry: tuple[Odometry, ...]


@dataclass(frozen=True, slots=True)
class Result:
    """How far off the estimate was on a walk."""

    job: Job
    miss: float  # [m] at the end
    near: float  # share of seeds that ended near
    on_the_way: float  # share of scans
    ms: float  # [ms] a scan


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose walks and settings."""
    add_drawings(parser)
    parser.add_argument("--pairs", type=positive, default=16, help="walks a drawing (default: %(default)s)")
    parser.add_argument("--seeds", type=positive, default=1, help="runs of each walk (default: %(default)s)")
    parser.add_argument("--settings", type=settings_of, help="a file of settings, TOML")
    add_jobs(parser)


def measure(arguments: argparse.Namespace) -> Figures:
    """Follow all walks, print the table, and return the figures."""
    settings = (arguments.settings or Settings()).localizer
    jobs = []
    for building in arguments.buildings:
        sites[building] = site = real_site(building)
        errands = choose_errands(site, arguments.pairs, seed=1)
        jobs += [
            Job("tracking", building, hand, number, errand)
            for hand in arguments.hands
            for number, errand in enumerate(errands)
        ]
    with ProcessPoolExecutor(arguments.jobs, mp_context=get_context("fork")) as pool:
        work = partial(walk, seeds=arguments.seeds, settings=settings)
        results = list(pool.map(work, jobs, chunksize=4))
    print(f"{'':24s} walks             near  miss [m]  on the way    ms")
    rows = {
        hand: hand_rows(hand, [one for one in results if one.job.hand == hand]) for hand in arguments.hands
    }
    print(f"  t: defaults were tuned on {', '.join(TUNED)}; the other buildings are held out")
    return rows


def settings_of(path: str) -> Settings:
    """Read settings; what is wrong with them is told in one line."""
    try:
        return read_settings(path)
    except PilotageError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def walk(job: Job, seeds: int, settings: LocalizerSettings) -> Result:
    """Localize along one walk, once for each seed."""
    site = sites[job.site]
    drawing, walked = site.drawing_by[job.hand], walk_of(job, site)
    began = time.process_time()
    misses = np.array([misses_of(walked, drawing, settings, seed) for seed in range(seeds)])
    ms = 1e3 * (time.process_time() - began) / misses.size
    near = misses[:, -1] <= destination_of(job).tolerance
    return Result(
        job, float(np.median(misses[:, -1])), float(near.mean()), float(np.mean(misses <= ON_THE_WAY)), ms
    )


def walk_of(job: Job, site: Site) -> Walk:
    """Take the shortest way of an errand, a scan a step."""
    rng = np.random.default_rng(job.number)
    poses = poses_along(way_of(job.errand, site))
    odom_from_base = [Pose2.identity()]
    for first, then in pairwise(poses):
        motion = first.inverse() @ then
        noisy = Pose2(
            motion.x + PLACE * rng.standard_normal(),
            motion.y + PLACE * rng.standard_normal(),
            motion.theta + TURN * rng.standard_normal(),
        )
        odom_from_base.append(odom_from_base[-1] @ noisy)
    return Walk(
        tuple(poses),
        tuple(sense(site.world, pose, float(k), rng, ALL_AROUND) for k, pose in enumerate(poses)),
        tuple(Odometry(float(k), pose) for k, pose in enumerate(odom_from_base)),
    )


def way_of(errand: Errand, site: Site) -> Array:
    """Find the shortest way [m], as far off the walls as there is space for."""
    ways = (site.world.shortest_way(errand.start.position, errand.goal, radius).points for radius in RADII)
    return next(way for way in ways if len(way) > 0)


def poses_along(way: Array) -> list[Pose2]:
    """Stand a step apart on a way (n, 2) [m], looking ahead."""
    lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(way, axis=0).T))])

    def at(length: Array) -> Array:
        return np.column_stack([np.interp(length, lengths, way[:, axis]) for axis in (0, 1)])

    steps = np.arange(0.0, lengths[-1], STEP)
    ahead = at(np.minimum(steps + 0.4, lengths[-1])) - at(np.maximum(steps - 0.1, 0.0))
    headings = np.arctan2(ahead[:, 1], ahead[:, 0])
    return [
        Pose2(x, y, heading) for (x, y), heading in zip(at(steps).tolist(), headings.tolist(), strict=True)
    ]


def misses_of(walked: Walk, drawing: Drawing, settings: LocalizerSettings, seed: int) -> Array:
    """Measure how far off the estimate is at each scan of a walk, (n,) [m]."""
    sketch = drawing.atlas.sketch
    marked = drawing.warp.sketch_from_base(walked.poses[0]).pose
    x, y = sketch.file_from_sketch(np.array([marked.position]))[0].tolist()
    localizer = Localizer(drawing.atlas, settings, seed=seed, start=(x, y, marked.theta))
    misses = []
    for pose, scan, odometry in zip(walked.poses, walked.scans, walked.odometry, strict=True):
        estimate = localizer.update(scan, odometry)
        placed = sketch.sketch_from_file(np.array([(estimate.x, estimate.y)]))[0]
        misses.append(miss_of(placed, pose, drawing))
    return np.array(misses)


def miss_of(placed: Array, world_from_base: Pose2, drawing: Drawing) -> float:
    """Measure how far a place (2,) of the drawing is from where the robot truly stands [m].

    In the proportions that the drawing has there: a place drawn elsewhere may not be in the building at all.
    """
    step = 0.01  # [m]
    points = world_from_base.position + step * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    here, ahead, aside = drawing.warp.sketch_from_world(points)
    linear = np.column_stack([ahead - here, aside - here]) / step  # drawing units per metre
    return float(np.hypot(*np.linalg.solve(linear, placed - here)))


def hand_rows(hand: str, results: Sequence[Result]) -> Figures:
    """Print the lines of a hand, building by building, and return its figures."""
    buildings = {}
    for building in dict.fromkeys(one.job.site for one in results):
        mark = "t" if building in TUNED else " "
        buildings[building] = row_of(
            f"{mark} {building}", [one for one in results if one.job.site == building]
        )
    row = {**row_of(f"  {hand}, all", results), "buildings": buildings}
    for name, is_tuned in (("tuned", True), ("held_out", False)):
        part = [one for one in results if (one.job.site in TUNED) == is_tuned]
        if part:
            row[name] = row_of(f"  {hand}, {name.replace('_', ' ')}", part)
    return row


def row_of(title: str, results: Sequence[Result]) -> Figures:
    """Print one line of the table and return its figures."""
    near = [one.near for one in results]
    low, high = bootstrap_interval(near, np.random.default_rng(0))
    row: Figures = {
        "walks": len(results),
        "near": float(np.mean(near)),
        "near_interval": (low, high),
        "miss_median": float(np.median([one.miss for one in results])),
        "on_the_way": float(np.mean([one.on_the_way for one in results])),
        "ms": float(np.mean([one.ms for one in results])),
    }
    print(
        f"{title:24s}{len(results):6d}  {row['near']:.2f} [{low:.2f}, {high:.2f}]{row['miss_median']:8.2f}"
        f"{row['on_the_way']:12.2f}{row['ms']:6.1f}",
        flush=True,
    )
    return row


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = [
        (
            f"`{hand}`",
            str(row["walks"]),
            percent_in(row["near"], row["near_interval"]),
            percent(row["held_out"]["near"]) if "held_out" in row else "-",
            f"{row['miss_median']:.2f} m",
            percent(row["on_the_way"]),
        )
        for hand, row in figures.items()
    ]
    return "\n".join(
        [
            prose(
                "A robot that is told its start is led from room to room; it ends near if its estimate is"
                " within 1.5 m of the true place, or within 10 % of the room's longer side."
            ),
            "",
            table(
                (
                    "drawings",
                    "walks",
                    "ends near",
                    "of these in held-out buildings",
                    "off at the end, median",
                    "scans within 3 m",
                ),
                rows,
            ),
        ]
    )
