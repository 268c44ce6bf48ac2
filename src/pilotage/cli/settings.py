"""`pilotage settings`: all settings, their values and what they mean."""

from pathlib import Path
from typing import Annotated

import typer


def settings(
    file: Annotated[
        Path | None, typer.Argument(help="A file that changes some of the defaults (TOML).")
    ] = None,
) -> None:
    """Print all settings as TOML, each with its unit and meaning: the defaults, or as a file changes them.

    A file names only the settings that it changes. Unknown names are errors.

    **Example:** `pilotage settings > mine.toml`, then `pilotage localize ... --settings mine.toml`
    """
    from pilotage.config import read_settings, settings_text

    typer.echo(settings_text(read_settings(file)), nl=False)
