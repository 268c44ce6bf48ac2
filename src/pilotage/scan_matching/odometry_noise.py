"""How far odometry errs, learnt while driving."""

import math
from dataclasses import dataclass, replace

from pilotage.geometry import Pose2

MEDIAN_OF_NORMAL = 0.6745  # the median of the absolute value of a standard normal variable
MIN_DISTANCE = 0.05  # [m] a shorter way says nothing on errors per meter


@dataclass(frozen=True, slots=True)
class OdometryNoise:
    """Standard deviations of odometry on the way from one scan to the next.

    The defaults are those of a bad robot; `learned` brings them down on a good one.
    """

    place: float = 0.03  # [m] standing still
    place_per_meter: float = 0.3  # [m/m]
    turn: float = math.radians(1.0)  # [rad] standing still
    turn_per_meter: float = math.radians(20.0)  # [rad/m]
    turn_per_turn: float = 0.3  # [rad/rad]

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("place", "turn"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")
        for name in ("place_per_meter", "turn_per_meter", "turn_per_turn"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")

    def deviations(self, motion: Pose2) -> tuple[float, float]:
        """Return the deviation of place [m] and of heading [rad] after a motion."""
        distance = math.hypot(motion.x, motion.y)
        return (
            self.place + self.place_per_meter * distance,
            self.turn + self.turn_per_meter * distance + self.turn_per_turn * abs(motion.theta),
        )

    def learned(self, motion: Pose2, place_error: float, turn_error: float, rate: float) -> "OdometryNoise":
        """Follow the median of the errors that registration found; gross ones count no more than others.

        `rate` is the logarithm of the largest change.
        """
        if math.hypot(motion.x, motion.y) < MIN_DISTANCE:
            return self
        place, turn = self.deviations(motion)
        place_change = math.copysign(rate, abs(place_error) - MEDIAN_OF_NORMAL * place)
        turn_change = math.copysign(rate, abs(turn_error) - MEDIAN_OF_NORMAL * turn)
        return replace(
            self,
            place_per_meter=min(max(self.place_per_meter * math.exp(place_change), 0.05), 0.5),
            turn_per_meter=min(
                max(self.turn_per_meter * math.exp(turn_change), math.radians(3.0)), math.radians(30.0)
            ),
        )
