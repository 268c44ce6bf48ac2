"""What odometry tells about the robot's motion, how far it is trusted, and when it is refused."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from pilotage.geometry import Array, Pose2, wrap_angle
from pilotage.perception import Odometry

MAX_SPEED = 10.0
"""[m/s] No robot indoors is faster: a report of more is a fault, not a motion."""

MIN_REFUSED_STEP = 5.0
"""[m] Shorter steps are never refused: stamps of logs are equal, or run backwards, or have a coarse clock."""

MAX_TURN_RATE = 10.0
"""[rad/s] No robot with a laser turns faster."""

MIN_REFUSED_TURN = math.pi / 2
"""[rad] Smaller turns are never refused, for the same reason as short steps."""

MAX_STEP = 100.0
"""[m] Longer steps are always refused, whatever the time between: no shape of the local map is that far."""

MAX_COORDINATE = 1e12
"""[m] Odometry farther from its origin is refused: rounding takes 0.1 mm there, and powers of it overflow."""

UNKNOWN_POSITION_STD = 1.0
"""[m] Prior of an unknown motion: as far as a robot drives between two scans of a sparse log."""

UNKNOWN_HEADING_STD = math.radians(30.0)
"""[rad] Prior of an unknown motion; the search covers three times as much to either side."""

NO_ODOMETRY_POSITION_STD = 0.05, 1.0
"""[m, m/s^2] Prior of a robot without odometry, which is expected to go on as before: at once, and by its
acceleration with the square of time."""

NO_ODOMETRY_HEADING_STD = math.radians(3.0), math.radians(180.0)
"""[rad, rad/s^2] The same for its heading."""

MEDIAN_OF_NORMAL = 0.6745
"""The median of the absolute value of a standard normal variable."""

MIN_LEARNING_DISTANCE = 0.05
"""[m] A shorter motion says nothing about errors per metre."""

LEARNING_RATE = 0.1
"""Logarithm of the factor by which one motion may change the noise."""

POSITION_PER_METER_LIMITS = 0.05, 0.5
"""[m/m] The learned noise stays between these."""

HEADING_PER_METER_LIMITS = math.radians(3.0), math.radians(30.0)
"""[rad/m] The learned noise stays between these."""


def reported_motion(before: Odometry, now: Odometry) -> Pose2 | None:
    """Return the motion between two readings of odometry, `before_from_now`; None if no robot makes it."""
    first, second = before.odom_from_base, now.odom_from_base
    if max(abs(first.x), abs(first.y), abs(second.x), abs(second.y)) > MAX_COORDINATE:
        return None
    seconds = now.stamp - before.stamp
    farthest = min(max(MAX_SPEED * seconds, MIN_REFUSED_STEP), MAX_STEP)
    if math.hypot(second.x - first.x, second.y - first.y) > farthest:
        return None
    motion = first.inverse() @ second
    return motion if abs(motion.theta) <= max(MAX_TURN_RATE * seconds, MIN_REFUSED_TURN) else None


@dataclass(frozen=True, slots=True)
class OdometryNoise:
    """Standard deviations of odometry on the way from one scan to the next.

    The defaults are those of a bad robot; `adapted` brings them down on a good one.
    """

    position: float = 0.03  # [m] standing still
    position_per_meter: float = 0.3  # [m/m]
    heading: float = math.radians(1.0)  # [rad] standing still
    heading_per_meter: float = math.radians(20.0)  # [rad/m]
    heading_per_radian: float = 0.3  # [rad/rad]

    def stds(self, motion: Pose2) -> tuple[float, float]:
        """Return the standard deviations of position [m] and heading [rad] after a motion."""
        distance = math.hypot(motion.x, motion.y)
        return (
            self.position + self.position_per_meter * distance,
            self.heading + self.heading_per_meter * distance + self.heading_per_radian * abs(motion.theta),
        )

    def adapted(self, motion: Pose2, position_error: float, heading_error: float) -> "OdometryNoise":
        """Follow the median of the errors that registration found; gross ones count no more than others."""
        if math.hypot(motion.x, motion.y) < MIN_LEARNING_DISTANCE:
            return self
        position, heading = self.stds(motion)
        position_change = math.copysign(LEARNING_RATE, abs(position_error) - MEDIAN_OF_NORMAL * position)
        heading_change = math.copysign(LEARNING_RATE, abs(heading_error) - MEDIAN_OF_NORMAL * heading)
        return replace(
            self,
            position_per_meter=_within(
                POSITION_PER_METER_LIMITS, self.position_per_meter * math.exp(position_change)
            ),
            heading_per_meter=_within(
                HEADING_PER_METER_LIMITS, self.heading_per_meter * math.exp(heading_change)
            ),
        )


class MotionPrior(NamedTuple):
    """Where odometry puts the robot, and how exactly."""

    motion: Pose2  # since the last reading
    odom_from_base: Pose2
    position_std: float  # [m]
    heading_std: float  # [rad]
    is_known: bool = True  # False if odometry was refused

    @classmethod
    def of(cls, motion: Pose2, odom_from_last: Pose2, noise: OdometryNoise) -> "MotionPrior":
        """Carry the last pose on by a motion that odometry reports."""
        return cls(motion, odom_from_last @ motion, *noise.stds(motion))

    @classmethod
    def unknown(cls, odom_from_last: Pose2) -> "MotionPrior":
        """Expect the robot near its last pose: nothing is known about its motion."""
        return cls(
            Pose2.identity(), odom_from_last, UNKNOWN_POSITION_STD, UNKNOWN_HEADING_STD, is_known=False
        )

    @classmethod
    def going_on(cls, motion: Pose2, odom_from_last: Pose2, seconds: float) -> "MotionPrior":
        """Expect the robot to go on as before: it has no odometry."""
        squared = max(seconds, 0.0) ** 2
        stds = [
            at_once + rate * squared for at_once, rate in (NO_ODOMETRY_POSITION_STD, NO_ODOMETRY_HEADING_STD)
        ]
        return cls(
            motion,
            odom_from_last @ motion,
            min(stds[0], UNKNOWN_POSITION_STD),
            min(stds[1], UNKNOWN_HEADING_STD),
        )

    @property
    def pose(self) -> Array:
        """The mean as x, y, theta."""
        return np.array([self.odom_from_base.x, self.odom_from_base.y, self.odom_from_base.theta])

    @property
    def information(self) -> Array:
        """The inverse covariance, (3, 3)."""
        return np.diag([self.position_std**-2, self.position_std**-2, self.heading_std**-2])

    def squared_distance(self, pose: Array) -> float:
        """Return the squared Mahalanobis distance of a pose (x, y, theta)."""
        dx, dy, dtheta = (pose - self.pose).tolist()
        return float((dx**2 + dy**2) / self.position_std**2 + wrap_angle(dtheta) ** 2 / self.heading_std**2)


def update_noise(noise: OdometryNoise, prior: MotionPrior, pose: Array, hessian: Array) -> OdometryNoise:
    """Learn from a registered pose (x, y, theta) how far odometry errs.

    Its position is judged in the direction that the scan tells best: across walls, not along a corridor.
    """
    of_position = hessian[:2, :2] - np.outer(hessian[:2, 2], hessian[:2, 2]) / max(
        hessian[2, 2], np.finfo(float).tiny
    )
    best_seen = np.linalg.eigh(of_position)[1][:, 1]
    position_error = float(best_seen @ (pose - prior.pose)[:2])
    heading_error = wrap_angle(float(pose[2] - prior.pose[2]))
    return noise.adapted(prior.motion, position_error, heading_error)


def _within(limits: tuple[float, float], value: float) -> float:
    """Bring a value between two limits."""
    return min(max(value, limits[0]), limits[1])
