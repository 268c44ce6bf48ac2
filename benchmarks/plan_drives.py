"""Drive in worlds made of real plans: by the plan itself, and by a photo of a copy by hand.

    python -m benchmarks plan_drives

The plans are the first ten by name, of those made by others, on which the program finds at least five rooms
that hang together, scraps not counted. For each drive a world is made of what was understood of the plan, as
the drawing table does: other proportions, furniture, doors that close, people. The robot begins in one room,
is told nothing, and is sent to another room by a click into its middle: once with the file itself, once with
a photo of a copy of the rooms that was drawn by hand (severity 0.3 of the ladder of deformation, in pen, seen
from one side, in bad light).

A drive has reached its goal if the robot stopped of its own accord in that room of the world. A copy that
cannot be read, or on which no way leads to the goal, counts as a drive that has not.
"""

import argparse
import fnmatch
import sys
import tempfile
import traceback
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import islice
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from benchmarks.lib.arguments import add_jobs, positive
from benchmarks.lib.data import DATA
from benchmarks.lib.hand_copies import copy_by_hand, save_photo, single_lines
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import number, prose, table
from pilotage.config import Settings
from pilotage.drives import Drive, navigate
from pilotage.errors import PilotageError
from pilotage.evaluation.deformation import Plan
from pilotage.evaluation.drive import Destination, score
from pilotage.io import open_map
from pilotage.maps import Atlas, Cell, CellGraph, CellSize, build_atlas
from pilotage.maps.routing.places import connected_cells
from pilotage.simulation import StartError
from pilotage.simulation.made_real import MadeReal, carried_cell, make_real, scale_of

PLANS = 10
LEAST_ROOMS = 5
COPY = 0.3
"""Severity of the copy by hand."""
SHORTEST = 4.0
"""Shortest way [m] that is worth driving."""
TIME_LIMIT = 300.0
"""Simulated time [s] of a drive."""
TRIES = 20
"""Worlds that are made until there is a way in one."""
FORMATS = (".svg", ".dxf", ".pdf", ".jpg", ".png", ".drawio", ".excalidraw")


@dataclass(frozen=True, eq=False)
class Errand:
    """To a room in a world made of a plan."""

    path: Path  # of the plan
    number: int
    made: MadeReal  # with the start
    goal: Cell
    shortest: float  # [m]


@dataclass(frozen=True, slots=True)
class Ended:
    """How a drive ended."""

    reached: bool
    reason: str
    collisions: int = 0


