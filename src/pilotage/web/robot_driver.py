"""A robot on the network in its worker: it moves only while a person at the page lets it."""

import signal
import sys
import time
from collections.abc import Mapping
from multiprocessing.connection import Connection

from pilotage.errors import PilotageError
from pilotage.navigation import Outcome
from pilotage.web.corrected import corrected_svg
from pilotage.web.driver import STATE_EVERY, Driver, send_fatal
from pilotage.web.order import FARTHEST, Order, RobotOrder, number, place
from pilotage.web.robot_show import RobotShow, show_robot

PATIENCE = 0.02
"""Time [s] that is waited for the robot before the page is heard again."""
PAGE_WITHIN = 1.0
"""A robot stands whose page has not been heard for this time [s]."""
MOST_MARKS = 300
"""Marks on the timeline."""
MAY_NOT_DRIVE = "no command can be sent: the table was not started with --drive"

Message = Mapping[str, object]


class RealRobotError(PilotageError):
    """A real robot is asked for what only a simulator can do, or for what it may not do now."""


def drive_robot(connection: Connection, order: Order, robot: RobotOrder) -> None:
    """Join a robot and show it, until the server ends this or closes the connection."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())  # the wheels are told to stand first
    try:
        show = show_robot(order, robot)
    except (PilotageError, ValueError) as error:
        send_fatal(connection, 0.0, error)
        return
    RobotDriver(connection, show, order, can_drive=robot.topics.drives).run()


class RobotDriver(Driver):
    """The loop of a real robot: hears it and the page, whichever speaks."""

    def __init__(self, connection: Connection, show: RobotShow, order: Order, *, can_drive: bool) -> None:
        super().__init__(connection, show, order)
        self._robot, self._can_drive = show, can_drive
        self._page_heard = 0.0  # [s] on the clock
        self._trouble = ""
        self._is_ended = False

    def run(self) -> None:
        """Go on until the server says that it is the end; the wheels stand however that comes."""
        try:
            self._introduce()
            self._tell()
            while not self._is_ended:
                self._hear_page()
                if self._robot.spin(PATIENCE):
                    self._step()
                self._hear_robot()
        finally:
            self._robot.live.forbid()

    def _hear_page(self) -> None:
        """Do what the page asks; a robot whose page is gone stands."""
        while self._connection.poll(0.0):
            self._obey(self._connection.recv())
        if self._drives and time.monotonic() - self._page_heard > PAGE_WITHIN:
            self._let_go("stopped: the page in command is not heard any more")

    def _hear_robot(self) -> None:
        """Pass on what the robot says, and take note of the end of a drive."""
        live = self._robot.live
        while self._robot.said:
            self._note("robot", self._robot.said.popleft())
        if live.is_over:
            live.is_over = False
            step = None if live.told is None else live.told.step
            if self._drives and step is not None and step.outcome is Outcome.REACHED:
                self._robot.goal = None
            self._let_go("")
            self._introduce()
        if live.trouble != self._trouble or time.monotonic() - self._told_at >= STATE_EVERY:
            self._trouble = live.trouble
            self._tell()

    @property
    def _drives(self) -> bool:
        """Whether commands are sent."""
        return self._robot.live.is_allowed

    def _let_go(self, why: str) -> None:
        """Let the wheels stand, and send nothing until a person allows it again."""
        if self._drives:
            self._robot.live.forbid()
            if why:
                self._note("fate", why)
        self._tell()

    def _note(self, kind: str, text: str) -> None:
        """Put a mark on the timeline."""
        del self._marks[: max(0, len(self._marks) + 1 - MOST_MARKS)]
        self._mark(kind, text)

    def _tell(self) -> None:
        """Say how the drive as a whole is."""
        self._told_at = time.monotonic()
        told = {
            "can_drive": self._can_drive,
            "drives": self._drives,
            "trouble": self._robot.live.trouble,
            "goal": self._robot.goal_name,
        }
        self._send("state", {"paused": not self._drives, "speed": 1.0, "over": False, "robot": told})

    def _obey(self, message: Message) -> None:
        """Do what the page asks; what cannot be done is said, and changes nothing."""
        kind = str(message.get("type"))
        handler = ROBOT_HANDLERS.get(kind)
        try:
            if handler is None:
                raise RealRobotError(f"{kind} is for simulated worlds: this robot is real")
            handler(self, message)
        except (PilotageError, ValueError) as error:
            self._send("error", {"text": str(error), "fatal": False})

    def _alive(self, _message: Message) -> None:
        self._page_heard = time.monotonic()

    def _drive(self, _message: Message) -> None:
        """Let the robot drive to its goal."""
        if not self._can_drive:
            raise RealRobotError(MAY_NOT_DRIVE)
        if self._drives:
            return
        refusal = self._robot.plan_again()
        if refusal:
            raise RealRobotError(refusal)
        self._page_heard = time.monotonic()
        self._robot.live.is_allowed = True
        self._note("fate", f"a person lets the robot drive to {self._robot.goal_name}")
        self._tell()

    def _set_goal(self, message: Message) -> None:
        refusal = self._robot.set_goal(place(message.get("goal"), "goal"))
        if refusal:
            raise RealRobotError(refusal)
        self._introduce()
        self._tell()

    def _begin_at(self, message: Message) -> None:
        """Take a start that a person tells."""
        x, y = (number(message, name, -FARTHEST, FARTHEST) for name in ("x", "y"))
        heading = number(message, "heading", -FARTHEST, FARTHEST)
        self._let_go("stopped: a person tells where the robot is")
        refusal = self._robot.begin_at(x, y, heading)
        if refusal:
            raise RealRobotError(refusal)
        self._note("fate", "a person tells where the robot is")

    def _stop(self, _message: Message) -> None:
        self._let_go("stopped by a person")

    def _gone(self, _message: Message) -> None:
        self._let_go("stopped: the page in command is gone")

    def _end(self, _message: Message) -> None:
        self._is_ended = True

    def _export(self, message: Message) -> None:
        if self._drives and message.get("kind") == "corrected":
            failure = "the drawing is corrected while the robot stands: stop it first"
            self._connection.send(
                ("exported", self._show.stamp, {"path": str(message["path"]), "failure": failure})
            )
        else:
            super()._export(message)

    def _corrected(self) -> str:
        """Correct the drawing by what was seen so far."""
        return corrected_svg(self._robot.atlas, self._robot.sightings)


ROBOT_HANDLERS = {
    "alive": RobotDriver._alive,  # noqa: SLF001  # a table of its own methods
    "drive": RobotDriver._drive,  # noqa: SLF001
    "goal": RobotDriver._set_goal,  # noqa: SLF001
    "place": RobotDriver._begin_at,  # noqa: SLF001
    "stop": RobotDriver._stop,  # noqa: SLF001
    "gone": RobotDriver._gone,  # noqa: SLF001
    "end": RobotDriver._end,  # noqa: SLF001
    "export": RobotDriver._export,  # noqa: SLF001
}
"""What messages of the page and of the server do."""
