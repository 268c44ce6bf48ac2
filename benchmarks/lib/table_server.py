"""A drawing table in a process of its own, and a client that talks to it, for the benchmark `table`."""

import json
import os
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from websockets.sync.client import ClientConnection, connect

TOKEN = "a-token-of-the-benchmark"  # noqa: S105  # of a server that lives for a minute
TICK = os.sysconf("SC_CLK_TCK") if hasattr(os, "sysconf") else 100


@dataclass(frozen=True, slots=True)
class TableServer:
    """A server that runs."""

    process: int  # its id
    port: int
    started: float  # [s] on the clock

    @property
    def headers(self) -> dict[str, str]:
        """What a request must hold."""
        return {"Authorization": f"Bearer {TOKEN}"}

    def ask(self, path: str, body: bytes | None = None, media: str = "image/svg+xml") -> bytes:
        """Ask for something."""
        url = f"http://127.0.0.1:{self.port}{path}"
        headers = self.headers if body is None else {**self.headers, "Content-Type": media}
        with urllib.request.urlopen(urllib.request.Request(url, body, headers)) as answer:
            content: bytes = answer.read()
        return content

    def end_drives(self) -> None:
        """End all drives; one that is no longer watched goes on, and counts among the eight that may."""
        for drive in json.loads(self.ask("/api/sessions"))["sessions"]:
            url = f"http://127.0.0.1:{self.port}/api/sessions/{drive['session']}"
            urllib.request.urlopen(urllib.request.Request(url, headers=self.headers, method="DELETE")).close()

    def cpu(self) -> float:
        """Return the time [s] of the processor that the server itself, without its workers, has used."""
        fields = Path(f"/proc/{self.process}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / TICK

    @contextmanager
    def live(self, **order: object) -> Iterator[ClientConnection]:
        """Start a drive."""
        address = f"ws://127.0.0.1:{self.port}/api/live"
        with connect(address, additional_headers=self.headers, max_size=None) as websocket:
            websocket.send(json.dumps({"v": 1, "type": "start", **order}))
            yield websocket


def heard(websocket: ClientConnection, until: float) -> Iterator[dict[str, Any]]:
    """Receive messages until a time on the clock [s]."""
    while (left := until - time.monotonic()) > 0.0:
        try:
            yield json.loads(websocket.recv(timeout=left))
        except TimeoutError:
            return


@contextmanager
def serving(folder: Path) -> Iterator[TableServer]:
    """Start the command, as a user does, and stop it in the end."""
    words = ["table", str(folder), "--no-browser", "--port", "0", "--token", TOKEN]
    started = time.monotonic()
    command = [sys.executable, "-c", "from pilotage.cli import main; main()", *words]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:  # noqa: S603
        assert process.stderr is not None
        try:
            address = process.stderr.readline().split()[-1]
            port = int(address.partition("127.0.0.1:")[2].partition("/")[0])
            yield TableServer(process.pid, port, started)
        finally:
            process.terminate()
            process.wait()
