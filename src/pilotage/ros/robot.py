"""The loop of a live robot: hear, localize, drive if that is wanted, and say what is believed.

All that is published bears the stamp of the scan that it was made of, so that simulated time needs no care.
"""

import json
import math
import re
import time
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from pilotage.geometry import Pose2, Twist
from pilotage.io.bags import outgoing
from pilotage.io.bags.bent_frame import BentFrame
from pilotage.io.bags.frames import frame_name, heading, seconds
from pilotage.io.bags.ground import Ground
from pilotage.io.bags.messages import ODOMETRY_TYPE, SCAN_TYPE
from pilotage.io.bags.recorder import TYPES
from pilotage.navigation.steering import STILL
from pilotage.ros.link import Topics
from pilotage.ros.node import LATCHED_DEPTH, Quality
from pilotage.ros.sensing import NotReadyError, Sensing
from pilotage.ros.session import Goal, Session, Told
from pilotage.ros.watchdog import NO_SCAN, Watchdog

TF_TYPE, POSE_TYPE, PATH_TYPE = TYPES["/tf"], TYPES["/pilotage/pose"], TYPES["/pilotage/path"]
STRING_TYPE = "std_msgs/msg/String"
NUMBER = re.compile(r"[+-]?\d+(\.\d+)?")
"""Numbers in a reason to stand: one that differs in them alone is not said again."""
STANDING_EVERY = 0.1
"""Time [s] between two commands to stand while something is wrong."""
ROUTE_EVERY = 0.5
"""Time [s] between two messages of the route."""


class Wire(Protocol):
    """What joins us to a robot: a `Node`, or another transport."""

    def subscribe(self, topic: str, type_name: str, quality: Quality = ...) -> Any:  # noqa: ANN401
        """Listen to a topic."""

    def advertise(self, topic: str, type_name: str, *, latched: bool = ...) -> Any:  # noqa: ANN401
        """Open a topic to publish on."""

    def wait(self, seconds: float) -> None:
        """Wait until a message comes."""


