"""Carry belief along known ways, from a start that is marked, and print how far off it ends.

    python -m benchmarks tracking [--json FILE] [--buildings A,B] [--hands A,B] [--pairs N] [--seeds N]
        [--settings FILE] [--jobs N]

In the true worlds of six real buildings (worlds_from_logs.py) a robot takes the shortest way from room to
room and looks around every half metre; its motion is known as well as registration tells it. Belief begins
at the marked start and is weighed look by look: no search, no driving, nobody about. What is left is how
well hypotheses predict what is seen and how a drawing's proportions change along the way, so that a setting
of either (--settings, TOML) is judged on hundreds of walks in a minute.

A walk ends near if belief is within 1.5 m of the true place (carried over by the control points) or within
10 % of the room's longer side, as for a drive; "on the way" is the share of looks within 3 m. Intervals are
95 % bootstrap intervals over walks; seeds of one walk are averaged.
"""

import argparse
import json
import math
import os
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from multiprocessing import get_context

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from benchmarks.lib.arguments import add_drawings, positive
from benchmarks.lib.drives import Job, destination_of, sites
from benchmarks.lib.errands import Errand, choose_errands
from benchmarks.lib.sites import DATA, TUNED, Drawing, Site, real_site
from pilotage.config import Settings, read_settings
from pilotage.errors import PilotageError
from pilotage.evaluation.intervals import bootstrap_interval
from pilotage.geometry import Array, Pose2
from pilotage.io.files import write_text
from pilotage.localization import LocalizerSettings
from pilotage.localization.belief import Belief
from pilotage.localization.estimate import find_places
from pilotage.localization.placement import place_at
from pilotage.localization.proposals import propose_near
from pilotage.localization.tracking import predict, thin, weigh
from pilotage.localization.visibility import Look, VisibilityModel, look
from pilotage.simulation.laser import LaserSettings, sense

ALL_AROUND = LaserSettings(beams=361, field_of_view=math.tau * 360 / 361)
RADII = (0.4, 0.3, 0.2)  # [m] of the disc that takes the way: as far off the walls as there is space
PLACE, TURN = 0.01, 0.004  # [m, rad] deviations of registered motion
ON_THE_WAY = 3.0  # [m]

Row = dict[str, object]


@dataclass(frozen=True, eq=False)
class Walk:
    """What the robot sees on its way."""

    job: Job
    poses: tuple[Pose2, ...]  # world_from_base at each look
    motions: tuple[Pose2, ...]  # as registered, from look to look
    looks: tuple[Look, ...]


@dataclass(frozen=True, slots=True)
class Result:
    """How far off belief was on a walk."""

    job: Job
    miss: float  # [m] at the end
    near: float  # share of seeds that ended near
    on_the_way: float  # share of looks
    ms: float  # [ms] a look


def main() -> None:
    """Follow all walks and print the table."""
    arguments = parse()
    settings = arguments.settings
    jobs = []
    for building in arguments.buildings:
        sites[building] = site = real_site(building)
        errands = choose_errands(site, arguments.pairs, seed=1)
        jobs += [
            Job("tracking", building, hand, number, errand)
            for hand in arguments.hands
            for number, errand in enumerate(errands)
        ]
    follow(jobs[0], 1, settings.localizer)  # compiles what is compiled, once
    with ProcessPoolExecutor(arguments.jobs, mp_context=get_context("fork")) as pool:
        work = partial(follow, seeds=arguments.seeds, settings=settings.localizer)
        results = list(pool.map(work, jobs, chunksize=4))
    print(f"{'':24s} walks             near  miss [m]  on the way    ms")
    rows = {
        hand: hand_rows(hand, [one for one in results if one.job.hand == hand]) for hand in arguments.hands
    }
    print(f"  t: defaults were tuned on {', '.join(TUNED)}; the other buildings were held back")
    if arguments.json:
        write_text(arguments.json, json.dumps(rows, indent=1) + "\n")


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add_drawings(parser)
    parser.add_argument("--pairs", type=positive, default=24, help="walks a drawing (default: %(default)s)")
    parser.add_argument("--seeds", type=positive, default=1, help="runs of each walk (default: %(default)s)")
    parser.add_argument("--settings", type=settings_of, default=Settings(), help="a file of settings, TOML")
    parser.add_argument("--jobs", type=positive, default=2, help="processes (default: %(default)s)")
    arguments = parser.parse_args()
    if not DATA.is_dir():
        parser.error("the data folder is not there: ../shared/data beside the repository")
    return arguments


