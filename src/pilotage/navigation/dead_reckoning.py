"""Where the robot is at every scan: by the drawing after each small motion, by dead reckoning in between."""

import math

import numpy as np

from pilotage.geometry import Pose2, Twist, wrap_angle
from pilotage.localization import BlockedWay, Estimate, Localizer, Status
from pilotage.navigation.steering import STILL
from pilotage.perception import LaserScan, Odometry
from pilotage.scan_matching.odometry import reported_motion

EVERY = 0.15
"""Distance [m] between two scans that the localizer gets: as in the logs that it was tuned on."""

EVERY_TURN = math.radians(8.0)
"""Turn [rad] between two scans that the localizer gets."""

TRAIL_STEP = 0.5
"""Distance [m] between the positions of the trail."""


class DeadReckoning:
    """Gives the localizer a scan once the robot has moved enough, and moves its estimate in between."""

    def __init__(self, localizer: Localizer) -> None:
        self.localizer = localizer
        self.times_lost = 0  # how often the place was lost after it had been found
        self.twist = STILL  # how the robot moves now
        self.is_fresh = False  # whether the localizer got the scan of now
        self.turned = 0.0  # [rad] sum of all turns, to either side
        self.trail = np.empty((0, 2))  # where the robot was, in odom [m]
        self._localized: Odometry | None = None  # at the last scan that the localizer got
        self._now: Odometry | None = None

    def update(self, scan: LaserScan, odometry: Odometry) -> None:
        """Take one scan in."""
        before = self.odom_from_base if self._now is not None else None
        if self._now is not None and reported_motion(self._now, odometry) is not None:
            self.twist = twist_between(self._now, odometry)  # else the robot is taken to go on as before
        self._now = odometry
        motion = self._since_localized
        is_first = self._localized is None
        has_moved = math.hypot(motion.x, motion.y) >= EVERY or abs(motion.theta) >= EVERY_TURN
        self.is_fresh = is_first or has_moved or not odometry.is_known  # then only scans tell of motion
        if self.is_fresh:
            was_located = not is_first and self.localized.status is Status.LOCATED
            estimate = self.localizer.update(scan, odometry)
            self._localized = odometry
            self.times_lost += was_located and estimate.status is not Status.LOCATED
        now = self.odom_from_base
        self.turned += abs(wrap_angle(now.theta - before.theta)) if before is not None else 0.0
        if is_first or np.hypot(*(self.trail[-1] - now.position)) > TRAIL_STEP:
            self.trail = np.vstack([self.trail, now.position])

    def tell_blocked_way(self, way: BlockedWay) -> None:
        """Tell the localizer of a way in odom that the robot cannot take."""
        self.localizer.add_blocked_way(way.moved(self.localizer.scan_matcher.odom_from_base.inverse()))

    @property
    def localized(self) -> Estimate:
        """The last estimate of the localizer, at the scan that it was made of."""
        return self.localizer.estimate

    @property
    def estimate(self) -> Estimate:
        """The estimate for now: the last one, moved by odometry since."""
        return self.localized.moved(self._since_localized)

    @property
    def odom_from_base(self) -> Pose2:
        """The pose by scan matching, moved by odometry since."""
        return self.localizer.scan_matcher.odom_from_base @ self._since_localized

    @property
    def _since_localized(self) -> Pose2:
        """The motion since the localizer got a scan, by odometry."""
        if self._localized is None or self._now is None:
            return Pose2.identity()
        return self._localized.odom_from_base.inverse() @ self._now.odom_from_base


def twist_between(before: Odometry, now: Odometry) -> Twist:
    """Return how the robot moved between two readings of odometry."""
    lasted = now.stamp - before.stamp
    if lasted <= 0.0:
        return STILL
    motion = before.odom_from_base.inverse() @ now.odom_from_base
    return Twist(math.copysign(math.hypot(motion.x, motion.y), motion.x) / lasted, motion.theta / lasted)
