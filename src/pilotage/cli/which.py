"""`pilotage which`: which of these drawings is of the building that a log was made in."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.options import Seed, check_positive
from pilotage.cli.terminal import say
from pilotage.errors import FileError

if TYPE_CHECKING:
    from pilotage.ranking import Board
    from pilotage.workers import Cluster, Processes

TRAVEL = 40.0
"""Metres of a log that are looked at by default."""


def which(
    files: Annotated[
        list[Path], typer.Argument(metavar="MAPS... LOGS...", help="Drawings and laser logs, in any order.")
    ],
    *,
    travel: Annotated[float, typer.Option(metavar="M", help="Metres of each log to look at.")] = TRAVEL,
    workers: Annotated[int, typer.Option(min=1, help="Processes to use.")] = 2,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS", help="A scheduler of Dask, whose workers to use instead (extra `cluster`)."
        ),
    ] = None,
    mirrored: Annotated[
        bool, typer.Option("--mirrored", help="Try each drawing as in a mirror, too.")
    ] = False,
    seed: Seed = 0,
) -> None:
    """Rank drawings by how well they explain a log.

    Each log is localized on each drawing. A line a drawing, the best first: the log, the rank, the logarithm
    of the drawing's evidence over that of other buildings, the probability of the place where the robot would
    be at the end, that place, and the drawing. Below -8 it is probably of another building.

    All drawings are tried with few particles, the best eighth (at least four) then with all. The numbers
    of the others are marked `~`. The ranking does not depend on the number of workers. Files that cannot
    be used are left out. Ctrl-C prints what is known so far.

    With --mirrored each drawing is also tried as in a mirror, which takes twice as long. If that ranks first
    by far, mirror the drawing before you drive by it. A building that looks alike in a mirror does not tell.

    **Examples:**

    - `pilotage which floor1.svg floor2.pdf run.log.gz`
    - `pilotage which floors/*.svg monday.mcap tuesday.mcap --travel 80 --workers 8`
    - `pilotage which floors/*.svg bags/*.mcap --scheduler tcp://10.0.0.5:8786`
    - `pilotage which scan.png run.log.gz --mirrored`
    """
    check_positive(travel, "--travel")
    drawings, logs = sorted_out(files if scheduler is None else [path.absolute() for path in files])
    from pilotage.ranking import Board, rank

    board, told = Board(), set[Path]()
    with opened(workers, scheduler) as hands:
        try:
            for log in rank(
                drawings,
                logs,
                hands,
                board,
                travel=travel,
                seed=seed,
                mirrored=mirrored,
                say=lambda text: say(f"pilotage: {text}"),
            ):
                show(board, log)
                told.add(log)
        except KeyboardInterrupt as interrupt:
            for log in (log for log in board.scores if log not in told):
                show(board, log)
                done, count = len(board.scores[log]), len(drawings) * (2 if mirrored else 1)
                interrupt.add_note(f"{log.name} was compared with {done} of {count} drawings")
            raise
    if not told:
        raise FileError("none of the drawings and logs can be used", files[0])


def sorted_out(files: list[Path]) -> tuple[list[Path], list[Path]]:
    """Tell drawings from logs, each once; FileError if there is none of one kind."""
    from pilotage.io.logs import is_log

    paths = list(dict.fromkeys(files))
    logs = [path for path in paths if is_log(path)]
    drawings = [path for path in paths if path not in logs]
    if not (logs and drawings):
        missing = "a log" if not logs else "a drawing"
        raise FileError(f"drawings and logs are needed, {missing} is missing", files[0])
    return drawings, logs


def opened(workers: int, scheduler: str | None) -> "Processes | Cluster":
    """Connect to a scheduler if there is one, else use processes."""
    from pilotage.workers import Cluster, Processes

    return Processes(workers) if scheduler is None else Cluster(scheduler)


def show(board: "Board", log: Path) -> None:
    """Print the ranking of a log."""
    for place, one in enumerate(board.ranking(log), start=1):
        mark, found = " " if one.is_refined else "~", one.evidence
        numbers = f"{place:3d} {mark}{found.log_evidence:+9.1f}  {found.probability:.2f}"
        typer.echo(f"{log.name}  {numbers}  {found.place}  {one.name}")
