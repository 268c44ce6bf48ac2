"""Localize a simulated robot on thirteen people's sketches of one building, and drive it by them.

    python -m benchmarks people

The building is the true plan of the sketches, at 0.1 m a pixel; a robot with 360 beams drives from place to
place in it. Each sketch gets the same episodes of 40 m, nothing told. A place is right if the region of the
sketch where it is claimed is matched with the region where the robot is: the region of a place is that of the
nearest centre in a straight line, among the centres that the data set matches, on the sketch and on the plan.
`most` is the share of scans in the largest region: what a robot gets that always says so. Drives lead from
one region to the centre of another; a drive has reached it if the robot says so and is in that region.
"""

import argparse
from collections import Counter

import numpy as np

from benchmarks.lib.arguments import add_jobs, add_names, positive
from benchmarks.lib.people import FOLDER, SKETCHED, SKETCHES, places, read_matches, regions_of, world
from benchmarks.lib.protocols import Followed, Task, follow_all, sketch_of, travel_of
from benchmarks.lib.results import Figures, mean_of
from benchmarks.lib.tables import percent, prose, table
from pilotage.drives import navigate
from pilotage.errors import PilotageError
from pilotage.evaluation.episodes import score
from pilotage.geometry import Pose2
from pilotage.navigation import Outcome

EPISODES = 4


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose sketches, episodes and drives."""
    add_names(parser, "--sketches", SKETCHES)
    parser.add_argument(
        "--episodes", type=positive, default=EPISODES, help="for each sketch (default: %(default)s)"
    )
    parser.add_argument("--drives", type=int, default=1, help="for each sketch (default: %(default)s)")
    add_jobs(parser)


def measure(arguments: argparse.Namespace) -> Figures:
    """Run all episodes and drives, print a line for each sketch, and return the figures."""
    tasks = [Task(SKETCHED, number, arguments.episodes) for number in arguments.sketches]
    print(f"{'sketch':8s}{'region at end':>14s}{'most':>7s}{'sure+wrong':>12s}{'reached':>9s}")
    rows: Figures = {}
    for followed in follow_all(tasks, arguments.jobs, reuse=False):
        number = followed.task.hand
        rows[number] = summarize(followed)
        if arguments.drives > 0:
            rows[number]["reached"] = float(np.mean([reaches(number, k) for k in range(arguments.drives)]))
        print(line(number, rows[number]), flush=True)
    rows["mean"] = mean_of(list(rows.values()))
    print(line("mean", rows["mean"]))
    return rows


def summarize(followed: Followed) -> Figures:
    """Return the figures of one sketch."""
    scores = [score(trace) for trace in followed.traces]
    truths = Counter(travel_of(SKETCHED, followed.task.hand).truths)
    return {
        "region_end": float(np.mean([one.right_at_end for one in scores])),
        "most": max(truths.values()) / truths.total(),
        "confident_wrong": float(np.mean([one.sure_and_wrong for one in scores])),
    }


def reaches(number: str, seed: int) -> bool:
    """Drive from somewhere to the centre of another region of a sketch."""
    rng = np.random.default_rng(seed)
    on_sketch, in_world = regions_of(number)
    start = places(1, rng)
    x, y = start[0].tolist()
    others = sorted(set(on_sketch.names) - set(in_world.names_at(start)))
    goal_name = others[int(rng.integers(len(others)))]
    try:
        driven = navigate(
            sketch_of(SKETCHED, number).atlas,
            world(),
            centre_of(number, goal_name),
            world_start=Pose2(x, y, float(rng.uniform(-np.pi, np.pi))),
            seed=seed,
        )
    except PilotageError as error:  # the sketch leads nowhere from there
        print(f"{number}: {error}")
        return False
    ended = in_world.names_at(driven.positions[-1:])[0]
    return driven.outcome is Outcome.REACHED and ended == goal_name


def centre_of(number: str, name: str) -> tuple[float, float]:
    """Return the first centre of a region on a sketch, in pixels of its file."""
    centres, _ = read_matches(FOLDER / f"gt_{number}_model_simple.dat")
    x, y = centres[name][0].tolist()
    return x, y


def line(number: str, row: Figures) -> str:
    """Format the figures of one sketch, or of the mean."""
    reached = f"{row['reached']:9.2f}" if "reached" in row else f"{'-':>9s}"
    return f"{number:8s}{row['region_end']:14.2f}{row['most']:7.2f}{row['confident_wrong']:12.3f}{reached}"


def render(figures: Figures) -> str:
    """Write README's table: the mean, and the best and worst sketch."""
    sketches = {name: row for name, row in figures.items() if name != "mean"}
    order = sorted(sketches, key=lambda name: sketches[name]["region_end"])
    names = {
        "mean": f"{len(sketches)} sketches",
        order[-1]: f"best, {order[-1]}",
        order[0]: f"worst, {order[0]}",
    }
    rows = []
    for name, title in names.items():
        row = figures[name]
        shares = (row["region_end"], row["most"], row.get("reached"))
        rows.append((title, *map(percent, shares), percent(row["confident_wrong"], 1)))
    head = (
        "drawings",
        "right region at the end",
        "largest region",
        "drives that reached",
        "sure (> .9) and wrong",
    )
    return "\n".join(
        [
            prose(
                "A simulated robot travels 40 m in a building that thirteen people have sketched, and is told"
                " nothing. Who always names the largest region is right as often as the third column says."
            ),
            "",
            table(head, rows),
        ]
    )
