"""Options that several commands have, and checks of their values."""

import math
from pathlib import Path
from typing import Annotated

import typer

StartPlace = Annotated[
    str | None,
    typer.Option(metavar="X,Y|LABEL", help="Where to start.", show_default="as marked in the drawing"),
]
GoalPlace = Annotated[
    str | None,
    typer.Option(metavar="X,Y|LABEL", help="Where to go.", show_default="as marked in the drawing"),
]
GoalPlaces = Annotated[
    str | None,
    typer.Option(
        "--goal",
        metavar="X,Y|LABEL[,...]",
        help="Where to go; several in order, between commas.",
        show_default="as marked in the drawing",
    ),
]
StartPose = Annotated[
    str | None,
    typer.Option(
        metavar="X,Y,HEADING_DEG",
        help="Where the robot starts, in the drawing's own coordinates; the heading in degrees, "
        "counter-clockwise on the page from its x axis.",
        show_default="unknown",
    ),
]
Scale = Annotated[float | None, typer.Option(help="Drawing units per metre, if known.")]
Seed = Annotated[int, typer.Option(min=0, help="Seed of all that is left to chance.")]
SettingsFile = Annotated[Path | None, typer.Option("--settings", help="Settings to change (TOML).")]
Force = Annotated[bool, typer.Option("--force", help="Replace files that are there.")]


def check_positive(value: float | None, option: str) -> None:
    """Reject a number that is given and not positive and finite."""
    if value is not None and not (math.isfinite(value) and value > 0.0):
        raise typer.BadParameter(f"it must be positive, got {value}", param_hint=option)
