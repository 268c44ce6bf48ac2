"""Episodes of real logs on drawings, and a store of their traces: several benchmarks share one run."""

import json
import time
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import platformdirs

from benchmarks.lib import people
from benchmarks.lib.data import LOGS, ROOT, drawing_of, folder_of
from benchmarks.lib.results import commit_of
from benchmarks.lib.rungs import STRAIGHT, is_rung, is_straight, rung_of, straight_of
from pilotage.evaluation.episodes import Trace, follow, spread_episodes, way_along
from pilotage.evaluation.rooms import Rooms, read_drawn_rooms, read_world_rooms
from pilotage.evaluation.trajectory import associate
from pilotage.geometry import Array
from pilotage.io import open_log, open_map
from pilotage.io.files import write_text
from pilotage.io.tum import read_trajectory
from pilotage.localization import Localizer
from pilotage.maps import Atlas, AtlasSettings, build_atlas
from pilotage.perception import Reading

LENGTH = 40.0  # [m] of an episode
STORE = platformdirs.user_cache_path("pilotage") / "traces"


@dataclass(frozen=True, eq=False)
class Travel:
    """A real log with the truth about it."""

    readings: tuple[Reading, ...]
    positions: Array  # (n, 2) [m]
    truths: tuple[str, ...]  # true room of each scan, empty in none
    way: Array  # (n,) [m]


@dataclass(frozen=True, eq=False)
class Sketch:
    """A drawing, ready for localizers."""

    atlas: Atlas
    rooms: Rooms  # as drawn
    atlas_s: float  # [s] that the atlas took


@dataclass(frozen=True, slots=True)
class Task:
    """Episodes of the log of one building on the drawing of one, mostly the same, building."""

    building: str
    hand: str
    count: int
    drawing: str = ""  # building of the drawing; empty for the same
    length: float = LENGTH  # [m] of an episode

    @property
    def file(self) -> str:
        """Name in the store."""
        drawing = f"{self.drawing or self.building}-{self.hand}"
        return f"{self.building}-on-{drawing}-{self.count}-{self.length:.0f}m.json"


@dataclass(frozen=True, eq=False)
class Followed:
    """The result of a task."""

    task: Task
    traces: tuple[Trace, ...]
    atlas_s: float


@cache
def travel_of(building: str, hand: str) -> Travel:
    """Read the log of a building; its rooms are divided as in the truth about the drawing."""
    if building == people.SKETCHED:
        readings, positions = people.run()
        truths = people.regions_of(hand)[1].names_at(positions)
        return Travel(readings, positions, truths, way_along(positions))
    log = open_log(LOGS / f"{building}.log.gz")
    truth = read_trajectory(LOGS / f"{building}.truth.tum")
    stamps = np.array([reading.scan.stamp for reading in log])
    positions = truth.poses[associate(stamps, truth), :2]
    rooms = read_world_rooms(folder_of(building, hand.removeprefix(STRAIGHT)) / "rooms.geojson")
    return Travel(tuple(log.readings), positions, rooms.names_at(positions), way_along(positions))


@cache
def sketch_of(building: str, hand: str) -> Sketch:
    """Read a drawing, or make it if it is one of the ladder."""
    if is_rung(hand) or is_straight(hand):
        plan = straight_of(building, hand) if is_straight(hand) else rung_of(building, hand)
        drawing, rooms = plan.sketch, plan.rooms
    elif building == people.SKETCHED:
        drawing, rooms = open_map(people.FOLDER / f"{hand}.png"), people.regions_of(hand)[0]
    else:
        path = drawing_of(building, hand)
        drawing, rooms = open_map(path), read_drawn_rooms(path.with_suffix(".json"))
    began = time.perf_counter()
    atlas = build_atlas(drawing, AtlasSettings())
    return Sketch(atlas, rooms, time.perf_counter() - began)


def follow_task(task: Task) -> Followed:
    """Localize along the episodes of a task; nothing is told of the start."""
    travel, sketch = travel_of(task.building, task.hand), sketch_of(task.drawing or task.building, task.hand)
    truths = travel.truths if task.drawing in {"", task.building} else ("",) * len(travel.truths)
    traces = []
    for seed, episode in enumerate(spread_episodes(travel.positions, task.count, task.length)):
        chosen = slice(episode.first, episode.last + 1)
        localizer = Localizer(sketch.atlas, seed=seed)
        traces.append(
            follow(localizer, travel.readings[chosen], truths[chosen], travel.way[chosen], sketch.rooms)
        )
    return Followed(task, tuple(traces), sketch.atlas_s)


def follow_all(tasks: Sequence[Task], jobs: int, *, reuse: bool) -> Iterator[Followed]:
    """Follow tasks in their order, in several processes.

    `reuse` takes traces of the same commit from the store. Traces of code with changes that are not
    committed are never stored.
    """
    commit = commit_of(ROOT)
    folder = None if commit == "unknown" or commit.endswith("+") else STORE / commit
    known = {task: stored(folder / task.file, task) for task in tasks} if reuse and folder else {}
    missing = [task for task in tasks if known.get(task) is None]
    if not missing:
        yield from (known[task] for task in tasks)
        return
    sketch_of(missing[0].drawing or missing[0].building, missing[0].hand)  # compiles, before processes part
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork")) as pool:
        made = pool.map(follow_task, missing)
        for task in tasks:
            followed = known.get(task)
            if followed is None:
                followed = next(made)
                if folder:
                    store(folder / task.file, followed)
            yield followed


def store(path: Path, followed: Followed) -> None:
    """Write traces to the store."""
    lists = [trace.to_lists() for trace in followed.traces]
    write_text(path, json.dumps({"atlas_s": followed.atlas_s, "traces": lists}))


def stored(path: Path, task: Task) -> Followed | None:
    """Read traces from the store; None if they are not there."""
    if not path.exists():
        return None
    read = json.loads(path.read_text())
    return Followed(task, tuple(Trace.from_lists(lists) for lists in read["traces"]), read["atlas_s"])


def all_traces(followed: Iterable[Followed]) -> list[Trace]:
    """Join the traces of several tasks."""
    return [trace for one in followed for trace in one.traces]
