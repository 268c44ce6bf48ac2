"""`pilotage navigate`: drive to a goal on a drawing, in a simulated world."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.correction import write_corrections
from pilotage.cli.drawing import Labels, Layers, Map, Page, Shade, findings_of, open_drawing, tell_worst
from pilotage.cli.drive import draw, drive_and_record, make_folder, story
from pilotage.cli.exits import signals_held
from pilotage.cli.options import (
    FootprintSize,
    GoalPlaces,
    Scale,
    Seed,
    SettingsFile,
    check_positive,
    parse_footprint,
)
from pilotage.cli.places import parse_goals, parse_pose
from pilotage.cli.terminal import busy, say
from pilotage.errors import FileError

if TYPE_CHECKING:
    from pilotage.config import Settings
    from pilotage.drives.loop import Start
    from pilotage.geometry import Pose2
    from pilotage.maps import SchematicMap
    from pilotage.maps.routing.roadmap import Point
    from pilotage.simulation import World


LARGE = 300.0
"""A larger diagonal [m] of a world is worth a remark: few buildings are so large, drawings in pixels are."""

SEVERITY = 0.5
"""How little a building made of the drawing is like it, if nothing is said."""

CORRECTED = ("corrected.svg", "corrected.yaml")
"""What a drive leaves of the corrected drawing."""


def navigate(
    drawing: Map,
    *,
    world: Annotated[
        Path | None,
        typer.Option(
            help="The true building to drive in: SVG in metres, or a ROS map (YAML).",
            show_default="one made of the drawing",
        ),
    ] = None,
    severity: Annotated[
        float | None,
        typer.Option(
            min=0.0,
            max=1.0,
            help="How little a building made of the drawing is like it: proportions, furniture, doors that "
            "close, people. 0 is the drawing itself.",
            show_default=str(SEVERITY),
        ),
    ] = None,
    goal: GoalPlaces = None,
    rounds: Annotated[
        int, typer.Option("--rounds", min=1, help="How often all goals are visited, as on patrol.")
    ] = 1,
    returns: Annotated[
        bool, typer.Option("--return", help="Drive back to where it began at the end.")
    ] = False,
    start: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y,HEADING_DEG",
            help="Where on the drawing the robot is told that it starts; the heading in degrees, "
            "counter-clockwise on the page from its x axis.",
            show_default="as marked in the drawing, else unknown",
        ),
    ] = None,
    place: Annotated[
        str | None,
        typer.Option(
            "--from",
            metavar="X,Y,HEADING_DEG",
            help="Where it truly starts, in metres of the world, y up; the robot is not told.",
            show_default="as marked in the world, else somewhere free",
        ),
    ] = None,
    scale: Scale = None,
    seed: Seed = 0,
    time_limit: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", help="Simulated time for each goal.", show_default="as in settings"),
    ] = None,
    footprint: FootprintSize = None,
    layer: Layers = None,
    label: Labels = None,
    page: Page = None,
    shading: Shade = "recognized",
    settings: SettingsFile = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="Folder for journal, figure and animation.", show_default="none"),
    ] = None,
    animation: Annotated[
        bool,
        typer.Option("--animation/--no-animation", help="Whether to draw the drive as a moving picture."),
    ] = True,
    corrected: Annotated[
        bool,
        typer.Option(
            "--corrected",
            help="Write the drawing in metres, bent to what the robot saw, into the folder too: "
            "corrected.svg, and corrected.yaml, a map for nav2.",
        ),
    ] = False,
    force: Annotated[bool, typer.Option("--force", help="Write into a folder that holds something.")] = False,
) -> None:
    """Drive a simulated robot to a goal that is marked on a drawing of the building.

    The robot has a laser, bad odometry and the drawing, which needs no scale and no furniture and may have
    its proportions wrong. From cell to cell, a room or a corridor each, it finds the way to the goal. Only
    the simulator knows the *world*. Without one, a building is made of the drawing, with other proportions
    and furniture.

    Points are in the drawing's own units and axes (in SVG and in pictures y points down); a label is a word
    written in the drawing, and the drive then ends anywhere in that room. A point that
    cannot be reached, behind a closed door or in a niche that is not there, counts as reached where the robot
    comes nearest, after it has tried other ways; how much is missing is said. Of several goals, one that is
    not reached in its time is left out, and said. Where no drawn door leads to the goal, the robot tries the
    walls between, and often gives up.

    A drive that ends without reaching its goal is no error: the exit status is 0, and the *outcome* in the
    last line of the journal tells.

    With a folder it leaves *journal.jsonl*, an object a step, with what the robot believed and did and, apart
    from it, the truth; *drive.png*, the drive on the drawing and in the world; and *drive.gif*, an animation
    of the same.

    **Examples:**

    - `pilotage navigate sketch.svg --goal kitchen -o run`
    - `pilotage navigate office.svg --world building.yaml --goal kitchen -o run`
    - `pilotage navigate office.svg --world building.svg --goal 440,150 --start 100,180,90 --from 2.1,-5.7,90`
    - Two goals, and back: `pilotage navigate office.svg --world building.svg --goal kitchen,hall --return`
    """
    check_positive(scale, "--scale")
    check_positive(time_limit, "--time-limit")
    size = parse_footprint(footprint)
    if corrected and output is None:
        raise typer.BadParameter("a corrected drawing needs a folder, see --output", param_hint="--corrected")
    if world is not None and severity is not None:
        raise typer.BadParameter("is of no use with --world", param_hint="--severity")
    if world is None and place is not None:
        raise typer.BadParameter("is of no use without --world", param_hint="--from")
    sketch = open_drawing(drawing, layer, label, page, shading).sketch
    target = goals_on(sketch, goal)
    known = start_on(sketch, start)
    truly = None if place is None else true_pose(place)
    chosen = chosen_settings(settings, time_limit, size)
    building = None if world is None else opened(world)
    from pilotage.drives import WatchingPilot, make_building, set_out
    from pilotage.maps import NotEnclosedError, build_atlas
    from pilotage.navigation import Tour
    from pilotage.simulation import StartError

    with busy("Reading the drawing"), signals_held():
        try:
            atlas = build_atlas(sketch, chosen.localizer.atlas)
            if building is None:
                unlike = SEVERITY if severity is None else severity
                made = make_building(atlas, target[0], known, severity=unlike, seed=seed, settings=chosen)
                building = made.world
            navigator, simulator = set_out(
                atlas,
                building,
                Tour(tuple(target), rounds, returns),
                start=known,
                world_start=truly,
                scale=scale,
                seed=seed,
                settings=chosen,
            )
        except NotEnclosedError as error:
            raise FileError(str(error), drawing) from error
        except StartError as error:
            raise FileError(str(error), drawing if world is None else world) from error
    tell_worst(drawing, findings_of(sketch, settings))
    if output is not None:
        make_folder(output, force=force)
    pilot = WatchingPilot(navigator)
    recorded = drive_and_record(building, navigator, simulator, output, pilot)
    told = story(recorded)
    typer.echo(told)
    if output is not None:
        draw(recorded, output, f"{drawing.name}: {told.split('. ')[0]}", moving=animation)
        if corrected:
            paths = [output / name for name in CORRECTED]
            write_corrections(navigator.planner.atlas, pilot.sightings, paths)
        say(f"See {output}.")


def opened(path: Path) -> "World":
    """Read a world; say how large it is if it may have been drawn in other units than metres."""
    from pilotage.io import open_world
    from pilotage.io.world import size_of

    building = open_world(path)
    size = size_of(building)
    if size > LARGE:
        say(f"pilotage: {path.name}: this world is {size:.0f} m across; a world is drawn in metres")
    return building


def goals_on(sketch: "SchematicMap", words: str | None) -> "list[Point | str]":
    """Read the goals, points or names, or take the point that the drawing marks; in the file's axes."""
    if words is not None:
        return parse_goals(words, [label.text for label in sketch.labels])
    if sketch.goal is None:
        raise typer.BadParameter("a drive needs a goal, the drawing marks none", param_hint="--goal")
    return [in_file(sketch, sketch.goal)]


