"""`pilotage table`: draw a map in the browser, and watch a robot find its way by it."""

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer

from pilotage.cli.terminal import say
from pilotage.errors import PilotageError

NEEDED = ("starlette", "uvicorn", "websockets")
"""What the extra `web` installs."""


def table(
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
) -> None:
    """Open a page on which to draw a building, mark a goal, and watch a robot drive there.

    Drawings are kept in the folder, as SVG. Only this machine can reach the page, unless `--host` says
    otherwise, and only who knows its address with the token. The page loads nothing from elsewhere.

    **Examples:**

    - `pilotage table drawings`
    - Print the address alone: `pilotage table drawings --port 9000 --no-browser`
    - For others in the network: `pilotage table drawings --host 0.0.0.0 --token "$(openssl rand -hex 16)"`
    """
    missing = [name for name in NEEDED if find_spec(name) is None]
    if missing:
        raise PilotageError(
            f"the drawing table needs {', '.join(missing)}: `pip install 'pilotage[web]'` installs it"
        )
    from pilotage.web.serve import Address, serve

    serve(folder, Address(host, port, token), browse=browser, say=say)
