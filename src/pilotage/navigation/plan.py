"""What a behavior proposes: a path, or to turn or stand on the spot."""

import math
from dataclasses import dataclass, field

import numpy as np

from pilotage.geometry import Array
from pilotage.navigation.arrival import Arrival
from pilotage.navigation.route_leg import RouteLeg
from pilotage.navigation.step import Behavior, Outcome


@dataclass(frozen=True, eq=False)
class Plan:
    """Where to go now: a path over space that was seen free, empty to stay on the spot."""

    behavior: Behavior
    stamp: float = -math.inf  # [s] when it was made
    path: Array = field(default_factory=lambda: np.empty((0, 2)))  # (k, 2) in odom [m]
    leg: RouteLeg | None = None  # the leg of the route that it follows
    gap: float = 0.0  # [m] from the end of the path to the waypoint
    arrival: Arrival | None = None  # the verdict at the goal
    outcome: Outcome | None = None  # how the drive ends here; None while it goes on
    reason: str = ""  # why it ends

    @property
    def follows_route(self) -> bool:
        """Whether the robot drives along the route."""
        return self.behavior in {Behavior.CROSS, Behavior.GO_THROUGH}