def start_on(sketch: "SchematicMap", words: str | None) -> "Start | None":
    """Read the start, or take the point that the drawing marks, if it does; in the file's axes."""
    if words is not None:
        return parse_pose(words, "--start")
    return None if sketch.start is None else in_file(sketch, sketch.start)


def in_file(sketch: "SchematicMap", point: "Point") -> "Point":
    """Carry a point of the sketch to the axes of the drawing's file."""
    import numpy as np

    x, y = sketch.file_from_sketch(np.array([point]))[0].tolist()
    return x, y


def true_pose(words: str) -> "Pose2":
    """Read a pose in metres of the world."""
    from pilotage.geometry import Pose2

    return Pose2(*parse_pose(words, "--from"))


def chosen_settings(
    path: Path | None, time_limit: float | None, size: tuple[float, float] | None = None
) -> "Settings":
    """Read settings; time limit and size of the robot of the command line override theirs."""
    from dataclasses import replace

    from pilotage.config import read_settings

    settings = read_settings(path)
    if size is not None:
        length, radius = size[0], size[1] / 2.0
        body = replace(settings.simulator.body, length=length, radius=radius)
        settings = replace(
            settings,
            navigator=replace(settings.navigator, length=length, radius=radius),
            simulator=replace(settings.simulator, body=body),
        )
    if time_limit is None:
        return settings
    return replace(settings, navigator=replace(settings.navigator, time_limit=time_limit))
