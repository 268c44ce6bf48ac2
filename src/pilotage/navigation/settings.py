"""How the robot drives."""

import math
from dataclasses import dataclass, field

from pilotage.localization import Estimate
from pilotage.maps import RouteSettings
from pilotage.navigation.braking import SteeringSettings


@dataclass(frozen=True, slots=True)
class NavigatorSettings:
    """The robot's size and speed, and when it acts, stops, tries something else or gives up."""

    radius: float = 0.2  # [m] of the robot's footprint, a disc about its base; half the width of a rectangle
    length: float = 0.0  # [m] of a rectangular footprint about its base; 0 for a disc
    time_limit: float = 900.0  # [s] after which the robot gives up
    act_on: float = 0.5  # probability of a pose from which on the robot drives by it
    sure: float = 0.9  # probability of the place that it needs to stop at the goal
    near: float = 0.2  # [m] to a goal that is a point
    patience: float = 8.0  # [s] without getting away from a place before something else is tried
    blocked_for: float = 300.0  # [s] for which a gateway that was found blocked is not tried again
    mismatch_patience: float = 60.0  # [s] of mismatch without a place to act on before it gives up
    steering: SteeringSettings = field(default_factory=SteeringSettings)
    route: RouteSettings = field(default_factory=RouteSettings)

    def knows_place(self, estimate: Estimate) -> bool:
        """Tell whether a place is probable enough to act on, however well the drawing fits."""
        return estimate.probability >= self.act_on

    @property
    def rectangle(self) -> tuple[float, float] | None:
        """Length and width [m] of a rectangular footprint; None for a disc."""
        return (self.length, 2.0 * self.radius) if self.length else None

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("radius", "near", "patience"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name} must be > 0 and finite, got {getattr(self, name)}")
        if not self.time_limit > 0.0:
            raise ValueError(f"time_limit must be > 0 s, got {self.time_limit}")
        for name in ("blocked_for", "mismatch_patience"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0 s, got {getattr(self, name)}")
        if not (self.length == 0.0 or 2.0 * self.radius <= self.length < math.inf):
            raise ValueError(f"length must be 0 or at least the width {2.0 * self.radius}, got {self.length}")
        for name in ("act_on", "sure"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name} must be in [0, 1], got {getattr(self, name)}")
