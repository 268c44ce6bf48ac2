"""`pilotage ros2`: localize and drive a live robot of ROS 2."""

import contextlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.correction import write_corrections
from pilotage.cli.drawing import Labels, Layers, Map, Page, Shade, open_drawing
from pilotage.cli.exits import signals_held
from pilotage.cli.localize import corrected_files
from pilotage.cli.options import FootprintSize, Force, Scale, Seed, SettingsFile, StartPose, check_positive
from pilotage.cli.places import parse_goals, parse_pose
from pilotage.cli.robot import (
    Braking,
    Carrier,
    CommandTopic,
    Domain,
    Namespace,
    OdometryTopic,
    Radius,
    RobotFile,
    ScanTopic,
    Speed,
    Stamped,
    TurnRate,
    check_limits,
    check_names,
    chosen_settings,
    limits_of,
)
from pilotage.cli.terminal import busy, check_outputs, say
from pilotage.errors import PilotageError
from pilotage.ros.link import Link, Topics, Transport

if TYPE_CHECKING:
    from pilotage.config import Settings
    from pilotage.io.state import SavedState
    from pilotage.maps import SchematicMap
    from pilotage.ros.robot import LiveRobot
    from pilotage.ros.session import Session

REPORT_EVERY = 5.0
"""Time [s] between two lines on how it goes."""


def ros2(
    drawing: Map,
    *,
    goal: Annotated[
        str | None,
        typer.Option(metavar="X,Y|LABEL[,...]", help="Where to drive to, on the drawing; several in order."),
    ] = None,
    patrol: Annotated[bool, typer.Option("--patrol", help="Visit the goals again and again.")] = False,
    returns: Annotated[
        bool, typer.Option("--return", help="Drive back to where it began at the end.")
    ] = False,
    drive: Annotated[
        bool, typer.Option("--drive", help="Send commands to the wheels; without it, none is sent.")
    ] = False,
    localize_only: Annotated[
        bool, typer.Option("--localize-only", help="Stand in for AMCL: hear no goals, send no commands.")
    ] = False,
    robot_file: RobotFile = None,  # noqa: ARG001  # its callback has used it
    radius: Radius = None,
    footprint: FootprintSize = None,
    speed: Speed = None,
    turn_rate: TurnRate = None,
    braking: Braking = None,
    start: StartPose = None,
    scale: Scale = None,
    resume: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Go on from what was believed at the last stop, if the file is there; save it at the end.",
        ),
    ] = None,
    corrected_map: Annotated[
        bool,
        typer.Option("--corrected-map", help="Say as *map* the drawing bent to the walls seen, in metres."),
    ] = False,
    corrected: Annotated[
        Path | None,
        typer.Option(help="Where to write that drawing at the end (.svg, or .yaml: a map for nav2)."),
    ] = None,
    domain: Domain = 0,
    transport: Carrier = Transport.DDS,
    namespace: Namespace = "",
    scan_topic: ScanTopic = "scan",
    odometry_topic: OdometryTopic = "odom",
    command_topic: CommandTopic = "cmd_vel",
    stamped: Stamped = False,
    layer: Layers = None,
    label: Labels = None,
    page: Page = None,
    shading: Shade = "recognized",
    settings: SettingsFile = None,
    seed: Seed = 0,
    force: Force = False,
) -> None:
    """Localize a live robot of ROS 2 on a drawing, and drive it if that is wanted.

    No ROS is needed on this machine: it joins the robot's domain by DDS (extra `ros2`) or Zenoh (`zenoh`).
    Without `--drive` no wheel turns. With it, size and limits of the robot must be given.
    Goals are heard on *goal_pose* and *pilotage/goal*, starts on *initialpose*.
    Ctrl-C stops the robot and ends.

    **Examples:**

    - Stand in for AMCL: `pilotage ros2 office.svg --localize-only`
    - A map that nav2 can plan on: `pilotage ros2 office.svg --localize-only --corrected-map`
    - One robot of several: `pilotage ros2 office.svg --domain 7 --namespace robot1 --scan-topic front/scan`
    - Say where it would drive: `pilotage ros2 office.svg --goal kitchen`
    - Patrol: `pilotage ros2 office.svg --goal kitchen,hall,store --patrol`
    - Go on where it stopped: `pilotage ros2 office.svg --resume office.state`
    - `pilotage ros2 office.svg --goal kitchen --drive --radius 0.2 --speed 0.4 --turn-rate 1 --braking 0.5`
    - The same with a file of the robot: `pilotage ros2 office.svg --goal kitchen --drive --robot robot.toml`
    """
    limits, length = limits_of(footprint, radius, speed, turn_rate, braking)
    check_limits(limits, drive=drive)
    check_names(namespace, scan_topic, odometry_topic, command_topic)
    if localize_only and (drive or goal is not None):
        raise typer.BadParameter("it excludes --drive and --goal", param_hint="--localize-only")
    check_tour(goal, patrol=patrol, returns=returns)
    check_positive(scale, "--scale")
    check_outputs(() if corrected is None else corrected_files(corrected), force=force)
    from pilotage.navigation import Tour

    if resume is not None and start is not None:
        raise typer.BadParameter("it excludes --start", param_hint="--resume")
    from pilotage.ros.robot import LiveRobot

    sketch = open_drawing(drawing, layer, label, page, shading).sketch
    known = None if start is None else parse_pose(start, "--start")
    session = open_session(
        sketch,
        chosen_settings(settings, limits, length),
        seed,
        known,
        scale,
        resume=resume,
        keeps_sightings=corrected_map or corrected is not None,
    )
    topics = Topics(
        scan_topic,
        odometry_topic,
        command_topic,
        stamped=stamped,
        drives=drive,
        localizes_only=localize_only,
    )
    if goal is not None:
        goals = parse_goals(goal, [one.text for one in sketch.labels])
        refusal = session.set_goal(Tour(tuple(goals), None if patrol else 1, returns))
        if refusal:
            raise typer.BadParameter(refusal, param_hint="--goal")
    robot = LiveRobot(
        Link(domain, namespace, transport).join(), session, topics, lambda text: say(f"pilotage: {text}")
    )
    say(f"pilotage: listening on domain {domain}; " + ("driving" if drive else "no commands are sent"))
    with (
        writing_at_the_end(session, corrected),
        saving_at_the_end(session, resume),
        correcting(session, wanted=corrected_map) as look,
        standing_at_the_end(robot),
    ):
        spin(robot, look, ends=goal is not None)


