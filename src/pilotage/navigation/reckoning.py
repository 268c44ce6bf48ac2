"""Where the robot is at every scan: by the drawing where it moved a little, by its wheels in between."""

import math

from pilotage.geometry import Pose2, Twist
from pilotage.localization import Estimate, Localizer, Status
from pilotage.navigation.steering import STILL
from pilotage.perception import LaserScan, Odometry


class Reckoning:
    """Gives the localizer a scan where the robot moved enough, and keeps what it said; begins with one."""

    def __init__(self, localizer: Localizer, scan: LaserScan, odometry: Odometry) -> None:
        self.localizer = localizer
        self.estimate: Estimate = localizer.update(scan, odometry)
        self.times_lost = 0  # how often the place was lost after it had been found
        self.moving = STILL  # how the robot moves now
        self.is_fresh = True  # whether the localizer was given the scan of now
        self._perceived = self._now = odometry

    def advance(self, scan: LaserScan, odometry: Odometry, way: float, turn: float) -> None:
        """Take in a scan; the localizer is given it if the robot moved this `way` [m] or `turn` [rad]."""
        self.moving, self._now = twist_between(self._now, odometry), odometry
        motion = self._since_perceived
        self.is_fresh = math.hypot(motion.x, motion.y) >= way or abs(motion.theta) >= turn
        if not self.is_fresh:
            return
        before = self.estimate.status
        self.estimate = self.localizer.update(scan, odometry)
        self._perceived = odometry
        self.times_lost += before is Status.LOCATED and self.estimate.status is Status.LOST

    @property
    def odom_from_base(self) -> Pose2:
        """The registered pose, carried on by what the wheels said since."""
        return self.localizer.scan_matcher.odom_from_base @ self._since_perceived

    @property
    def here(self) -> Estimate:
        """The last estimate, moved by odometry since."""
        return self.estimate.moved(self._since_perceived)

    @property
    def _since_perceived(self) -> Pose2:
        """The motion since the localizer was given a scan, as the wheels have it."""
        return self._perceived.odom_from_base.inverse() @ self._now.odom_from_base


def twist_between(before: Odometry, now: Odometry) -> Twist:
    """Tell how the robot moves from what the wheels said last and say now."""
    lasted = now.stamp - before.stamp
    if lasted <= 0.0:
        return STILL
    motion = before.odom_from_base.inverse() @ now.odom_from_base
    return Twist(math.copysign(math.hypot(motion.x, motion.y), motion.x) / lasted, motion.theta / lasted)
