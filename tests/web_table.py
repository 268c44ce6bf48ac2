"""What tests of the drawing table share."""

import asyncio
import json
from collections.abc import Callable, Coroutine
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any, TypeVar

from starlette.testclient import WebSocketTestSession

Result = TypeVar("Result")

TOKEN = "a-token-that-nobody-guesses"  # noqa: S105  # of servers that live for a test
HOST = "127.0.0.1:8765"
LIVE = f"ws://{HOST}/api/live"

FLAT = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 120" fill="none" stroke="black">
<path d="M10 10 H190 V110 H10 Z M10 60 H40 M55 60 H130 M145 60 H190"/>
<path d="M100 10 V28 M100 43 V80 M100 95 V110"/>
<text x="50" y="35">kitchen</text><text x="150" y="35">office</text>
<text x="50" y="90">hall</text><text x="150" y="90">store</text>
<circle class="goal" cx="30" cy="30" r="2"/></svg>
"""
"""Four rooms with doors."""

CONTENT = {"media": "image/svg+xml", "text": FLAT}

APART = FLAT.replace("</svg>", '<path d="M300 10 H340 V50 H300 Z"/><text x="320" y="30">shed</text></svg>')
"""The same, and a shed at some distance."""

CLOSED = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 120" fill="none" stroke="black">
<path d="M10 10 H190 V110 H10 Z M70 10 V40 M70 60 V110 M130 10 V110"/>
<text x="30" y="60">hall</text><text x="160" y="60">cell</text></svg>
"""
"""Three rooms, one of them without a door."""


def dxf(lines: list[tuple[float, float, float, float]]) -> str:
    """Write lines as the entities of a DXF file."""
    entities = "".join(
        f"0\nLINE\n8\nwalls\n10\n{x1}\n20\n{y1}\n11\n{x2}\n21\n{y2}\n" for x1, y1, x2, y2 in lines
    )
    return f"0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"


TWO_ROOMS = dxf([(0, 0, 8, 0), (8, 0, 8, 5), (8, 5, 0, 5), (0, 5, 0, 0), (4, 0, 4, 2), (4, 3, 4, 5)])
"""Two rooms with a door, as DXF: y up."""


def finished(work: Coroutine[Any, Any, Result]) -> Result:
    """Run to the end in a thread of its own: a browser of other tests may keep a loop in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, work).result()


class Talk:
    """A websocket to the server, whose messages can be waited for by kind; those of other kinds are kept."""

    def __init__(self, websocket: WebSocketTestSession) -> None:
        self._websocket = websocket
        self._kept: dict[str, list[dict[str, Any]]] = {}

    def say(self, kind: str, **fields: object) -> None:
        """Send a message."""
        self._websocket.send_text(json.dumps({"v": 1, "type": kind, **fields}))

    def hear(self, kind: str) -> dict[str, Any]:
        """Return the next message of a kind; a drive that ends for good meanwhile fails the test."""
        while not self._kept.get(kind):
            message = json.loads(self._websocket.receive_text())
            self._kept.setdefault(message["type"], []).append(message)
            assert kind == message["type"] or not message.get("fatal"), message["text"]
        return self._kept[kind].pop(0)

    def hear_until(self, kind: str, is_right: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        """Return the next message of a kind for which something holds."""
        return next(message for message in iter(partial(self.hear, kind), None) if is_right(message))

    def start(self, **fields: object) -> dict[str, Any]:
        """Start a drive through the flat, made real, and return what it is."""
        real = {"severity": 0.4, "seed": 3}
        self.say("start", **{"content": CONTENT, "goal": "store", "speed": 20, "made_real": real, **fields})
        return self.hear("session")
