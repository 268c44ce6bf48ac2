"""Drives as the server sees them: a worker each, what it said last, and those who watch."""

import asyncio
import contextlib
import json
import secrets
import tempfile
import threading
import time
from collections.abc import Mapping
from pathlib import Path

from pilotage.web.history import History
from pilotage.web.order import Order, RobotOrder
from pilotage.web.work import drive
from pilotage.web.workers import Worker, WorkerError, start

TOLD_FIRST = ("session", "command", "world", "marks", "state", "corrected", "frame", "done", "error")
"""Order in which a client gets what waits for it."""
MOST_UNSEEN = 3
"""Frames that a client gets before it has seen the first of them."""
MOST_GOING = 8
"""Drives that go on at the same time."""
MOST_KEPT = 16
"""Drives that are remembered; the oldest that is over is forgotten first."""
FORGOTTEN_AFTER = 1800.0
"""A drive that stands and that nobody watches is forgotten after this time [s]."""
EXPORT_WITHIN = 180.0
"""Time [s] to make a film."""
EXPORTS = {"journal": ".jsonl", "film": ".gif", "picture": ".png", "corrected": ".svg"}
"""What can be kept of a drive, and the ending of its file."""
CRASHED = "the process of this drive ended unexpectedly; what was recorded stays, start it again to drive on"

Message = Mapping[str, object]


class Client:
    """Someone who watches: of each kind of message only the newest waits, so that nothing piles up.

    A client that says which frames it has seen is never more than a few behind; to others frames are sent as
    fast as their connection takes them.
    """

    def __init__(self) -> None:
        self.scrubs = False  # looks at the past; frames of now are not for it
        self._tells = False  # says what it has seen
        self._unseen = 0  # frames that were sent and not seen yet
        self._waiting: dict[str, str] = {}
        self._something = asyncio.Event()

    def put(self, kind: str, text: str) -> None:
        """Let a message wait, in place of an older one of its kind."""
        self._waiting[kind] = text
        self._something.set()

    def saw(self) -> None:
        """Note that a frame was seen."""
        self._tells = True
        self._unseen = max(self._unseen - 1, 0)
        self._something.set()

    async def take(self) -> list[str]:
        """Wait until there is something to send, and take all of it."""
        while True:
            await self._something.wait()
            self._something.clear()
            is_behind = self._tells and self._unseen >= MOST_UNSEEN
            kinds = [
                kind for kind in TOLD_FIRST if kind in self._waiting and (kind != "frame" or not is_behind)
            ]
            if kinds:
                self._unseen += "frame" in kinds
                return [self._waiting.pop(kind) for kind in kinds]