@dataclass(frozen=True, slots=True)
class Options:
    """How drives are made."""

    drives: int
    severity: float
    seed: int
    figure: Path | None


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose plans, and how they are driven."""
    parser.add_argument(
        "--only", metavar="PATTERN", default="*", help="plans, as in '*.dxf' (default: all ten)"
    )
    parser.add_argument("--drives", type=positive, default=2, help="for each plan (default: %(default)s)")
    parser.add_argument(
        "--severity", type=float, default=0.3, help="of the making of worlds, 0 to 1 (default: %(default)s)"
    )
    parser.add_argument("--seed", type=int, default=0, help="(default: %(default)s)")
    parser.add_argument("--figure", type=Path, help="folder for the photos, and a picture of every drive")
    add_jobs(parser)


def measure(arguments: argparse.Namespace) -> Figures:
    """Make all drives, print how each ended, and return the figures."""
    options = Options(arguments.drives, arguments.severity, arguments.seed, arguments.figure)
    if options.figure is not None:
        options.figure.mkdir(parents=True, exist_ok=True)
    figures: Figures = {}
    with ProcessPoolExecutor(arguments.jobs, mp_context=get_context("fork")) as pool:
        chosen = list(islice((path for path in every_plan() if is_suited(pool, path)), PLANS))
        names = [path for path in chosen if fnmatch.fnmatch(path.name, arguments.only)]
        for path, (by_file, by_photo) in zip(
            names, pool.map(partial(drive_all, options), names), strict=True
        ):
            figures[path.name] = row_of(by_file, by_photo)
            print(line_of(path.name, figures[path.name]), flush=True)
    if not figures:
        return {"failed": f"no plan fits {arguments.only}"}
    rows = list(figures.values())
    figures["mean"] = {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}
    print(line_of("mean", figures["mean"]))
    return figures


def every_plan() -> list[Path]:
    """List the plans of others by name."""
    return sorted(path for path in (DATA / "plans").iterdir() if path.suffix in FORMATS)


def is_suited(pool: ProcessPoolExecutor, path: Path) -> bool:
    """Tell whether enough rooms hang together on a plan."""
    return pool.submit(count_rooms, path).result() >= LEAST_ROOMS


def count_rooms(path: Path) -> int:
    """Count the rooms that hang together on a plan; none if it cannot be read."""
    try:
        graph = plan_atlas(path).cell_graph
    except PilotageError:
        return 0
    return len(rooms_of(graph)) if graph else 0


@cache
def plan_atlas(path: Path) -> Atlas:
    """Open a plan once in a process."""
    return open_atlas(path)


@cache
def plan_lines(path: Path) -> tuple[Plan, float]:
    """Reduce the rooms of a plan to single lines [m], and tell its scale [m per drawing unit]."""
    atlas = plan_atlas(path)
    assert atlas.cell_graph is not None
    metres_per_unit = scale_of(atlas, atlas.cell_graph)
    return single_lines(atlas.cell_graph, joined_cells(atlas.cell_graph), metres_per_unit), metres_per_unit


def open_atlas(path: Path) -> Atlas:
    """Open a drawing as the localizer sees it."""
    return build_atlas(open_map(path), Settings().localizer.atlas)


def joined_cells(graph: CellGraph) -> list[Cell]:
    """List the cells of the largest part that hangs together."""
    largest = max(connected_cells(graph), key=lambda ids: sum(graph.cell(one).polygon.area for one in ids))
    return [cell for cell in graph.cells if cell.cell_id in largest]


def rooms_of(graph: CellGraph) -> list[Cell]:
    """List those of them that are no scraps."""
    return [cell for cell in joined_cells(graph) if cell.size is not CellSize.SMALL]


def drive_all(options: Options, path: Path) -> tuple[list[Ended], list[Ended]]:
    """Make all drives in worlds of one plan: by the file, and by photos of copies."""
    by_file, by_photo = [], []
    for k in range(options.drives):
        errand = choose_errand(path, k, options)
        for mode, ends in (("file", by_file), ("photo", by_photo)):
            ended = drive_once(options, errand, mode)
            ends.append(ended)
            told = f"{path.name} {k} by {mode}: {ended.reason}, {ended.collisions} collisions"
            print(f"  {told}, to {errand.goal.cell_id}, {errand.shortest:.0f} m", flush=True)
    return by_file, by_photo


def choose_errand(path: Path, number: int, options: Options) -> Errand:
    """Make a world with a start and a goal in another room, between which a way leads; goals at random."""
    atlas, rng = plan_atlas(path), np.random.default_rng([options.seed, number])
    assert atlas.cell_graph is not None
    rooms = rooms_of(atlas.cell_graph)
    radius = Settings().simulator.body.radius
    for _ in range(TRIES):
        goal = rooms[int(rng.integers(len(rooms)))]
        try:
            made = make_real(atlas, options.severity, rng.spawn(1)[0], goal=goal.center, radius=radius)
        except StartError:
            continue
        assert made.world.start is not None
        end = made.proportions.world_from_sketch(np.array([goal.center]))[0]
        shortest = made.world.shortest_way(made.world.start.position, end, radius).length
        if SHORTEST <= shortest < np.inf:
            return Errand(path, number, made, goal, shortest)
    raise RuntimeError(f"no world with a way after {TRIES} tries")


def drive_once(options: Options, errand: Errand, mode: str) -> Ended:
    """Drive by the file or by a photo; an error is a goal that was not reached."""
    try:
        driven = by_drawing(options, errand, mode)
    except PilotageError as error:
        return Ended(reached=False, reason=f"refused: {error}")
    except Exception as error:  # noqa: BLE001  # whatever it is, the other drives go on
        print("".join(traceback.format_exception(error)), file=sys.stderr)
        return Ended(reached=False, reason=f"failed: {error}")
    point = errand.made.proportions.world_from_sketch(np.array([errand.goal.center]))[0]
    room = carried_cell(errand.goal, errand.made.proportions)
    scored = score(driven, Destination(tuple(point.tolist()), room, is_room=True), errand.shortest)
    reason = "reached" if scored.reached else f"{scored.outcome}: {scored.reason}, {scored.miss:.1f} m off"
    if options.figure is not None:
        name = f"{errand.path.name}-{errand.number}-{mode}"
        write_picture(options.figure / f"{name}.png", driven, errand, f"{name}: {reason}")
    return Ended(
        scored.reached, f"{reason}, {driven.minutes:.1f} min, lost {driven.times_lost} x", scored.collisions
    )


def by_drawing(options: Options, errand: Errand, mode: str) -> Drive:
    """Drive by the file, or make a copy by hand and drive by its photo."""
    atlas, seed = plan_atlas(errand.path), options.seed + errand.number
    if mode == "file":
        drawing, goal = atlas, atlas.sketch.file_from_sketch(np.array([errand.goal.center]))[0]
    else:
        lines, metres_per_unit = plan_lines(errand.path)
        copy = copy_by_hand(lines, errand.goal.cell_id, metres_per_unit, COPY, seed)
        goal = copy.photo_from_plan(np.array([errand.goal.center]))[0]
        with tempfile.TemporaryDirectory() as folder:
            photo = (options.figure or Path(folder)) / f"{errand.path.name}-{errand.number}.jpg"
            save_photo(copy, photo)
            drawing = open_atlas(photo)
    x, y = goal.tolist()
    settings = Settings()
    settings = replace(settings, navigator=replace(settings.navigator, time_limit=TIME_LIMIT))
    return navigate(drawing, errand.made.world, (x, y), seed=seed, settings=settings)


def write_picture(path: Path, driven: Drive, errand: Errand, title: str) -> None:
    """Draw a drive, and the room where it should end."""
    from matplotlib.patches import Polygon

    from pilotage.figures import style
    from pilotage.figures.drive import drive_figure

    figure = drive_figure(driven, title)
    room = carried_cell(errand.goal, errand.made.proportions)
    figure.axes[1].add_patch(Polygon(room.exterior.coords, facecolor="#dcebdc", edgecolor="none", zorder=0))
    style.save(figure, path)


def row_of(by_file: Sequence[Ended], by_photo: Sequence[Ended]) -> dict[str, float]:
    """Return the figures of one plan."""
    return {
        "reached": float(np.mean([ended.reached for ended in by_file])),
        "photo_reached": float(np.mean([ended.reached for ended in by_photo])),
        "collisions": sum(ended.collisions for ended in (*by_file, *by_photo)),
    }


def line_of(name: str, row: dict[str, float]) -> str:
    """Format the figures of a plan, or of the mean."""
    return f"{name:44}{row['reached']:8.2f}{row['photo_reached']:8.2f}{row['collisions']:6.1f}"


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = [
        (
            name if name == "mean" else f"`{name}`",
            number(row["reached"], 2),
            number(row["photo_reached"], 2),
            number(row["collisions"], 1),
        )
        for name, row in figures.items()
    ]
    return "\n".join(
        [
            prose(
                "A world is made of what is understood of a plan of others, with other proportions, furniture"
                " and people. The robot is told nothing and is sent to another room, by the file and by a"
                " photo of a copy of its rooms that a program drew as by hand. It has reached its goal if it"
                " stopped of its own accord in that room."
            ),
            "",
            table(("plan", "reached by the file", "by a photo of a hand copy", "collisions"), rows),
        ]
    )
