"""`pilotage table`: draw a map in the browser, and watch a robot find its way by it."""

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.options import FootprintSize, SettingsFile
from pilotage.cli.robot import (
    PARAMETERS,
    Braking,
    Carrier,
    CommandTopic,
    Domain,
    Limits,
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
    limited,
    limits_of,
)
from pilotage.cli.terminal import say
from pilotage.errors import PilotageError
from pilotage.ros.link import Link, Topics, Transport

if TYPE_CHECKING:
    from pilotage.config import Settings
    from pilotage.web.order import RobotOrder

NEEDED = ("starlette", "uvicorn", "websockets")
"""What the extra `web` installs."""
OF_THE_ROBOT = {
    "drive": "--drive",
    "robot_file": "--robot",
    **{argument: f"--{name}" for name, (argument, _) in PARAMETERS.items()},
}
"""Options that mean nothing without a robot on the network, by their arguments."""
CARRIERS = {Transport.DDS: ("cyclonedds", "ros2"), Transport.ZENOH: ("zenoh", "zenoh")}
"""What carries the topics of a robot, and the extra that installs it."""


def table(
    context: typer.Context,
    folder: Annotated[Path, typer.Argument(help="Folder of drawings.")] = Path(),
    *,
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port; the next free one is taken.")] = 8765,
    host: Annotated[str, typer.Option(help="Address to listen at; others can reach 0.0.0.0.")] = "127.0.0.1",
    token: Annotated[
        str,
        typer.Option(
            help="Secret in the address; 16 letters or more if others can reach it.",
            show_default="a random one",
        ),
    ] = "",
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Whether to open a browser.")
    ] = True,
    ros2: Annotated[
        bool, typer.Option("--ros2", help="Offer the robot on the network as a world; options as of `ros2`.")
    ] = False,
    drive: Annotated[
        bool,
        typer.Option(
            "--drive", help="Let a person at the page send commands to that robot; else none is sent."
        ),
    ] = False,
    robot_file: RobotFile = None,  # noqa: ARG001  # its callback has used it
    radius: Radius = None,
    footprint: FootprintSize = None,
    speed: Speed = None,
    turn_rate: TurnRate = None,
    braking: Braking = None,
    domain: Domain = 0,
    transport: Carrier = Transport.DDS,
    namespace: Namespace = "",
    scan_topic: ScanTopic = "scan",
    odometry_topic: OdometryTopic = "odom",
    command_topic: CommandTopic = "cmd_vel",
    stamped: Stamped = False,
    settings: SettingsFile = None,
) -> None:
    """Open a page on which to draw a building, mark a goal, and watch a robot drive there.

    Drawings are kept in the folder, as SVG. Only this machine can reach the page, unless `--host` says
    otherwise, and only who knows its address with the token. The page loads nothing from elsewhere.

    **Examples:**

    - `pilotage table drawings`
    - Print the address alone: `pilotage table drawings --port 9000 --no-browser`
    - Watch a real robot: `pilotage table drawings --ros2 --domain 7`
    - Drive it by a button of the page:
      `pilotage table --ros2 --drive --radius 0.2 --speed 0.4 --turn-rate 1 --braking 0.5`
    - With settings of your own, for all robots: `pilotage table drawings --settings mine.toml`
    - For others in the network: `pilotage table drawings --host 0.0.0.0 --token "$(openssl rand -hex 16)"`
    """
    missing = [name for name in NEEDED if find_spec(name) is None]
    if missing:
        raise PilotageError(
            f"the drawing table needs {', '.join(missing)}: `pip install 'pilotage[web]'` installs it"
        )
    if not ros2:
        check_unused(context)
    limits, length = limits_of(footprint, radius, speed, turn_rate, braking)
    check_limits(limits, drive=drive)
    check_names(namespace, scan_topic, odometry_topic, command_topic)
    from pilotage.web.serve import Address, serve

    chosen = robot = None
    if settings is not None:
        from pilotage.config import read_settings

        chosen = read_settings(settings)
    if ros2:
        topics = Topics(scan_topic, odometry_topic, command_topic, stamped=stamped, drives=drive)
        link = Link(domain, namespace, transport)
        robot = robot_order(link, topics, chosen, limits, length)
    serve(folder, Address(host, port, token), browse=browser, say=say, robot=robot, settings=chosen)


def check_unused(context: typer.Context) -> None:
    """Reject options that say something of a robot on the network where there is none."""
    for argument, option in OF_THE_ROBOT.items():
        source = context.get_parameter_source(argument)
        if source is not None and source.name == "COMMANDLINE":
            raise typer.BadParameter("it needs --ros2", param_hint=option)


def robot_order(
    link: Link, topics: Topics, settings: "Settings | None", limits: Limits, length: float
) -> "RobotOrder":
    """Describe the robot to the workers of the table; PilotageError if its messages cannot be carried."""
    from pilotage.config import Settings
    from pilotage.web.order import RobotOrder

    module, extra = CARRIERS[link.transport]
    if find_spec(module) is None:
        raise PilotageError(f"a live robot needs the extra {extra}: pip install 'pilotage[{extra}]'")
    how = "a person at the page may let it drive" if topics.drives else "no commands are sent"
    say(f"The robot on domain {link.domain} is offered as a world; {how}")
    return RobotOrder(link, topics, limited(settings or Settings(), limits, length))