def settings_of(path: str) -> Settings:
    """Read settings; what is wrong with them is told in one line."""
    try:
        return read_settings(path)
    except PilotageError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def follow(job: Job, seeds: int, settings: LocalizerSettings) -> Result:
    """Carry belief along one walk, once for each seed."""
    site = sites[job.site]
    drawing, walk = site.drawing_by[job.hand], walk_of(job, site, settings)
    began = time.process_time()
    misses = np.array([misses_of(walk, drawing, settings, seed) for seed in range(seeds)])
    ms = 1e3 * (time.process_time() - began) / misses.size
    near = misses[:, -1] <= destination_of(job).tolerance
    return Result(
        job, float(np.median(misses[:, -1])), float(near.mean()), float(np.mean(misses <= ON_THE_WAY)), ms
    )


def walk_of(job: Job, site: Site, settings: LocalizerSettings) -> Walk:
    """Take the shortest way of an errand, and look around wherever belief is to be weighed."""
    rng = np.random.default_rng(job.number)
    poses = poses_along(way_of(job.errand, site), settings)
    truly = [first.inverse() @ then for first, then in pairwise(poses)]
    motions = [
        Pose2(
            motion.x + PLACE * rng.standard_normal(),
            motion.y + PLACE * rng.standard_normal(),
            motion.theta + TURN * rng.standard_normal(),
        )
        for motion in truly
    ]
    scans = [sense(site.world, pose, float(index), rng, ALL_AROUND) for index, pose in enumerate(poses)]
    looks = tuple(look(scan, settings.visibility) for scan in scans)
    return Walk(job, tuple(poses), tuple(motions), looks)


def way_of(errand: Errand, site: Site) -> Array:
    """Find the shortest way [m], as far off the walls as there is space for."""
    ways = (site.world.shortest_way(errand.start.position, errand.goal, radius).points for radius in RADII)
    return next(way for way in ways if len(way) > 0)


def poses_along(way: Array, settings: LocalizerSettings) -> list[Pose2]:
    """Stand where belief is to be weighed on a way (n, 2) [m], the look ahead."""
    lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(way, axis=0).T))])

    def at(length: Array) -> Array:
        return np.column_stack([np.interp(length, lengths, way[:, axis]) for axis in (0, 1)])

    steps = np.arange(0.0, lengths[-1], settings.step / 2.0)
    ahead = at(np.minimum(steps + 0.4, lengths[-1])) - at(np.maximum(steps - 0.1, 0.0))
    headings = np.arctan2(ahead[:, 1], ahead[:, 0])
    poses: list[Pose2] = []
    for (x, y), heading in zip(at(steps).tolist(), headings.tolist(), strict=True):
        pose = Pose2(x, y, heading)
        if not poses or settings.is_due(poses[-1].inverse() @ pose):
            poses.append(pose)
    return poses


def misses_of(walk: Walk, drawing: Drawing, settings: LocalizerSettings, seed: int) -> Array:
    """Measure how far off belief is at each look of a walk, (n,) [m]."""
    rng = np.random.default_rng([seed, walk.job.number])
    atlas, tracking, estimate = drawing.atlas, settings.tracking, replace(settings.estimate, hypotheses=1)
    model = VisibilityModel(atlas, settings.visibility)
    start = drawing.warp.sketch_from_base(walk.poses[0]).pose
    count = settings.incumbent.count
    belief = Belief(propose_near(start, atlas, tracking.prior, count, rng), np.zeros(count))
    misses = []
    for index, (pose, seen) in enumerate(zip(walk.poses, walk.looks, strict=True)):
        news = 1.0
        if index > 0:
            motion = walk.motions[index - 1]
            belief = predict(belief, motion, atlas, tracking, rng)
            news = settings.news_in(motion)
        belief = thin(weigh(belief, seen, model, news=news), tracking, rng)
        at = find_places(belief, atlas, estimate)[0].sketch_from_base.pose
        placed = place_at(belief, (at.x, at.y), estimate.jump).position
        misses.append(miss_of(np.array(placed), pose, drawing))
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


def hand_rows(hand: str, results: Sequence[Result]) -> Row:
    """Print the lines of a hand, building by building, and return its figures."""
    buildings = {}
    for building in dict.fromkeys(one.job.site for one in results):
        mark = "t" if building in TUNED else " "
        buildings[building] = row_of(
            f"{mark} {building}", [one for one in results if one.job.site == building]
        )
    row = {**row_of(f"  {hand}, all", results), "buildings": buildings}
    for name, is_tuned in (("tuned", True), ("held_back", False)):
        part = [one for one in results if (one.job.site in TUNED) == is_tuned]
        if part:
            row[name] = row_of(f"  {hand}, {name.replace('_', ' ')}", part)
    return row


def row_of(title: str, results: Sequence[Result]) -> Row:
    """Print one line of the table and return its figures."""
    near = [one.near for one in results]
    low, high = bootstrap_interval(near, np.random.default_rng(0))
    row: Row = {
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


if __name__ == "__main__":
    main()
