"""A robot on the network instead of a simulator: its scans are localized, and what is believed is shown."""

import time
from collections import deque
from dataclasses import replace

from pilotage.correction import Sighting
from pilotage.maps import Atlas, build_atlas
from pilotage.navigation import Behavior, Step
from pilotage.navigation.goal import find_goal
from pilotage.navigation.steering import STILL
from pilotage.ros.robot import LiveRobot
from pilotage.ros.session import Session, Told
from pilotage.ros.warm_up import warm_up
from pilotage.web.drawings import Json, Page, describe_drawing, read_sent
from pilotage.web.frames import Cloud, told_frame, with_senses
from pilotage.web.order import Order, Place, RobotOrder
from pilotage.web.replay import NoRoomError, graph_of

MOST_LINES = 20
"""Sentences of the robot that wait to be shown."""


class RobotShow:
    """The stage of a real robot: nothing true is known, and time goes on by itself."""

    time_step, is_over = 0.0, False

    def __init__(self, session: Session, page: Page, robot: RobotOrder) -> None:
        self.session, self.page, self.graph = session, page, graph_of(session.atlas)
        self.said: deque[str] = deque(maxlen=MOST_LINES)
        topics = replace(robot.topics, hears_wishes=False)
        self.live = LiveRobot(robot.link.join(), session, topics, self.said.append)
        self.live.is_allowed = False
        self.goal: Place | None = None  # in the axes of the drawing's file; kept when a drive to it ends
        self._cloud = Cloud(session.position.localizer)
        self._localizer = session.position.localizer
        self._shown: Told | None = None
        self._began = time.monotonic()

    @property
    def stamp(self) -> float:
        """The time since it began [s]."""
        return time.monotonic() - self._began

    @property
    def sightings(self) -> list[Sighting]:
        """By which the drawing can be corrected."""
        return self.session.sightings

    @property
    def atlas(self) -> Atlas:
        """The drawing."""
        return self.session.atlas

    def spin(self, patience: float) -> bool:
        """Hear the robot, but wait no longer than this [s]; tell whether a scan was worked on."""
        self.live.spin_once(patience)
        is_new = self.live.told is not self._shown
        self._shown = self.live.told
        if is_new:
            position = self.session.position
            if position.localizer is not self._localizer:
                self._localizer, self._cloud = position.localizer, Cloud(position.localizer)
            self._cloud.note(position.odom_from_base)
        return is_new

    def step(self) -> Step:
        """Return the step of the last scan, by the clock of the page."""
        assert self._shown is not None
        position = self.session.position
        step = self._shown.step or Step(
            0.0, STILL, Behavior.REST, position.localized, times_lost=position.times_lost
        )
        return replace(step, stamp=self.stamp)

    def frame(self) -> Json:
        """Describe the last scan."""
        assert self._shown is not None
        step, position, plan, page = self.step(), self.session.position, self.session.plan, self.page
        now = position.estimate
        told = told_frame(step, now, step.stamp, page=page, graph=self.graph, goal=self.goal_name)
        states = self._cloud.states(position.odom_from_base)
        leg = None if plan is None or step.outcome else plan.leg
        return with_senses(told, now, states, self._shown.scan, leg, page=page)

    def describe(self, title: str) -> Json:
        """Describe the drawing and the goal."""
        at = None if self.goal is None else self.page.point(find_goal(self.atlas, self.goal).point)
        drawn = {**describe_drawing(self.page.sketch), "goal": at}
        return {"kind": "robot", "title": title, "drawing": drawn, "goal": self.goal_name}

    def describe_world(self) -> None:
        """Nothing true is known."""

    @property
    def goal_name(self) -> str:
        """What the goal is called; empty if there is none."""
        if self.goal is None:
            return ""
        return find_goal(self.atlas, self.goal).name or "the goal"

    def set_goal(self, goal: Place) -> str:
        """Plan to a place of the page from now on; return why not if it cannot be, else nothing."""
        in_file = goal if isinstance(goal, str) else self.page.file_point(*goal)
        refusal = self.live.set_goal(in_file)
        if not refusal:
            self.goal = in_file
        return refusal

    def begin_at(self, x: float, y: float, heading: float) -> str:
        """Begin anew at a pose of the page; return why not if it cannot be, else nothing."""
        return self.session.begin_at((*self.page.file_point(x, y), heading))

    def plan_again(self) -> str:
        """Plan to the goal as if nothing had been tried: a robot that may not move finds all ways blocked."""
        if self.goal is None:
            return "there is no goal yet"
        self.session.forget_blocked()
        return self.session.set_goal(self.goal)


def show_robot(order: Order, robot: RobotOrder) -> RobotShow:
    """Read the drawing and join the robot; PilotageError or ValueError if that cannot be done."""
    settings = robot.settings
    atlas = build_atlas(read_sent(order.drawing).sketch, settings.localizer.atlas)
    if atlas.cell_graph is None:
        raise NoRoomError("a drawing to localize on must enclose free space, it has no closed room")
    page = Page(atlas.sketch)
    warm_up(atlas, settings)
    start = None if order.start is None else (*page.file_point(*order.start[:2]), *order.start[2:])
    session = Session(
        atlas,
        (settings.localizer, settings.navigator),
        seed=order.seed,
        start=start,  # type: ignore[arg-type]
        keeps_sightings=True,
    )
    show = RobotShow(session, page, robot)
    if order.goal is not None:
        refusal = show.set_goal(order.goal)
        if refusal:
            raise ValueError(refusal)
    return show
