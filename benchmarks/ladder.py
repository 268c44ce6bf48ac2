"""Localize on drawings in people's manner, from true to as people draw, and tell how often the room is right.

    python -m benchmarks ladder

The true plan of a building, as `draftsman` drew it, is deformed: proportions room by room, doors, what is
left out, and the hand itself (`pilotage.evaluation.deformation`). At severity 1 it is as far from the truth
as drawings by people are. Each drawing of each person gets the episodes of `localization`: 40 m of a log,
nothing told. `--hands` adds drawings by other hands. `--true-warp` localizes once more on each drawing with
the true warp taken out by its control points: what is lost there is lost by what the drawing leaves out, adds
or moves, and the rest by its proportions. `--statistics` only measures the drawings at severity 1 beside
those by people and by the other hands, by the same code; `--figure` writes a picture of one building at six
severities.
"""

import argparse
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from benchmarks.lib.arguments import add_jobs, add_names, names_of, positive
from benchmarks.lib.data import BUILDINGS, HANDS, LOGS, PEOPLE, TUNED, drawing_of, drawings, folder_of
from benchmarks.lib.protocols import Followed, Task, follow_all
from benchmarks.lib.results import Figures, mean_of
from benchmarks.lib.rungs import plan_of, rung_name, straight_name
from benchmarks.lib.tables import percent, prose, table
from pilotage.evaluation.deformation import Plan, Statistics, deform, read_plan, statistics_of
from pilotage.evaluation.episodes import score
from pilotage.evaluation.rooms import read_world_rooms
from pilotage.io.tum import read_trajectory

SEVERITIES = (0.5, 1.0)
SHOWN = (0.0, 0.25, 0.5, 0.75, 1.0, 1.25)
SHOWN_BUILDING = "csail"
PERSONS, EPISODES = 1, 3
HELD_OUT = tuple(building for building in BUILDINGS if building not in TUNED)
WITH_TRUE_WARP = "true_warp_"
SCORES = {
    "room_end": ("room at end", 12),
    "room_last10": ("last 10 m", 11),
    "confident_wrong": ("sure+wrong", 12),
}
KNOWN_OF_PEOPLE = {
    "scale_p10": "0.64",
    "scale_p90": "1.55",
    "stretch_median": "1.7 to 1.9",
    "stretch_p90": "2.7 to 3.9",
    "similarity_miss": "1.7 to 4",
    "crossing": "0.01 to 0.04",
    "undrawn": "up to 0.14",
    "rooms_missing": "up to 0.25",
    "shortening": "-",
}
"""What was measured of drawings by people that are not among the data, for comparison."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose rungs."""
    parser.add_argument(
        "--severities",
        type=severities,
        default=",".join(map(str, SEVERITIES)),
        help="(default: %(default)s)",
    )
    add_names(parser, "--buildings", BUILDINGS)
    parser.add_argument(
        "--people", type=positive, default=PERSONS, help="drawings of each (default: %(default)s)"
    )
    parser.add_argument(
        "--episodes", type=positive, default=EPISODES, help="for each drawing (default: %(default)s)"
    )
    parser.add_argument(
        "--hands", type=names_of((*HANDS, *PEOPLE)), default=[], help="other drawings (default: none)"
    )
    parser.add_argument("--true-warp", action="store_true", help="localize on straightened drawings as well")
    parser.add_argument("--statistics", action="store_true", help="only measure the drawings")
    parser.add_argument("--figure", type=Path, help="only draw one building at six severities")
    add_jobs(parser)


def severities(text: str) -> list[float]:
    """Read severities separated by commas."""
    try:
        values = [float(word) for word in text.split(",")]
    except ValueError:
        values = [-1.0]
    if not all(0.0 <= value <= max(SHOWN) for value in values):
        raise argparse.ArgumentTypeError(f"must be numbers from 0 to {max(SHOWN)}, got {text}")
    return values


def measure(arguments: argparse.Namespace) -> Figures:
    """Run all episodes, or only measure or draw; return the figures."""
    if arguments.figure:
        draw_strip(arguments.figure)
        return {}
    persons = range(arguments.people)
    if arguments.statistics:
        return {"statistics": measure_drawings(arguments.buildings, persons)}
    rungs = rungs_of(arguments)
    tasks = [
        Task(building, way, arguments.episodes)
        for rung in rungs.values()
        for building, hands in rung.items()
        for way in ways_of(hands, true_warp=arguments.true_warp)
    ]
    stream = follow_all(tasks, arguments.jobs, reuse=False)
    print(head(true_warp=arguments.true_warp))
    rows: Figures = {}
    for name, rung in rungs.items():
        row: Figures = {}
        for building, hands in rung.items():
            row[building] = summarize([next(stream) for _ in hands])
            if arguments.true_warp:
                straight = summarize([next(stream) for _ in hands])
                row[building] |= {f"{WITH_TRUE_WARP}{key}": value for key, value in straight.items()}
            print(line(name, building, row[building]), flush=True)
        row["mean"] = mean_of(list(row.values()))
        print(line(name, "mean", row["mean"]), flush=True)
        rows[name] = row
    return rows


