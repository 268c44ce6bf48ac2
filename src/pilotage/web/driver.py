"""A drive in its worker: obeys the page, keeps to the clock, and tells what happens."""

import json
import time
from collections.abc import Mapping
from multiprocessing.connection import Connection
from pathlib import Path

from pilotage.drives import Drive, Instant
from pilotage.errors import PilotageError
from pilotage.localization import Status
from pilotage.navigation import Outcome, Step
from pilotage.web.fate import FATES
from pilotage.web.frames import Cloud, FrameMaker
from pilotage.web.order import SPEEDS, Order, number, place, switch
from pilotage.web.replay import Replay, ReplayError
from pilotage.web.stage import Stage, set_stage
from pilotage.web.words import name_of

FRAME_EVERY = 1.0 / 20.0
"""Time [s] on the clock between frames, at least,"""
RECORD_EVERY = 0.5
"""and time [s] of the drive, at most."""
LATE = 0.5
"""A drive that is later than this [s] does not try to catch up."""
STATE_EVERY = 1.0
"""Time [s] on the clock between two messages about the drive as a whole."""
MOST_INSTANTS = 40_000
"""Steps that are kept for journal and film: more than an hour."""
POLITE = 5
"""Added to the niceness of a drive, so that the page is answered first."""

Message = Mapping[str, object]


def drive_in_worker(connection: Connection, order: Order) -> None:
    """Prepare a drive and go through it, until the server closes the connection."""
    be_polite()
    try:
        stage = set_stage(order)
    except (PilotageError, ValueError) as error:
        connection.send(("error", 0.0, {"v": 1, "type": "error", "text": str(error), "fatal": True}))
        return
    Driver(connection, stage, order).run()


