"""`pilotage settings`: all that can be set, and what it is set to."""

from pathlib import Path
from typing import Annotated

import typer


def settings(
    file: Annotated[Path | None, typer.Argument(help="Settings to lay over the defaults (TOML).")] = None,
) -> None:
    """Print all settings as TOML: the defaults, or what a file makes of them.

    A file needs to name only what it changes. Names that are not known are refused.

    **Example:** `pilotage settings > mine.toml`, then `pilotage localize ... --settings mine.toml`
    """
    from pilotage.config import Settings, read_settings, settings_text

    typer.echo(settings_text(read_settings(file) if file is not None else Settings()), nl=False)
