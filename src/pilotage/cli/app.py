"""All commands together."""

from importlib.metadata import version
from typing import Annotated

import typer

from pilotage.cli.cells import cells
from pilotage.cli.check import check
from pilotage.cli.demo import demo
from pilotage.cli.localize import localize
from pilotage.cli.navigate import navigate
from pilotage.cli.perceive import perceive
from pilotage.cli.record import record
from pilotage.cli.ros2 import ros2
from pilotage.cli.settings import settings
from pilotage.cli.simplify import simplify
from pilotage.cli.table import table

app = typer.Typer(
    name="pilotage",
    help="Find a robot's place in a hand-drawn map from its laser scans, and drive it from there.\n\n"
    "Begin with **pilotage demo**.",
    rich_markup_mode="markdown",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def print_version(wanted: bool) -> None:  # noqa: FBT001  # typer calls it so
    """Print the version and leave."""
    if wanted:
        typer.echo(f"pilotage {version('pilotage')}")
        raise typer.Exit


@app.callback()
def common(
    *,
    _version: Annotated[
        bool, typer.Option("--version", callback=print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Hold what all commands share."""


app.command()(cells)
app.command()(check)
app.command()(demo)
app.command()(localize)
app.command()(navigate)
app.command()(perceive)
app.command()(record)
app.command()(ros2)
app.command()(settings)
app.command()(simplify)
app.command()(table)