class Driver:
    """The loop of a drive, as `pilotage.drives.drive`, with a page that interferes."""

    def __init__(self, connection: Connection, stage: Stage | Replay, order: Order) -> None:
        self._connection = connection
        self._stage = stage
        self._order = order
        self._speed, self._paused = order.speed, order.paused
        self._frames = FrameMaker(
            stage.navigator,
            stage.page,
            Cloud(stage.localizer),
            stage.truth,
            shows_world=isinstance(stage, Stage),
        )
        self._instants: list[Instant] = []
        self._marks: list[dict[str, object]] = []
        self._over = False
        self._due = self._shown_at = self._told_at = 0.0  # [s] on the clock
        self._shown_t = -RECORD_EVERY  # [s] of the drive

    def run(self) -> None:
        """Begin, and go on until the connection is closed."""
        self._introduce()
        self._due = time.monotonic()
        self._step()
        self._tell()
        while True:
            wait = None if self._stands else max(self._due - time.monotonic(), 0.0)
            while self._connection.poll(wait):
                self._obey(self._connection.recv())
                wait = 0.0
            if not self._stands and time.monotonic() >= self._due:
                self._step()
                self._pace()

    def _introduce(self) -> None:
        """Say what this drive is about."""
        how = {"speed": self._speed, "paused": self._paused, "over": self._over}
        self._send("session", {**self._stage.describe(self._order.title), **how})
        self._show_world()

    def _show_world(self) -> None:
        """Show all that stands, where it is known."""
        world = self._stage.describe_world()
        if world is not None:
            self._send("world", world)

    @property
    def _simulated(self) -> Stage:
        """The stage of a drive; ReplayError if it is that of a log."""
        if isinstance(self._stage, Replay):
            raise ReplayError("a log can only be watched")
        return self._stage

    @property
    def _stands(self) -> bool:
        """Whether nothing happens until the page asks for it."""
        return self._paused or self._over

    def _pace(self) -> None:
        """Say when the next step is due."""
        now = time.monotonic()
        self._due += self._stage.time_step / self._speed
        if now - self._due > LATE:
            self._due = now
        if now - self._told_at >= STATE_EVERY:
            self._tell()

    def _step(self) -> None:
        """Read, step, move; show it if a frame is due."""
        stage = self._stage
        before = self._instants[-1].step if self._instants else None
        instant = stage.step()
        self._frames.cloud.note(stage.navigator.position.odom_from_base)
        self._instants.append(instant)
        del self._instants[: max(0, len(self._instants) - MOST_INSTANTS)]
        self._note_changes(before, instant.step)
        now, t = time.monotonic(), instant.step.stamp
        over = instant.step.outcome is not None or stage.is_over
        is_due = now - self._shown_at >= FRAME_EVERY or t - self._shown_t >= RECORD_EVERY
        if is_due or over or self._paused:
            self._shown_at, self._shown_t = now, t
            self._show(instant)
        if instant.step.outcome is not None:
            self._finish(instant.step.outcome.value, instant.step.reason)
        elif stage.is_over:
            self._finish("over", "the log ends here")

    def _show(self, instant: Instant) -> None:
        """Send a frame, as text: the server passes it on unread."""
        frame = self._frames.frame(instant, instant.step.stamp, self._stage.goal_name)
        text = json.dumps(frame, separators=(",", ":"), allow_nan=False)
        self._connection.send(("frame", instant.step.stamp, text))

    def _finish(self, outcome: str, reason: str) -> None:
        """Say that the drive is over; it goes on if the page sets another goal."""
        self._over = True
        text = f"{outcome}: {reason}" if reason else outcome
        self._send("done", {"outcome": outcome, "reason": reason, "text": text})
        self._tell()

    def _note_changes(self, before: Step | None, now: Step) -> None:
        """Put marks on the timeline where something changes."""
        graph = self._stage.navigator.planner.graph
        was = before.estimate.status if before is not None else Status.LOST
        status = now.estimate.status
        if status is not was:
            place_name = name_of(now.estimate.cell_id, graph)
            kind, words = {
                Status.LOCATED: ("found", f"believes to be in {place_name}"),
                Status.LOST: ("lost", "does not know where it is any more"),
                Status.MISMATCH: ("mismatch", "what it sees does not fit this drawing"),
            }[status]
            self._mark(kind, words)
        old = before.closed_gateway_ids if before is not None else ()
        for gateway_id in now.closed_gateway_ids:
            if gateway_id not in old:
                self._mark("blocked", f"found no way through {gateway_id}")
        if now.outcome is not None:
            kind = "reached" if now.outcome is Outcome.REACHED else "gave up"
            self._mark(kind, now.reason or now.outcome.value)

    def _mark(self, kind: str, text: str) -> None:
        """Put a mark on the timeline, and send all of them."""
        self._marks.append({"t": round(self._stage.stamp, 2), "kind": kind, "text": text})
        self._send("marks", {"marks": self._marks})

    def _tell(self) -> None:
        """Say how the drive as a whole is."""
        self._told_at = time.monotonic()
        self._send("state", {"paused": self._paused, "speed": self._speed, "over": self._over})

    def _send(self, kind: str, fields: Message) -> None:
        """Send a message to the server."""
        self._connection.send((kind, self._stage.stamp, {"v": 1, "type": kind, **fields}))

    def _obey(self, message: Message) -> None:
        """Do what the page asks; what cannot be done is said, and changes nothing."""
        try:
            kind = str(message.get("type"))
            if kind in FATES:
                self._mark("fate", FATES[kind](self._simulated, message))
                self._show_world()
                self._show_again()
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

    def _stop(self, _message: Message) -> None:
        if not self._over:
            self._finish("stopped", "")

    def _show_again(self) -> None:
        """Show a change at once if the drive stands."""
        if self._stands:
            last = self._instants[-1]
            self._show(Instant(last.step, self._simulated.simulator.scene, last.step_ms))

    def _export(self, message: Message) -> None:
        """Write what a person wants to keep to a file that the server made, and answer by its name."""
        path, kind = Path(str(message["path"])), str(message["kind"])
        failure = ""
        try:
            planner = self._stage.navigator.planner
            drive = Drive.of(planner.atlas, self._simulated.simulator.world, planner.goal, self._instants)
            write_export(kind, drive, path, self._order.title)
        except (PilotageError, OSError, MemoryError) as error:
            failure = str(error) or "there is not enough memory"
        self._connection.send(("exported", self._stage.stamp, {"path": str(path), "failure": failure}))
        self._due = time.monotonic()


HANDLERS = {
    "pause": Driver._pause,  # noqa: SLF001  # a table of its own methods
    "step": Driver._step_once,  # noqa: SLF001
    "speed": Driver._set_speed,  # noqa: SLF001
    "goal": Driver._set_goal,  # noqa: SLF001
    "stop": Driver._stop,  # noqa: SLF001
    "export": Driver._export,  # noqa: SLF001
}
"""What the other messages do."""


def write_export(kind: str, drive: Drive, path: Path, title: str) -> None:
    """Write a journal, a film or a picture."""
    if kind == "journal":
        from pilotage.io.journal import journal_file

        with journal_file(path, drive.sketch) as write:
            for step, scene in zip(drive.steps, drive.scenes, strict=True):
                write(step, scene)
    elif kind == "film":
        from pilotage.figures.animation import animate

        animate(drive, path)
    else:
        from pilotage.figures.drive import drive_figure
        from pilotage.figures.style import save

        save(drive_figure(drive, title), path)


def be_polite() -> None:
    """Let the server go first."""
    import os

    if hasattr(os, "nice"):
        os.nice(POLITE)
