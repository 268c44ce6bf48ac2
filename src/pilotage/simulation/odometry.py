"""The odometry that slipping wheels report."""

import math
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, Pose2

PERSISTENCE = 2.0
"""Distance [m] over which an error of the wheels lasts: a wheel that slips goes on slipping there."""


@dataclass(frozen=True, slots=True)
class OdometrySettings:
    """How the wheels slip; as it stands, like the raw odometry of robots of the nineties."""

    slip: float = 0.07  # standard deviation of the error of a way driven, as a share of it
    drift: float = math.radians(2.5)  # [rad/m] standard deviation of the error of the heading
    turn_slip: float = 0.05  # standard deviation of the error of a turn, as a share of it

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("slip", "drift", "turn_slip"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")


class Wheels:
    """Wheels that count how they turn, and slip: `odom_from_base` is what they report, from the origin on.

    Errors are proportional to the way and to the turn, and last for a while: a wheel that slips on one floor
    goes on slipping there.
    """

    def __init__(self, rng: np.random.Generator, settings: OdometrySettings) -> None:
        self.settings = settings
        self.odom_from_base = Pose2.identity()
        self._rng = rng
        self._station = 0.0  # [m] since the errors of `_here`
        self._here, self._next = self._drawn(), self._drawn()

    def roll(self, move: Pose2) -> None:
        """Move on by a true motion in the robot's own frame."""
        way = math.hypot(move.x, move.y)
        self._station += way
        while self._station >= PERSISTENCE:
            self._station -= PERSISTENCE
            self._here, self._next = self._next, self._drawn()
        share = self._station / PERSISTENCE
        slip, drift, turn_slip = (1.0 - share) * self._here + share * self._next
        reported = Pose2(
            (1.0 + slip) * move.x, (1.0 + slip) * move.y, (1.0 + turn_slip) * move.theta + drift * way
        )
        self.odom_from_base = self.odom_from_base @ reported

    def _drawn(self) -> Array:
        """Draw the slip, drift and slip of turns that hold at one place."""
        return self._rng.normal(0.0, (self.settings.slip, self.settings.drift, self.settings.turn_slip))
