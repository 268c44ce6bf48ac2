"""A drive in its worker: obeys the page, keeps to the clock, and tells what happens."""

import json
import time
from collections.abc import Mapping, Sequence
from multiprocessing.connection import Connection, wait
from pathlib import Path

from pilotage.errors import FileError, PilotageError
from pilotage.navigation import Step
from pilotage.web.bending import Bending
from pilotage.web.corrected import corrected_svg
from pilotage.web.drawings import UnreadableError
from pilotage.web.exports import write_export
from pilotage.web.fate import FATES
from pilotage.web.marks import changes, mark
from pilotage.web.order import FARTHEST, SPEEDS, Order, number, place, switch
from pilotage.web.playback import Playback
from pilotage.web.replay import Replay
from pilotage.web.show import Show
from pilotage.web.stage import Stage, set_stage

FRAME_EVERY = 1.0 / 20.0
"""Shortest time [s] on the clock between two frames."""
RECORD_EVERY = 0.5
"""Longest time [s] of the drive between two frames: a fast drive sends more, for the timeline."""
LATE = 0.5
"""A drive that is later than this [s] does not try to catch up."""
STATE_EVERY = 1.0
"""Time [s] on the clock between two messages about the drive as a whole."""
POLITE = 5
"""Added to the niceness of a drive, so that the page is answered first."""

Message = Mapping[str, object]


class WatchedError(PilotageError):
    """A recording is asked for what only a drive can do."""


def drive_in_worker(connection: Connection, order: Order) -> None:
    """Prepare a drive and go through it, until the server closes the connection."""
    be_polite()
    try:
        show = set_stage(order)
    except (PilotageError, ValueError) as error:
        send_fatal(connection, 0.0, error)
        return
    try:
        Driver(connection, show, order).run()
    except FileError as error:  # a recording that breaks off; its file may be one that the server named
        send_fatal(connection, show.stamp, UnreadableError(error.rule))


def send_fatal(connection: Connection, t: float, error: Exception) -> None:
    """Say why there will be no drive, or why it cannot go on at this time of it [s]."""
    connection.send(("error", t, {"v": 1, "type": "error", "text": str(error), "fatal": True}))


