"""From the messages of a robot to readings: each scan with the odometry of its moment and its mount."""

import math
from collections import deque
from typing import Any

import numpy as np

from pilotage.errors import PilotageError
from pilotage.geometry import Pose2
from pilotage.io.bags.frames import Transform, find_mount, frame_name, heading, seconds, transforms_in
from pilotage.io.bags.reader import DEFAULT_BASE, ODOMETRY_FRAME
from pilotage.io.bags.scans import laser_scan
from pilotage.io.bags.stamps import CLOCK_JUMP, interpolated, pose_of
from pilotage.perception import Odometry, Reading

STALE = 0.3
"""Age [s] at which odometry no longer tells where a scan was made."""

REMEMBERED = 200
"""Readings of odometry that are kept, to find that of a scan's moment."""


class NotReadyError(PilotageError):
    """A scan cannot be used yet, or now; the message says why."""


class Sensing:
    """Hears odometry and transforms, and makes readings of scans."""

    def __init__(self) -> None:
        self._edges: dict[str, Transform] = {}
        self._base = ""
        self.odometry_frame = ODOMETRY_FRAME  # as the robot names it
        self._has_topic = False  # whether a topic of odometry was heard: then /tf is not used for it
        self._odometry: deque[tuple[float, float, float, float]] = deque(maxlen=REMEMBERED)

    @property
    def base_frame(self) -> str:
        """The robot's frame, as odometry names it."""
        return self._base or DEFAULT_BASE

    def hear_odometry(self, message: Any) -> None:  # noqa: ANN401  # made at run time
        """Take a nav_msgs/Odometry in."""
        if not self._has_topic:
            self._has_topic = True
            self._odometry.clear()
        place, turn = message.pose.pose.position, message.pose.pose.orientation
        self._base = frame_name(message.child_frame_id) or DEFAULT_BASE
        self.odometry_frame = frame_name(message.header.frame_id) or ODOMETRY_FRAME
        theta = heading(turn.x, turn.y, turn.z, turn.w)
        self._remember(seconds(message.header.stamp), place.x, place.y, theta)

    def hear_transforms(self, message: Any) -> None:  # noqa: ANN401  # made at run time
        """Take a TFMessage in; `odom` to the robot is odometry if no topic tells it."""
        for one in transforms_in(message):
            if one.parent.rpartition("/")[2] == ODOMETRY_FRAME:
                if not self._has_topic:
                    self._base, self.odometry_frame = one.child, one.parent
                    self._remember(one.stamp, one.pose.x, one.pose.y, one.pose.theta)
            else:
                self._edges[one.child] = one

    def reading(self, message: Any) -> Reading:  # noqa: ANN401  # made at run time
        """Make a reading of a LaserScan; raise NotReadyError if something is missing or wrong."""
        stamp = seconds(message.header.stamp)
        laser = frame_name(message.header.frame_id)
        odometry = Odometry(stamp, self.pose_at(stamp))
        try:
            mount = find_mount(self._edges, self.base_frame, laser)
            if mount is None:
                raise NotReadyError(f"there is no transform from {self.base_frame} to {laser}")
            return Reading(laser_scan(message, stamp, mount), odometry)
        except ValueError as error:
            raise NotReadyError(f"the scan cannot be used: {error}") from error

    def pose_at(self, stamp: float) -> Pose2:
        """Interpolate odometry, or carry the last on by its speed; raise NotReadyError if it is stale."""
        if not self._odometry:
            raise NotReadyError("there is no odometry")
        last = self._odometry[-1]
        ahead = stamp - last[0]
        if ahead > STALE:
            raise NotReadyError(f"odometry is stale by {ahead:.2f} s")
        if ahead > 0.0:
            return self._carried_on(ahead)
        rows = np.array(self._odometry)
        poses, known = interpolated(rows[:, 0], rows[:, 1:], np.array([stamp]))
        if not known[0]:
            raise NotReadyError(f"odometry does not reach back to a scan that is {-ahead:.2f} s older")
        return pose_of(poses[0])

    def _carried_on(self, ahead: float) -> Pose2:
        """Go on from the last odometry as fast as it went, for `ahead` [s]."""
        last = self._odometry[-1]
        pose = Pose2(*last[1:])
        if len(self._odometry) < 2:
            return pose
        before = self._odometry[-2]
        between = last[0] - before[0]
        if between > STALE:
            return pose
        motion = Pose2(*before[1:]).inverse() @ pose
        share = ahead / between
        return pose @ Pose2(share * motion.x, share * motion.y, share * motion.theta)

    def _remember(self, stamp: float, x: float, y: float, theta: float) -> None:
        """Keep a reading of odometry; stamps rise, but for a clock that is set back."""
        if not all(map(math.isfinite, (x, y, theta))):
            return
        if self._odometry and stamp <= self._odometry[-1][0]:
            if stamp > self._odometry[-1][0] - CLOCK_JUMP:
                return
            self._odometry.clear()
        self._odometry.append((stamp, x, y, theta))
