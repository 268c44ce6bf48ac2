"""A robot's body: a disc on two driven wheels, which can speed up and turn only so fast."""

import math
from dataclasses import dataclass

from pilotage.geometry import Pose2, Twist


@dataclass(frozen=True, slots=True)
class BodySettings:
    """How large the robot is and how it can move."""

    radius: float = 0.2  # [m] of its footprint, a disc about its base; half the width of a rectangle
    length: float = 0.0  # [m] of a rectangular footprint about its base; 0 for a disc
    speed: float = 0.8  # [m/s] at most, forward and backward
    turn_rate: float = 1.2  # [rad/s] at most, either way
    acceleration: float = 1.0  # [m/s²] at most, speeding up and braking
    turn_acceleration: float = 4.0  # [rad/s²] at most

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        if not (self.length == 0.0 or self.length >= 2.0 * self.radius):
            raise ValueError(f"length must be 0 or at least the width {2.0 * self.radius}, got {self.length}")
        for name in ("radius", "speed", "turn_rate", "acceleration", "turn_acceleration"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")

    @property
    def rectangle(self) -> tuple[float, float] | None:
        """Length and width [m] of a rectangular footprint; None for a disc."""
        return (self.length, 2.0 * self.radius) if self.length else None

    @property
    def reach(self) -> float:
        """From the base to the farthest point of the body [m]."""
        return math.hypot(self.length / 2.0, self.radius) if self.length else self.radius

    def obeyed(self, now: Twist, command: Twist, time_step: float) -> Twist:
        """Tell how it moves a time step [s] after it got a command: as near to it as it can."""
        return Twist(
            approached(now.linear, command.linear, self.acceleration * time_step, self.speed),
            approached(now.angular, command.angular, self.turn_acceleration * time_step, self.turn_rate),
        )


def approached(now: float, wanted: float, step: float, limit: float) -> float:
    """Move a number towards another by no more than a step, and keep it within a limit.

    >>> approached(0.5, 2.0, 0.1, 0.8), approached(0.75, 2.0, 0.1, 0.8), approached(0.5, -2.0, 1.0, 0.8)
    (0.6, 0.8, -0.5)
    """
    wanted = max(-limit, min(limit, wanted))
    return max(now - step, min(now + step, wanted))


def rolled(twist: Twist, time_step: float) -> Pose2:
    """Return the motion in the robot's frame of a time step [s]: along the chord of its arc, which is exact.

    >>> rolled(Twist(1.0, math.pi / 2), 1.0).position.round(4).tolist()
    [0.6366, 0.6366]
    """
    half = twist.angular * time_step / 2.0
    chord = twist.linear * time_step * (math.sin(half) / half if half != 0.0 else 1.0)
    return Pose2(chord * math.cos(half), chord * math.sin(half), 2.0 * half)