class Driver:
    """The loop of a drive, as `pilotage.drives.drive`, with a page that interferes."""

    def __init__(self, connection: Connection, show: Show, order: Order) -> None:
        self._connection = connection
        self._show = show
        self._order = order
        self._speed, self._paused = order.speed, order.paused
        self._before: Step | None = None
        self._marks: list[dict[str, object]] = []
        self._over = False
        self._bending: Bending | None = None
        if isinstance(show, Stage | Replay):
            self._bending = Bending(show.navigator.planner.atlas, show.sightings, connection)
        self._due = self._frame_due = self._told_at = 0.0  # [s] on the clock
        self._shown_t = -RECORD_EVERY  # [s] of the drive

    def run(self) -> None:
        """Begin, and go on until the connection is closed."""
        self._introduce()
        self._due = time.monotonic()
        self._step()
        self._tell()
        while True:
            self._listen(None if self._stands else max(self._due - time.monotonic(), 0.0))
            if not self._stands and time.monotonic() >= self._due:
                self._step()
                self._pace()

    def _listen(self, longest: float | None) -> None:
        """Obey the page, and pass on how the drawing was corrected, as they come; wait for the first [s]."""
        bending = self._bending
        while ready := wait([self._connection, *([] if bending is None else bending.pipes)], longest):
            if self._connection in ready:
                self._obey(self._connection.recv())
            elif bending is not None:
                if (corrected := bending.result()) is not None:
                    self._send("corrected", {"t": round(self._show.stamp, 2), **corrected})
                bending.begin_if_due(is_over=self._over)
            longest = 0.0

    def _introduce(self) -> None:
        """Say what this drive is about."""
        how = {"speed": self._speed, "paused": self._paused, "over": self._over}
        self._send("session", {**self._show.describe(self._order.title), **how})
        self._show_world()
        if isinstance(self._show, Playback):
            self._mark_all(self._show.steps)

    def _show_world(self) -> None:
        """Show all that stands, where it is known."""
        world = self._show.describe_world()
        if world is not None:
            self._send("world", world)

    @property
    def _stage(self) -> Stage:
        """The stage of a drive; WatchedError if this is none."""
        if not isinstance(self._show, Stage):
            raise WatchedError("a recording can only be watched")
        return self._show

    @property
    def _stands(self) -> bool:
        """Whether nothing happens until the page asks for it."""
        return self._paused or self._over

    def _pace(self) -> None:
        """Say when the next step is due."""
        now = time.monotonic()
        self._due += self._show.time_step / self._speed
        if now - self._due > LATE:
            self._due = now
        if now - self._told_at >= STATE_EVERY:
            self._tell()

    def _step(self) -> None:
        """Go on; show it if a frame is due."""
        step = self._show.step()
        if not isinstance(self._show, Playback):
            self._mark_all([step])
        now, t = time.monotonic(), self._show.stamp
        is_due = now >= self._frame_due or t - self._shown_t >= RECORD_EVERY
        if is_due or self._show.is_over or self._paused:
            self._frame_due, self._shown_t = max(self._frame_due + FRAME_EVERY, now), t
            self._send_frame()
        if self._show.is_over and step.outcome is not None:
            self._finish(step.outcome.value, step.reason)
        elif self._show.is_over:
            self._finish("over", "the recording ends here")
        if self._bending is not None:
            self._bending.begin_if_due(is_over=self._over)

    def _send_frame(self) -> None:
        """Send a frame, as text: the server passes it on unread."""
        text = json.dumps(self._show.frame(), separators=(",", ":"), allow_nan=False)
        self._connection.send(("frame", self._show.stamp, text))

    def _finish(self, outcome: str, reason: str) -> None:
        """Say that the drive is over; it goes on with another goal, or at another moment."""
        self._over = True
        text = f"{outcome}: {reason}" if reason else outcome
        self._send("done", {"outcome": outcome, "reason": reason, "text": text})
        self._tell()

    def _mark_all(self, steps: Sequence[Step]) -> None:
        """Put marks on the timeline where something changes."""
        count, first = len(self._marks), steps[0].stamp if isinstance(self._show, Playback) else 0.0
        for step in steps:
            for kind, text in changes(self._before, step, self._show.graph):
                self._marks.append(mark(step.stamp - first, kind, text))
            self._before = step
        if len(self._marks) > count:
            self._send("marks", {"marks": self._marks})

    def _mark(self, kind: str, text: str) -> None:
        """Put a mark on the timeline, and send all of them."""
        self._marks.append(mark(self._show.stamp, kind, text))
        self._send("marks", {"marks": self._marks})

    def _tell(self) -> None:
        """Say how the drive as a whole is."""
        self._told_at = time.monotonic()
        known = {"recorded": [0.0, self._show.end]} if isinstance(self._show, Playback) else {}
        self._send("state", {"paused": self._paused, "speed": self._speed, "over": self._over, **known})

    def _send(self, kind: str, fields: Message) -> None:
        """Send a message to the server."""
        self._connection.send((kind, self._show.stamp, {"v": 1, "type": kind, **fields}))

    def _obey(self, message: Message) -> None:
        """Do what the page asks; what cannot be done is said, and changes nothing."""
        try:
            kind = str(message.get("type"))
            if kind in FATES:
                self._mark("fate", FATES[kind](self._stage, message))
                self._show_world()
                if self._stands:
                    self._stage.look_again()
                    self._send_frame()
            elif kind in HANDLERS:
                HANDLERS[kind](self, message)
        except (PilotageError, ValueError) as error:
            self._send("error", {"text": str(error), "fatal": False})

    def _pause(self, message: Message) -> None:
        self._paused = switch(message, "paused", otherwise=True)
        self._due = time.monotonic()
        self._tell()

    def _step_once(self, _message: Message) -> None:
        self._paused = True
        if not self._over:
            self._step()
        self._tell()

    def _set_speed(self, message: Message) -> None:
        self._speed = number(message, "speed", *SPEEDS)
        self._due = time.monotonic()
        self._tell()

    def _set_goal(self, message: Message) -> None:
        self._stage.set_goal(place(message.get("goal"), "goal"))
        self._mark("fate", f"the goal is now {self._stage.goal_name}")
        self._over, self._due = False, time.monotonic()
        self._introduce()
        self._tell()

    def _seek(self, message: Message) -> None:
        """Show another moment of a journal, and go on from there."""
        if isinstance(self._show, Playback):
            self._show.seek(number(message, "t", 0.0, FARTHEST))
            self._over, self._due, self._shown_t = False, time.monotonic(), -RECORD_EVERY
            self._step()
            self._tell()

    def _stop(self, _message: Message) -> None:
        if not self._over:
            self._finish("stopped", "")

    def _export(self, message: Message) -> None:
        """Write what a person wants to keep to a file that the server made, and answer by its name."""
        path, kind = Path(str(message["path"])), str(message["kind"])
        failure = ""
        try:
            if kind == "corrected":
                path.write_text(self._corrected(), encoding="utf-8")
            else:
                write_export(kind, self._stage.record(), path, self._order.title)
        except (PilotageError, ValueError, OSError, MemoryError) as error:
            failure = str(error) or "there is not enough memory"
        self._connection.send(("exported", self._show.stamp, {"path": str(path), "failure": failure}))
        self._due = time.monotonic()

    def _corrected(self) -> str:
        """Correct the drawing by what was seen so far."""
        if not isinstance(self._show, Stage | Replay):
            raise WatchedError("a journal holds no scans by which to correct a drawing")
        return corrected_svg(self._show.navigator.planner.atlas, self._show.sightings)


HANDLERS = {
    "pause": Driver._pause,  # noqa: SLF001  # a table of its own methods
    "step": Driver._step_once,  # noqa: SLF001
    "speed": Driver._set_speed,  # noqa: SLF001
    "goal": Driver._set_goal,  # noqa: SLF001
    "seek": Driver._seek,  # noqa: SLF001
    "stop": Driver._stop,  # noqa: SLF001
    "export": Driver._export,  # noqa: SLF001
}
"""What the other messages do."""


def be_polite() -> None:
    """Let the server go first."""
    import os

    if hasattr(os, "nice"):
        os.nice(POLITE)
