"""Drive in the simulator, show how it goes, and leave a folder: what `navigate` and `demo` share."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.live import Live
from rich.text import Text

from pilotage.cli.exits import Stopped, interrupted_between
from pilotage.cli.terminal import busy, keeping, say
from pilotage.errors import FileError

if TYPE_CHECKING:
    from pilotage.drives import Drive, Instant, Pilot
    from pilotage.maps import CellGraph, SchematicMap
    from pilotage.navigation import Navigator, Step
    from pilotage.simulation import Scene, Simulator, World

JOURNAL, FIGURE, ANIMATION = "journal.jsonl", "drive.png", "drive.gif"
"""What a drive leaves in its folder."""
EVERY = 5.0
"""Simulated time [s] between two lines of progress where there is no terminal."""


def drive_and_record(
    world: "World",
    navigator: "Navigator",
    simulator: "Simulator",
    folder: Path | None,
    pilot: "Pilot | None" = None,
) -> "Drive":
    """Drive to the end; the journal grows in the folder, if there is one.

    A pilot may step in for the navigator.
    """
    from pilotage.drives import Drive, drive

    atlas, goal = navigator.planner.atlas, navigator.planner.goal
    with journal_in(folder, atlas.sketch) as write:
        instants = follow(drive(pilot or navigator, simulator), navigator.planner.graph, write)
    return Drive.of(atlas, world, goal, instants)


def follow(
    instants: "Iterable[Instant]", graph: "CellGraph", write: "Callable[[Step, Scene], None]"
) -> "list[Instant]":
    """Go through a drive, each step shown and written as it comes; Ctrl-C ends it where it is."""
    gathered = []
    with progress(graph) as show:
        try:
            for instant in interrupted_between(instants):
                gathered.append(instant)
                write(instant.step, instant.scene)
                show(instant.step)
        except KeyboardInterrupt as interrupt:
            if not gathered or isinstance(interrupt, Stopped):
                raise
    return gathered


@contextmanager
def progress(graph: "CellGraph") -> "Iterator[Callable[[Step], None]]":
    """Show what goes on: live if a person is watching, else a line now and then."""
    from pilotage.figures.words import describe

    console = Console(stderr=True)
    if console.is_terminal:
        with Live(console=console, refresh_per_second=8, transient=True) as live:
            yield lambda step: live.update(Text(describe(step, step.stamp, graph)))
        return
    said = float("-inf")

    def show(step: "Step") -> None:
        nonlocal said
        if step.stamp - said >= EVERY:
            said = step.stamp
            say(describe(step, step.stamp, graph))

    yield show


@contextmanager
def journal_in(folder: Path | None, sketch: "SchematicMap") -> "Iterator[Callable[[Step, Scene], None]]":
    """Open the journal in a folder; without a folder nothing is written."""
    if folder is None:
        yield lambda _step, _scene: None
        return
    from pilotage.io.journal import journal_file

    with journal_file(folder / JOURNAL, sketch) as write:
        yield write


def make_folder(folder: Path, *, force: bool) -> None:
    """Make a folder for a drive; one with other things in it must not be used unasked.

    Temporary files that a killed run left in it do not count.
    """
    from pilotage.io.files import is_temporary

    try:
        if folder.is_dir() and not all(map(is_temporary, folder.iterdir())) and not force:
            raise FileError("the folder holds something already, --force writes into it", folder)
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(f"the folder cannot be made ({error.strerror})", folder) from error


def draw(recorded: "Drive", folder: Path, title: str, *, moving: bool) -> None:
    """Draw the drive, as an animation too if that is wanted."""
    from pilotage.figures.drive import drive_figure
    from pilotage.figures.style import save

    with keeping(folder / JOURNAL), busy("Drawing"):
        save(drive_figure(recorded, title), folder / FIGURE)
        if moving:
            from pilotage.figures.animation import animate

            animate(recorded, folder / ANIMATION)


def story(recorded: "Drive") -> str:
    """Say in plain words what happened."""
    from pilotage.figures.words import clock
    from pilotage.localization import Status

    last, scene = recorded.steps[-1], recorded.scenes[-1]
    located = [step.estimate.status is Status.LOCATED for step in recorded.steps]
    found = (
        f"first claimed a place after {clock(recorded.times[located.index(True)])}"
        if any(located)
        else "never claimed a place"
    )
    lost = {0: "", 1: ", lost it once"}.get(last.times_lost, f", lost it {last.times_lost} times")
    touched = {0: "nothing", 1: "something once"}.get(scene.collisions, f"things {scene.collisions} times")
    return f"{ending(recorded)} It {found}{lost} and touched {touched}."


def caveats(recorded: "Drive") -> str:
    """Say what speaks against having reached the goal."""
    from pilotage.localization import Status

    last, said = recorded.steps[-1], ""
    if recorded.goal.is_missed_by(last.distance):
        said += f" It found no way nearer to it than {last.distance:.1f} m."
    if last.estimate.status is Status.MISMATCH:
        said += " But drawings of other buildings explain the way better than this one."
    return said


def ending(recorded: "Drive") -> str:
    """Say how the drive ended, and where the robot believes to be."""
    from pilotage.figures.words import clock, name_cell
    from pilotage.navigation import Outcome

    last, goal = recorded.steps[-1], recorded.goal
    here = name_cell(last.estimate.cell_id, recorded.graph)
    effort = f"{recorded.length:.0f} m and {clock(recorded.times[-1])} minutes"
    if len(last.visits) > 1 and last.outcome is not Outcome.MISMATCH:
        return f"After {effort}: {last.reason}. The robot believes to be in {here}."
    if last.outcome is Outcome.REACHED:
        where = f"in {here}" if goal.is_room else f"at the goal, in {here}"
        return f"After {effort} the robot says that it stands {where}.{caveats(recorded)}"
    if last.outcome is Outcome.MISMATCH:
        return f"After {effort} the robot gave up: {last.reason}."
    if last.outcome is Outcome.GAVE_UP:
        return f"After {effort} the robot gave up: {last.reason}. It believes to be in {here}."
    return f"The drive was stopped after {effort}. The robot believes to be in {here}."
