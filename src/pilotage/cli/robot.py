"""Options that say which robot is on the network and what it can do: `ros2` and `table` share them."""

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.options import check_positive, parse_footprint
from pilotage.errors import FileError, shown
from pilotage.ros.link import Transport

if TYPE_CHECKING:
    from pilotage.config import Settings

Radius = Annotated[float | None, typer.Option(metavar="M", help="Radius of the robot [m]; needed to drive.")]
Speed = Annotated[float | None, typer.Option(metavar="M/S", help="Fastest speed [m/s]; needed to drive.")]
TurnRate = Annotated[
    float | None, typer.Option(metavar="RAD/S", help="Fastest turn [rad/s]; needed to drive.")
]
Braking = Annotated[
    float | None, typer.Option(metavar="M/S2", help="Deceleration to rely on [m/s2]; needed to drive.")
]
Domain = Annotated[int, typer.Option(min=0, max=232, envvar="ROS_DOMAIN_ID", help="Domain of the robot.")]
Carrier = Annotated[Transport, typer.Option(help="What carries the topics: DDS, or Zenoh as of rmw_zenoh.")]
Namespace = Annotated[str, typer.Option(help="Namespace of the robot's topics.")]
ScanTopic = Annotated[str, typer.Option("--scan-topic", help="Topic of the scans.")]
OdometryTopic = Annotated[str, typer.Option("--odom-topic", help="Topic of the odometry.")]
CommandTopic = Annotated[str, typer.Option("--cmd-topic", help="Topic of the commands.")]
Stamped = Annotated[
    bool, typer.Option("--stamped", help="Send TwistStamped, as robots of Jazzy and later want.")
]

NAME = re.compile(r"/?[A-Za-z_]\w*(/[A-Za-z_]\w*)*/?", re.ASCII)
"""How ROS 2 names topics and namespaces."""

KINDS = {float: "a number", int: "a whole number", str: "a text", bool: "true or false"}
"""Kinds of values in words."""
PARAMETERS = {
    "radius": ("radius", float),
    "footprint": ("footprint", str),
    "speed": ("speed", float),
    "turn-rate": ("turn_rate", float),
    "braking": ("braking", float),
    "domain": ("domain", int),
    "transport": ("transport", str),
    "namespace": ("namespace", str),
    "scan-topic": ("scan_topic", str),
    "odom-topic": ("odometry_topic", str),
    "cmd-topic": ("command_topic", str),
    "stamped": ("stamped", bool),
}
"""What a file for `--robot` may hold: names of options, their arguments, and the kinds of values."""


def take_robot(context: typer.Context, path: Path | None) -> Path | None:
    """Let the values of a file be the defaults of the options of the same names."""
    if path is not None:
        context.default_map = {**(context.default_map or {}), **read_robot(path)}
    return path


def read_robot(path: Path) -> dict[str, object]:
    """Read a file that describes a robot; FileError if it holds anything else."""
    from pilotage.io.toml_files import read_toml

    values = read_toml(path, "a file of a robot")
    for name, value in values.items():
        if name not in PARAMETERS:
            raise FileError(f"a robot has no {shown(name)}, only {', '.join(PARAMETERS)}", path)
        kind = PARAMETERS[name][1]
        if type(value) is not kind and not (kind is float and type(value) is int):
            raise FileError(f"{name} must be {KINDS[kind]}, got {shown(value)}", path)
    return {PARAMETERS[name][0]: value for name, value in values.items()}


RobotFile = Annotated[
    Path | None,
    typer.Option(
        "--robot",
        metavar="FILE",
        is_eager=True,
        callback=take_robot,
        help="Size, limits and topics of the robot (TOML); options win over it.",
    ),
]

Limits = dict[str, float | None]
"""Size and limits of a robot, by the options that give them."""


def limits_of(
    footprint: str | None,
    radius: float | None,
    speed: float | None,
    turn_rate: float | None,
    braking: float | None,
) -> tuple[Limits, float]:
    """Gather size and limits, and the length of a rectangular footprint [m], 0 for a disc."""
    size = parse_footprint(footprint)
    if size is not None and radius is not None:
        raise typer.BadParameter("it excludes --radius", param_hint="--footprint")
    length, width = (0.0, 0.0) if size is None else size
    radius = radius if size is None else width / 2.0
    limits = {"--radius": radius, "--speed": speed, "--turn-rate": turn_rate, "--braking": braking}
    return limits, length


def check_limits(limits: Limits, *, drive: bool) -> None:
    """Reject limits that cannot be, and a drive by guessed ones."""
    for option, value in limits.items():
        check_positive(value, option)
        if drive and value is None:
            raise typer.BadParameter("it must be given to drive", param_hint=option)


def check_names(namespace: str, scan_topic: str, odometry_topic: str, command_topic: str) -> None:
    """Reject what cannot be the name of a topic or a namespace; a namespace may be empty."""
    names = {"--scan-topic": scan_topic, "--odom-topic": odometry_topic, "--cmd-topic": command_topic}
    if namespace.strip("/"):
        names["--namespace"] = namespace
    for option, name in names.items():
        if not NAME.fullmatch(name):
            raise typer.BadParameter(
                f"a name of ROS has letters, digits, _ and /, no part begins with a digit, got {name!r}",
                param_hint=option,
            )


def chosen_settings(path: Path | None, limits: Limits, length: float = 0.0) -> "Settings":
    """Read settings; size and limits of the command line override theirs."""
    from pilotage.config import read_settings

    return limited(read_settings(path), limits, length)


def limited(settings: "Settings", limits: Limits, length: float) -> "Settings":
    """Put size and limits of the command line in place of those of settings."""
    from dataclasses import replace

    names = {"--speed": "speed", "--turn-rate": "turn_rate", "--braking": "braking"}
    steering = {names[option]: value for option, value in limits.items() if option in names and value}
    navigator = replace(settings.navigator, steering=replace(settings.navigator.steering, **steering))
    if limits["--radius"]:
        navigator = replace(navigator, radius=limits["--radius"], length=length)
    return replace(settings, navigator=navigator)
