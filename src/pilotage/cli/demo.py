"""`pilotage demo`: a whole drive on what is packed with the package."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.drive import ANIMATION, FIGURE, JOURNAL, draw, drive_and_record, story
from pilotage.cli.exits import signals_held
from pilotage.cli.options import Seed, SettingsFile
from pilotage.cli.terminal import busy, say
from pilotage.errors import FileError

if TYPE_CHECKING:
    from pilotage.drives import Drive
    from pilotage.maps.routing.roadmap import Point
    from pilotage.worlds import PackedWorld

MARK = ".pilotage-demo"
"""A folder with this file in it was made by the demo, and may be overwritten."""
GOAL = "Ana"
"""Whom the robot visits: her room is at the other end of the floor."""


def demo(
    *,
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for the results.")] = Path("demo"),
    seed: Seed = 0,
    settings: SettingsFile = None,
    force: Annotated[bool, typer.Option("--force", help="Replace files that the demo did not make.")] = False,
) -> None:
    """Drive a simulated robot through an office to a room that is named on a quick drawing.

    The office is full of furniture, people walk about and a door closes; the robot has a laser and bad
    odometry. The drawing was made from a poor memory: no scale, wrong proportions, no furniture. Nobody says
    where the drive begins. After about a minute it leaves *journal.jsonl*, *drive.png* and *drive.gif* in the
    folder, and a sentence that says what happened. `pilotage navigate` does the same with a drawing and a
    world of your own.

    **Example:** `pilotage demo -o demo`
    """
    from pilotage.config import read_settings

    chosen = read_settings(settings)
    claim(output, [output / name for name in (JOURNAL, FIGURE, ANIMATION)], force=force)
    from pilotage.drives import set_out
    from pilotage.io import open_map, open_world
    from pilotage.worlds import OFFICE

    sketch, building = open_map(OFFICE.quick), open_world(OFFICE.world)
    with busy("Reading the drawing"), signals_held():
        navigator, simulator = set_out(sketch, building, GOAL, seed=seed, settings=chosen)
    driven = drive_and_record(building, navigator, simulator, output)
    recorded = replace(driven, true_goal=find_true_goal(driven, OFFICE))
    typer.echo(f"{story(recorded)} {truth(recorded, OFFICE)}")
    draw(recorded, output, f'To "{GOAL}" in an office drawn from memory', moving=True)
    say(f"See {output / ANIMATION}, {output / FIGURE} and {output / JOURNAL}.")
    say("To draw a building of your own and watch a robot find its way in it: make table, or pilotage table")


def claim(folder: Path, files: Sequence[Path], *, force: bool) -> None:
    """Make the folder our own; refuse to replace files in a folder that is not."""
    mark = folder / MARK
    if not mark.exists() and not force:
        for path in files:
            if path.exists():
                raise FileError(
                    "a file is already there that the demo did not make, --force replaces it", path
                )
    try:
        folder.mkdir(parents=True, exist_ok=True)
        mark.touch()
    except OSError as error:
        raise FileError(f"the folder cannot be made ({error.strerror})", folder) from error


def find_true_goal(recorded: "Drive", packed: "PackedWorld") -> "Point":
    """Carry the goal from the quick drawing of a packed building to the building."""
    import numpy as np

    from pilotage.evaluation.warp import read_warp

    warp = read_warp(packed.quick.with_suffix(".json"), recorded.sketch)
    x, y = warp.world_from_sketch(np.array([recorded.goal.point]))[0].tolist()
    return x, y


def truth(recorded: "Drive", packed: "PackedWorld") -> str:
    """Say where in a packed building the robot truly ended."""
    from pilotage.evaluation.rooms import read_world_rooms

    end = recorded.scenes[-1].world_from_base.position
    (room,) = read_world_rooms(packed.folder / "rooms.geojson").names_at(end[None])
    where = f'in the room called "{room}"' if room else "in no room"
    return f"In truth it stands {where}."