def check_tour(goal: str | None, *, patrol: bool, returns: bool) -> None:
    """Reject a tour without a goal, and a return from one that never ends."""
    if goal is None and (patrol or returns):
        raise typer.BadParameter("it needs --goal", param_hint="--patrol" if patrol else "--return")
    if patrol and returns:
        raise typer.BadParameter("a patrol never ends", param_hint="--return")


def open_session(
    sketch: "SchematicMap",
    settings: "Settings",
    seed: int,
    start: tuple[float, float, float] | None,
    scale: float | None,
    *,
    resume: Path | None = None,
    keeps_sightings: bool = False,
) -> "Session":
    """Prepare the drawing, and compile what a step needs before the robot waits for it."""
    from pilotage.errors import FileError
    from pilotage.localization.state import OtherDrawingError
    from pilotage.maps import build_atlas
    from pilotage.navigation.goal import sketch_point
    from pilotage.ros.session import Session
    from pilotage.ros.warm_up import warm_up

    resumed = None if resume is None else saved_state(resume)
    with busy("Reading the drawing"), signals_held():
        try:
            atlas = build_atlas(sketch, settings.localizer.atlas)
            warm_up(atlas, settings)
            session = Session(
                atlas,
                (settings.localizer, settings.navigator),
                seed=seed,
                start=start,
                scale=scale,
                resumed=resumed,
                keeps_sightings=keeps_sightings,
            )
        except OtherDrawingError as error:
            raise FileError(str(error), resume or sketch.source) from error
        except ValueError as error:
            raise FileError(str(error), sketch.source) from error
        if start is not None:
            sketch_point(session.atlas, start[:2], "start")
        return session


def saved_state(path: Path) -> "SavedState | None":
    """Read what was believed at the last stop; without a file it is the first start."""
    from pilotage.io.files import check_replaceable
    from pilotage.io.state import read_state

    check_replaceable(path)
    if not path.exists():
        say(f"pilotage: there is no {path} yet, it is written at the end")
        return None
    return read_state(path)


@contextlib.contextmanager
def saving_at_the_end(session: "Session", path: Path | None) -> Iterator[None]:
    """Save what is believed however the block ends, if a file is given and a scan was seen."""
    try:
        yield
    finally:
        if path is not None and session.has_seen:
            session.save(path)
            say(f"pilotage: what is believed is saved in {path}")


@contextlib.contextmanager
def writing_at_the_end(session: "Session", path: Path | None) -> Iterator[None]:
    """Write the corrected drawing however the block ends, if a file is given."""
    try:
        yield
    finally:
        if path is not None:
            with signals_held():
                try:
                    write_corrections(session.atlas, session.sightings, [path])
                except PilotageError as error:
                    say(f"pilotage: {error}")


@contextlib.contextmanager
def correcting(session: "Session", *, wanted: bool) -> Iterator[Callable[[], None]]:
    """Correct the map while the block goes on, if that is wanted; what is given is to be called often."""
    if not wanted:
        yield lambda: None
        return
    from pilotage.ros.correcting import Correcting

    beside = Correcting(session, lambda text: say(f"pilotage: {text}"))
    try:
        yield beside.look
    finally:
        beside.close()


@contextlib.contextmanager
def standing_at_the_end(robot: "LiveRobot") -> Iterator[None]:
    """Stop the robot however the block ends."""
    try:
        yield
    finally:
        robot.stop()


def spin(robot: "LiveRobot", look: Callable[[], None], *, ends: bool) -> None:
    """Go on until the drive is over, if there was a goal from the beginning, else until Ctrl-C."""
    import time

    said = time.monotonic()
    while not (ends and robot.is_over):
        robot.spin_once()
        look()
        if robot.told is not None and time.monotonic() - said >= REPORT_EVERY:
            said = time.monotonic()
            values = robot.told.belief.values
            say(f"pilotage: {values['status']} in {values['place']}, p = {values['probability']}")