class LiveRobot:
    """Hears a robot, and tells it where it is and what to do."""

    def __init__(
        self,
        wire: Wire,
        session: Session,
        topics: Topics,
        say: Callable[[str], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._wire, self.session, self._topics, self._say, self._clock = wire, session, topics, say, clock
        self.sensing, self.watchdog = Sensing(), Watchdog()
        self.told: Told | None = None
        self.is_over = False  # a drive has ended
        self.is_allowed = True  # to send commands; a person may take that back
        self.trouble = ""  # why the robot must stand now
        latched = Quality(LATCHED_DEPTH, reliable=True, latched=True)
        self._scans = wire.subscribe(topics.scan, SCAN_TYPE, Quality(1))
        self._odometry = wire.subscribe(topics.odometry, ODOMETRY_TYPE, Quality(100))
        self._transforms = wire.subscribe("/tf", TF_TYPE, Quality(100))
        self._mounts = wire.subscribe("/tf_static", TF_TYPE, latched)
        self._starts = wire.subscribe("initialpose", POSE_TYPE, Quality(1, reliable=True))
        self._goal_poses = wire.subscribe(
            "goal_pose", "geometry_msgs/msg/PoseStamped", Quality(1, reliable=True)
        )
        self._goal_names = wire.subscribe("pilotage/goal", STRING_TYPE, Quality(1, reliable=True))
        self._out = self._advertise()
        self._frame_told: object = None
        self._stood = self._route_told = -np.inf
        self._reason = ""

    def _advertise(self) -> dict[str, Any]:
        """Open all topics to publish on, by their short names."""
        wire, topics = self._wire, self._topics
        out = {
            "tf": wire.advertise("/tf", TF_TYPE),
            "amcl_pose": wire.advertise("amcl_pose", POSE_TYPE, latched=True),
            "diagnostics": wire.advertise("/diagnostics", TYPES["/diagnostics"]),
            "hypotheses": wire.advertise("pilotage/hypotheses", TYPES["/pilotage/hypotheses"]),
            "status": wire.advertise("pilotage/status", STRING_TYPE),
            "route": wire.advertise("pilotage/route", PATH_TYPE),
            "map": wire.advertise("map", TYPES["/map"], latched=True),
            "drawing": wire.advertise("pilotage/drawing", TYPES["/pilotage/drawing"], latched=True),
            "cells": wire.advertise("pilotage/cells", TYPES["/pilotage/cells"], latched=True),
        }
        if topics.drives:
            kind = "geometry_msgs/msg/TwistStamped" if topics.stamped else "geometry_msgs/msg/Twist"
            out["command"] = wire.advertise(topics.command, kind)
        return out

    def spin_once(self, patience: float = 0.05) -> None:
        """Wait for messages, but no longer than this [s], and take them in."""
        self._wire.wait(patience)
        for message in [*self._mounts.take(), *self._transforms.take()]:
            self.sensing.hear_transforms(message)
        for message in self._odometry.take():
            self.sensing.hear_odometry(message)
        if self._topics.hears_wishes:
            self._hear_wishes()
        scans = self._scans.take()
        if scans:
            self._hear_scan(scans[-1])
        self._watch()

    def stop(self) -> None:
        """Tell the wheels to stand, more than once since a message may be lost."""
        for _ in range(3):
            self._send_command(STILL, self.watchdog.stamp or 0.0)
            time.sleep(0.01)

    def forbid(self) -> None:
        """Tell the wheels to stand, and send nothing from then on."""
        self.stop()
        self.is_allowed = False

    def _hear_scan(self, message: Any) -> None:  # noqa: ANN401  # made at run time
        """Localize, and drive on if nothing forbids it."""
        came, stamp = self._clock(), seconds(message.header.stamp)
        try:
            reading = self.sensing.reading(message)
        except NotReadyError as error:
            self.watchdog.hear(came, stamp, str(error))
            return
        self.watchdog.hear(came, stamp)
        self.told = told = self.session.update(reading)
        took = self._clock() - came
        if self.watchdog.trouble or took > NO_SCAN:
            self._stand(self.watchdog.trouble or f"a step took {took:.1f} s", stamp)
        elif self.session.goal is not None:
            self._send_command(told.command, stamp)
        self._publish(told)
        if told.step is not None and told.step.outcome is not None:
            self._say(f"the drive is over: {told.step.outcome.value}. {told.step.reason}".strip())
            self.stop()
            self.session.set_goal(None)
            self.is_over = True

    def _watch(self) -> None:
        """Stand while something is wrong, and say so once."""
        self.trouble = reason = self.watchdog.reason(self._clock())
        if reason:
            self._stand(reason, self.watchdog.stamp or 0.0)
        elif self._reason:
            self._say("all is well again")
            self._reason = ""

    def _stand(self, reason: str, stamp: float) -> None:
        """Send a command to stand, again and again."""
        kind = NUMBER.sub("", reason)
        if kind != self._reason:
            self._say(f"standing: {reason}")
            self._reason = kind
        now = self._clock()
        if now - self._stood >= STANDING_EVERY and self.session.goal is not None:
            self._stood = now
            self._send_command(STILL, stamp)

    def _send_command(self, command: Twist, stamp: float) -> None:
        """Send a command, if we may drive."""
        if "command" not in self._out or not self.is_allowed:
            return
        message = outgoing.twist_message(command)
        if self._topics.stamped:
            above = outgoing.header(stamp, self.sensing.base_frame)
            message = outgoing.make("geometry_msgs/TwistStamped", above, message)
        self._out["command"].publish(message)

    def _publish(self, told: Told) -> None:
        """Say what is believed."""
        belief, stamp, out = told.belief, told.belief.stamp, self._out
        if self._frame_told is not self.session.frame:
            self._frame_told = self.session.frame
            frame, graph = self.session.frame, self.session.atlas.cell_graph
            ground = frame.ground if isinstance(frame, BentFrame) else Ground.drawn(frame, graph)
            out["map"].publish(outgoing.occupancy_grid(stamp, ground))
            out["drawing"].publish(outgoing.drawing(stamp, frame))
            out["cells"].publish(outgoing.cells(stamp, frame, graph))
        out["tf"].publish(
            outgoing.transform(stamp, outgoing.MAP, self.sensing.odometry_frame, told.map_from_odom)
        )
        out["amcl_pose"].publish(outgoing.pose_estimate(belief))
        out["hypotheses"].publish(outgoing.hypotheses(belief))
        out["diagnostics"].publish(outgoing.diagnostics(belief))
        out["status"].publish(outgoing.make("std_msgs/String", json.dumps(dict(belief.values))))
        now = self._clock()
        if told.step is not None and told.step.target is not None and now - self._route_told >= ROUTE_EVERY:
            self._route_told = now
            target = belief.pose @ Pose2(*told.step.target, 0.0)
            out["route"].publish(outgoing.path(stamp, [belief.pose, target]))

    def _hear_wishes(self) -> None:
        """Take starts and goals in."""
        for message in self._starts.take():
            self._say(self.session.set_start(planar(message.pose.pose)) or "the start is taken")
        for message in self._goal_poses.take():
            self.set_goal(self.session.goal_at(planar(message.pose)), frame_name(message.header.frame_id))
        for message in self._goal_names.take():
            self.set_goal(message.data.strip() or None)

    def set_goal(self, goal: Goal | None, frame: str = outgoing.MAP) -> str:
        """Drive there, or end the drive if there is no goal; say and return why not if it cannot be."""
        refusal = ""
        if self._topics.localizes_only:
            refusal = "goals are not heard: the robot is only localized"
        elif frame not in {outgoing.MAP, ""}:
            refusal = f"a goal must be in the frame map, got {frame}"
        else:
            self.is_over = False
            if goal is None:
                self.stop()
            refusal = self.session.set_goal(goal)
        self._say(refusal or (f"the goal is {goal}" if goal else "there is no goal now"))
        return refusal


def planar(pose: Any) -> Pose2:  # noqa: ANN401  # made at run time
    """Return a geometry_msgs/Pose as a pose of the plane."""
    turn = pose.orientation
    theta = heading(turn.x, turn.y, turn.z, turn.w)
    return Pose2(pose.position.x, pose.position.y, 0.0 if math.isnan(theta) else theta)
