"""`pilotage which`: which of these drawings is of the building that a log was made in."""

import math
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from pilotage.cli.options import Seed, check_positive
from pilotage.cli.terminal import say
from pilotage.errors import FileError, PilotageError

TRAVEL = 40.0
"""[m] of a log that are looked at, unless it is told otherwise."""
ATTEMPTS = 3
"""How often a drawing is tried if the process that tries it is killed."""

Task = tuple[Path, bool]
"""A drawing, and whether it is tried as in a mirror."""


@dataclass(frozen=True, slots=True)
class Score:
    """What one drawing tells about one log."""

    drawing: Path
    is_mirrored: bool
    log_evidence: float  # over that of any building
    place: str
    probability: float


def which(
    files: Annotated[
        list[Path], typer.Argument(metavar="MAPS... LOGS...", help="Drawings and laser logs, in any order.")
    ],
    *,
    travel: Annotated[float, typer.Option(metavar="M", help="Metres of each log to look at.")] = TRAVEL,
    jobs: Annotated[int, typer.Option(min=1, help="Processes to use.")] = 2,
    mirrored: Annotated[
        bool, typer.Option("--mirrored", help="Try each drawing as in a mirror, too.")
    ] = False,
    seed: Seed = 0,
) -> None:
    """Rank drawings by how well they explain a log.

    Each log is localized on each drawing. A line a drawing, the best first: the log, the rank, the logarithm
    of the drawing's evidence over that of any building, the probability of the place where the robot would be
    at the end, that place, and the drawing.

    With --mirrored each drawing is also tried as in a mirror, which takes twice as long. If that ranks first
    by far, mirror the drawing before you drive by it. A building that looks alike in a mirror does not tell.

    **Examples:**

    - `pilotage which floor1.svg floor2.pdf run.log.gz`
    - `pilotage which floors/*.svg monday.mcap tuesday.mcap --travel 80 --jobs 8`
    - `pilotage which scan.png run.log.gz --mirrored`
    """
    from pilotage.io.logs import is_log

    check_positive(travel, "--travel")
    logs = [path for path in files if is_log(path)]
    drawings = [path for path in files if path not in logs]
    if not (logs and drawings):
        missing = "a log" if not logs else "a drawing"
        raise FileError(f"drawings and logs are needed, {missing} is missing", files[0])
    tasks = [
        (drawing, is_mirrored)
        for drawing in drawings
        for is_mirrored in ((False, True) if mirrored else (False,))
    ]
    for log in logs:
        scores = sorted(
            scored(tasks, log, travel, seed, jobs),
            key=lambda one: (-one.log_evidence, one.drawing, one.is_mirrored),
        )
        if not scores:
            raise FileError("none of the drawings can be used", log)
        for rank, one in enumerate(scores, start=1):
            numbers = f"{rank:3d}  {one.log_evidence:+9.1f}  {one.probability:.2f}"
            typer.echo(f"{log.name}  {numbers}  {one.place}  {named(one, str(one.drawing))}")


def named(one: Score, drawing: str) -> str:
    """Add to the name of a drawing whether it was mirrored."""
    return f"{drawing}, mirrored" if one.is_mirrored else drawing


def scored(tasks: Sequence[Task], log: Path, travel: float, seed: int, jobs: int) -> Iterator[Score]:
    """Try all drawings in processes, each as it is done; what a killed process had is tried again."""
    waiting = list(tasks)
    for _ in range(ATTEMPTS):
        lost: list[Task] = []
        with ProcessPoolExecutor(min(jobs, len(waiting))) as pool:
            futures: dict[Future[Score], Task] = {
                pool.submit(score, task, log, travel, seed): task for task in waiting
            }
            for done, future in enumerate(as_completed(futures), start=1):
                try:
                    one = future.result()
                except BrokenProcessPool:
                    lost.append(futures[future])
                except PilotageError as error:
                    say(f"pilotage: left out: {error}")
                else:
                    name = named(one, one.drawing.name)
                    say(f"pilotage: {done} of {len(waiting)}: {name} {one.log_evidence:+.1f}")
                    yield one
        if not lost:
            return
        waiting = lost
    say(f"pilotage: {len(waiting)} drawings were given up, their processes were killed")


def score(task: Task, log: Path, travel: float, seed: int) -> Score:
    """Localize along the first metres of a log, and sum up the evidence."""
    drawing, is_mirrored = task
    from pilotage.io import open_log, open_map
    from pilotage.localization import Localizer

    try:
        sketch = open_map(drawing)
        localizer = Localizer(sketch.mirrored() if is_mirrored else sketch, seed=seed)
    except ValueError as error:
        raise FileError(str(error), drawing) from error
    gone, last = 0.0, None
    for reading in open_log(log):
        localizer.update(reading.scan, reading.odometry)
        here = localizer.scan_matcher.odom_from_base.position
        gone += 0.0 if last is None else math.hypot(*(here - last))
        last = here
        if gone >= travel:
            break
    estimate = localizer.estimate
    return Score(drawing, is_mirrored, localizer.log_evidence, estimate.place, estimate.probability)
