"""What odometry says of the robot's pose, and what registration teaches about odometry."""

from typing import NamedTuple

import numpy as np

from pilotage.geometry import Array, Pose2, wrap_angle
from pilotage.perception import Odometry
from pilotage.scan_matching.local_map import PerceptionMap
from pilotage.scan_matching.odometry_noise import OdometryNoise
from pilotage.scan_matching.settings import RegistrationSettings


class Guess(NamedTuple):
    """What odometry says."""

    motion: Pose2  # since the last reading
    odom_from_base: Pose2
    place: float  # [m] standard deviation
    turn: float  # [rad]

    @property
    def pose(self) -> Array:
        """As x, y, theta."""
        return np.array([self.odom_from_base.x, self.odom_from_base.y, self.odom_from_base.theta])

    @property
    def information(self) -> Array:
        """Inverse covariance, (3, 3)."""
        return np.diag([self.place**-2, self.place**-2, self.turn**-2])

    def distance(self, pose: Array) -> float:
        """Return the squared distance of a pose in deviations."""
        dx, dy, dtheta = (pose - self.pose).tolist()
        return float((dx**2 + dy**2) / self.place**2 + wrap_angle(dtheta) ** 2 / self.turn**2)


def predict(perception_map: PerceptionMap, odometry: Odometry) -> Guess:
    """Carry the last pose on by what odometry reports since."""
    before = perception_map.odometry
    motion = before.odom_from_base.inverse() @ odometry.odom_from_base if before else Pose2.identity()
    return Guess(motion, perception_map.odom_from_base @ motion, *perception_map.noise.deviations(motion))


def learn(
    noise: OdometryNoise, guess: Guess, pose: Array, hessian: Array, settings: RegistrationSettings
) -> OdometryNoise:
    """Judge odometry where the scan does: across the walls, that is, and not along a corridor."""
    across = hessian[:2, :2] - np.outer(hessian[:2, 2], hessian[:2, 2]) / max(
        hessian[2, 2], np.finfo(float).tiny
    )
    best_seen = np.linalg.eigh(across)[1][:, 1]
    place_error = float(best_seen @ (pose - guess.pose)[:2])
    turn_error = wrap_angle(float(pose[2] - guess.pose[2]))
    return noise.learned(guess.motion, place_error, turn_error, settings.learning_rate)