class Session:
    """A drive: passes on what its worker says, and remembers enough for who comes later."""

    def __init__(self, order: Order, worker: Worker) -> None:
        self.number = secrets.token_urlsafe(9)
        self.order = order
        self.title = order.title
        self.history = History()
        self.clients: set[Client] = set()
        self.t = 0.0  # [s] of the drive, of what was said last
        self.outcome: str | None = None
        self.crashed = False
        self.stands = False
        self.seeks = False  # any moment can be asked for, what has not been shown too
        self.watched_at = time.monotonic()
        self._said: dict[str, str] = {}
        self._exports: dict[str, asyncio.Future[str]] = {}
        self._worker = worker
        self._loop = asyncio.get_running_loop()
        threading.Thread(target=self._listen, daemon=True, name=f"drive {self.number}").start()

    @property
    def over(self) -> bool:
        """Whether nothing more will come."""
        return self.crashed or self.outcome is not None

    def tell(self, message: Message) -> None:
        """Pass a message on to the worker; one that is gone does not mind."""
        with contextlib.suppress(OSError, ValueError):
            self._worker.connection.send(message)

    def refusal(self, _kind: str, _client: Client) -> str:
        """Say why a client may not do what it asks; empty if it may."""
        return ""

    def resume(self) -> None:
        """Let the next client know that it comes back to something."""
        said = self._said.get("session")
        if said is not None:
            self._said["session"] = said.replace('"resumed":false', '"resumed":true', 1)

    def join(self, client: Client) -> None:
        """Let a client watch: first it hears all that it needs to know."""
        self.clients.add(client)
        for kind, text in self._said.items():
            client.put(kind, text)

    def leave(self, client: Client) -> None:
        """Let a client go."""
        self.clients.discard(client)
        self.watched_at = time.monotonic()

    def is_watched_beside(self, client: Client) -> bool:
        """Tell whether others than this client watch."""
        return bool(self.clients - {client})

    def scrub(self, client: Client, t: float | None) -> None:
        """Show a client a moment of the past, or what is now."""
        client.scrubs = t is not None
        frame = self._said.get("frame") if t is None else self.history.at(t)
        if frame is not None:
            client.put("frame", frame if t is None else frame.replace('"live":true', '"live":false', 1))

    async def export(self, kind: str, folder: Path) -> Path:
        """Let the worker write a file; WorkerError if it cannot."""
        if self.crashed:
            raise WorkerError(CRASHED)
        path = folder / f"drive-{secrets.token_hex(4)}{EXPORTS[kind]}"
        written: asyncio.Future[str] = self._loop.create_future()
        self._exports[str(path)] = written
        self.tell({"type": "export", "kind": kind, "path": str(path)})
        try:
            failure = await asyncio.wait_for(written, EXPORT_WITHIN)
        except TimeoutError as error:
            raise WorkerError(f"the {kind} took longer than {EXPORT_WITHIN:g} s") from error
        finally:
            self._exports.pop(str(path), None)
        if failure:
            raise WorkerError(failure)
        return path

    def end(self) -> None:
        """End the worker."""
        self._worker.end()

    def _listen(self) -> None:
        """Hear the worker, in a thread of its own, until it ends."""
        try:
            while True:
                self._loop.call_soon_threadsafe(self._hear, *self._worker.connection.recv())
        except (EOFError, OSError):
            with contextlib.suppress(RuntimeError):  # the server has ended before the worker
                self._loop.call_soon_threadsafe(self._hear_end)
        self._worker.tidy()

    def _hear(self, kind: str, t: float, said: "str | dict[str, object]") -> None:
        """Pass on what the worker said."""
        self.t = max(self.t, t)
        if isinstance(said, str):
            self.history.add(t, said)
            self._pass_on(kind, said)
        elif kind == "exported":
            written = self._exports.pop(str(said["path"]), None)
            if written is not None and not written.done():
                written.set_result(str(said["failure"]))
        else:
            self._note(kind, said)
            self._pass_on(kind, json.dumps(said, separators=(",", ":")))

    def _note(self, kind: str, said: dict[str, object]) -> None:
        """Take note of what concerns the drive as a whole."""
        if kind == "session":
            self.seeks = said["kind"] == "journal"
            said |= {"session": self.number, "resumed": False}
        elif kind == "state":
            said.setdefault("recorded", self.history.span or None)
            self.stands = said["paused"] is True or said["over"] is True
            if said["over"] is False:
                self.outcome = None
                self._said.pop("done", None)
        elif kind == "done":
            self.outcome = str(said["outcome"])
        elif kind == "error" and said["fatal"] is True:
            self.crashed = True

    def _pass_on(self, kind: str, text: str) -> None:
        """Give a message to all who watch; errors are for those who are there now, unless they end all."""
        if kind != "error" or self.crashed:
            self._said[kind] = text
        for client in self.clients:
            if kind != "frame" or not client.scrubs:
                client.put(kind, text)

    def _hear_end(self) -> None:
        """Say that the worker is gone, if it did not say so itself."""
        for written in self._exports.values():
            if not written.done():
                written.set_result(CRASHED)
        if not self.crashed:
            self._hear("error", self.t, {"v": 1, "type": "error", "text": CRASHED, "fatal": True})


class Sessions:
    """All drives of this server."""

    def __init__(self) -> None:
        self._sessions: dict[str, Session] = {}
        self._beginning = asyncio.Lock()
        self._folder = tempfile.TemporaryDirectory(prefix="pilotage-table-")

    @property
    def folder(self) -> Path:
        """Where exports are written before they are sent."""
        return Path(self._folder.name)

    async def begin(self, order: Order) -> Session:
        """Begin a drive; WorkerError if too many go on. A robot that is watched already is gone back to."""
        async with self._beginning:  # else drives that begin together would not count each other
            if isinstance(order.world, RobotOrder):
                return await self._begin_robot(order)
            return await self._begin(order, Session)

    async def _begin_robot(self, order: Order) -> Session:
        """Go back to the robot if it is watched, else join it anew."""
        from pilotage.web.robot_sessions import RobotSession

        for one in self.all():
            if isinstance(one, RobotSession) and one.clients and not one.over:
                one.resume()
                return one
            if isinstance(one, RobotSession):
                await asyncio.to_thread(self.forget, one.number)
        return await self._begin(order, RobotSession)

    async def _begin(self, order: Order, kind: type[Session]) -> Session:
        """Start a worker."""
        if sum(not one.over for one in self._sessions.values()) >= MOST_GOING:
            raise WorkerError(f"{MOST_GOING} drives go on already, stop one first")
        self._forget_oldest()
        session = kind(order, await asyncio.to_thread(start, drive, order))
        self._sessions[session.number] = session
        return session

    def get(self, number: str) -> Session | None:
        """Return a drive by its number."""
        return self._sessions.get(number)

    def all(self) -> list[Session]:
        """Return all drives, the oldest first."""
        return list(self._sessions.values())

    def forget(self, number: str) -> bool:
        """End and forget a drive; False if there is none of this number."""
        session = self._sessions.pop(number, None)
        if session is not None:
            session.end()
        return session is not None

    def forget_unwatched(self, after: float = FORGOTTEN_AFTER) -> None:
        """Forget the drives that stand and that nobody has watched for a time [s]."""
        now = time.monotonic()
        for session in self.all():
            idle = not session.clients and now - session.watched_at > after
            if idle and (session.over or session.stands):
                self.forget(session.number)

    def close(self) -> None:
        """End all drives."""
        for session in self.all():
            self.forget(session.number)
        self._folder.cleanup()

    def _forget_oldest(self) -> None:
        """Make room for a new drive."""
        for session in self.all():
            if len(self._sessions) >= MOST_KEPT and session.over and not session.clients:
                self.forget(session.number)
