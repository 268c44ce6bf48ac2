"""Run the server until it is interrupted."""

import secrets
import socket
import threading
import webbrowser
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from pilotage.errors import FileError, PilotageError
from pilotage.web.folder import Folder
from pilotage.web.guard import Access
from pilotage.web.order import RobotOrder

if TYPE_CHECKING:
    from pilotage.config import Settings

LOCAL = "127.0.0.1"
"""The address that only this machine can reach, ..."""
LOCAL_NAME = "localhost"
"""... and its name."""
PORTS_TRIED = 20
"""Ports after the wanted one that are tried if it is taken."""
SHORTEST_TOKEN = 16
"""Letters of a token for a server that others can reach."""
FEW_FRAMES = 1 << 16
"""Bytes that wait in the system for a client that is slow: what is in there is old when it arrives."""
MOST_WAITING = 64
"""Requests that wait until the server takes them."""


class ServerError(PilotageError):
    """The server cannot be started as asked."""


@dataclass(frozen=True, slots=True)
class Address:
    """Where the server is to be found."""

    host: str = LOCAL
    port: int = 8765
    token: str = ""  # a random one if it is empty


def serve(
    folder: Path,
    wanted: Address,
    *,
    browse: bool,
    say: Callable[[str], None],
    robot: RobotOrder | None = None,
    settings: "Settings | None" = None,
) -> None:
    """Serve a folder until the process is interrupted; `say` is told the address to open.

    Raises FileError if there is no such folder, ServerError if the address will not do.
    """
    if folder.is_file():
        raise FileError("a folder of drawings is expected, found a file", folder)
    if not folder.is_dir():
        raise FileError("the folder of drawings must exist", folder)
    is_local = wanted.host in (LOCAL, LOCAL_NAME)
    if not is_local and len(wanted.token) < SHORTEST_TOKEN:
        raise ServerError(
            f"a server that others can reach needs --token with {SHORTEST_TOKEN} letters or more,"
            f" got {len(wanted.token)}"
        )
    import uvicorn

    from pilotage.web.app import build_app
    from pilotage.web.live_routes import LARGEST_MESSAGE
    from pilotage.web.table import Table

    listening = listen(wanted.host, wanted.port)
    port = listening.getsockname()[1]
    token = wanted.token or secrets.token_urlsafe(24)
    hosts = frozenset(f"{name}:{port}" for name in (wanted.host, LOCAL, LOCAL_NAME))
    app = build_app(Table(Folder(folder), robot, settings), Access(token, hosts, any_host=not is_local))
    server = uvicorn.Server(
        uvicorn.Config(
            app,
            log_level="error",
            access_log=False,
            server_header=False,
            ws_max_size=LARGEST_MESSAGE,
            ws_per_message_deflate=False,
            timeout_graceful_shutdown=1,
            backlog=MOST_WAITING,
        )
    )
    shown = LOCAL if wanted.host in (LOCAL, "0.0.0.0") else wanted.host  # noqa: S104  # compared, not bound
    url = f"http://{shown}:{port}/?token={token}"
    say(f"The drawing table is at {url}")
    if browse:
        threading.Timer(0.3, webbrowser.open, [url]).start()
    server.run(sockets=[listening])


def listen(host: str, port: int) -> socket.socket:
    """Open the wanted port, or the next one that is free; ServerError if there is none."""
    for candidate in range(port, port + PORTS_TRIED) if port else (0,):
        opened = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, FEW_FRAMES)
        try:
            opened.bind((host, candidate))
            opened.listen(MOST_WAITING)  # who asks before the server is ready waits, and is not turned away
        except (OSError, OverflowError) as error:
            opened.close()
            problem = error
        else:
            return opened
    raise ServerError(f"no port from {port} on can be opened on {host} ({problem})")