def rungs_of(arguments: argparse.Namespace) -> dict[str, dict[str, list[str]]]:
    """List the hands of each building, by severity and then by the names of other hands."""
    rungs = {
        f"{severity:g}": {
            building: [rung_name(severity, person) for person in range(arguments.people)]
            for building in arguments.buildings
        }
        for severity in arguments.severities
    }
    others = {
        hand: {building: [hand] for building, _ in drawings(arguments.buildings, [hand])}
        for hand in arguments.hands
    }
    return rungs | {hand: rung for hand, rung in others.items() if rung}


def ways_of(hands: Sequence[str], *, true_warp: bool) -> list[str]:
    """List drawings as they are, then straightened if that is wanted."""
    return [*hands, *(straight_name(hand) for hand in hands if true_warp)]


def head(*, true_warp: bool) -> str:
    """Name the columns."""
    cells = "".join(f"{title:>{width}s}" for title, width in SCORES.values())
    beside = f"{'| true warp taken out:':>23s}{cells}" if true_warp else ""
    return f"{'drawing':10s} {'building':13s}{cells}{beside}"


def line(name: str, building: str, row: Figures) -> str:
    """Format the figures of a building on a rung, or of the mean."""
    text = f"{name:10s} {building:13s}"
    for prefix, gap in (("", ""), (WITH_TRUE_WARP, f"{'|':>2s}{'':21s}")):
        if f"{prefix}room_end" in row:
            cells = [f"{row[f'{prefix}{key}']:{width}.3f}" for key, (_, width) in SCORES.items()]
            text += gap + "".join(cells)
    return text


def summarize(followed: Sequence[Followed]) -> Figures:
    """Average the scores of all episodes that count."""
    scores = [score(trace) for one in followed for trace in one.traces if trace.counted.any()]
    return {
        "room_end": float(np.mean([one.right_at_end for one in scores])),
        "room_last10": float(np.mean([one.right_last for one in scores])),
        "confident_wrong": float(np.mean([one.sure_and_wrong for one in scores])),
    }


def render(figures: Figures) -> str:
    """Write README's table of means over buildings."""
    rows = [
        (
            name,
            percent(row["mean"]["room_end"]),
            percent(mean_of([row[one] for one in HELD_OUT if one in row])["room_end"]),
            percent(row["mean"]["room_last10"]),
            percent(row["mean"]["confident_wrong"], 1),
        )
        for name, row in figures.items()
    ]
    head = (
        "severity",
        "right room at the end",
        "held-out buildings",
        "in the last 10 m",
        "sure (> .9) and wrong",
    )
    return "\n".join(
        [
            prose(
                "True plans of the six buildings, deformed as people deform them; severity 1 is as people"
                " draw. The robot travels 40 m in the logs and is told nothing. There is one drawing of each:"
                " the figures are rough."
            ),
            "",
            table(head, rows),
        ]
    )


def measure_drawings(buildings: Sequence[str], persons: Sequence[int]) -> Figures:
    """Print how far drawings at severity 1 are from the truth, beside drawings by people and other hands."""
    columns = {
        "ladder": mean_of(
            [
                asdict(drawing_statistics(deform(plan_of(building), 1.0, person), building, "draftsman"))
                for building in buildings
                for person in persons
            ]
        )
    }
    for hand in (*PEOPLE, *HANDS):
        own = [building for building, _ in drawings(buildings, [hand])]
        plans = {building: read_plan(drawing_of(building, hand)) for building in own}
        measured = [asdict(drawing_statistics(plan, building, hand)) for building, plan in plans.items()]
        if measured:
            columns[hand] = mean_of(measured)
    print(f"{'':16s}{''.join(f'{name:>11s}' for name in columns)}{'people':>14s}")
    for name, known in KNOWN_OF_PEOPLE.items():
        values = "".join(f"{column[name]:11.2f}" for column in columns.values())
        print(f"{name:16s}{values}{known:>14s}")
    return columns


def drawing_statistics(plan: Plan, building: str, hand: str) -> Statistics:
    """Measure a drawing along the way of the log."""
    way = read_trajectory(LOGS / f"{building}.truth.tum").poses[:, :2]
    return statistics_of(plan, way, read_world_rooms(folder_of(building, hand) / "rooms.geojson"))


def draw_strip(path: Path) -> None:
    """Draw one building at six severities."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(SHOWN), figsize=(3.0 * len(SHOWN), 3.2), layout="constrained")
    for axis, severity in zip(axes, SHOWN, strict=True):
        for line in deform(plan_of(SHOWN_BUILDING), severity, 1).strokes.geoms:
            axis.plot(*line.xy, color="black", linewidth=0.8)
        axis.set(aspect="equal", title=f"{severity:g}")
        axis.axis("off")
    figure.savefig(path)
    plt.close(figure)
    print(f"drew {path}")
