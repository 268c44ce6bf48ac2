"""How fast a robot may move, how well it brakes, and where it is until it stands."""

import math
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, Twist

SLOW = 0.02
"""Speed [m/s] above which a robot counts as moving: wheels slip."""


@dataclass(frozen=True, slots=True)
class SteeringSettings:
    """How fast the robot may move, and how well it brakes."""

    speed: float = 0.8  # [m/s] fastest speed
    turn_rate: float = 1.2  # [rad/s] fastest turn
    braking: float = 0.8  # [m/s2] deceleration that the robot can rely on
    delay: float = 0.2  # [s] from a scan until the wheels obey

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("speed", "turn_rate", "braking"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name} must be > 0 and finite, got {getattr(self, name)}")
        if not 0.0 <= self.delay < math.inf:
            raise ValueError(f"delay must be >= 0 s and finite, got {self.delay}")


def brake(moving: Twist, settings: SteeringSettings) -> Twist:
    """Command a moving robot to stop on its present arc, which was found free.

    Its turn is what odometry says, which may jump: never faster than the robot may turn.
    """
    return Twist(0.0, max(-settings.turn_rate, min(settings.turn_rate, moving.angular)))


def braking_path(command: Twist, settings: SteeringSettings) -> Array:
    """List the positions of a robot that obeys for the delay and then brakes, still turning, (k, 2) [m]."""
    speed, braking = command.linear, settings.braking
    until = settings.delay + speed / braking
    times = np.linspace(0.0, until, max(3, math.ceil(until / 0.05)) + 1)
    speeds = np.clip(speed - braking * np.maximum(times - settings.delay, 0.0), 0.0, speed)
    lengths = (speeds[1:] + speeds[:-1]) / 2.0 * np.diff(times)
    headings = command.angular * (times[1:] + times[:-1]) / 2.0
    return np.column_stack([np.cumsum(lengths * np.cos(headings)), np.cumsum(lengths * np.sin(headings))])
