"""What a behavior proposes: a path, or to turn or stand on the spot."""

import math
from dataclasses import dataclass, field

import numpy as np

from pilotage.geometry import Array
from pilotage.localization import BlockedWay
from pilotage.navigation.arrival import Arrival
from pilotage.navigation.route_leg import RouteLeg
from pilotage.navigation.step import Behavior, Outcome

TOO_FAR = 0.5
"""A path that ends farther than this [m] from its waypoint found no way to it; nearer, it stops at a wall."""


@dataclass(frozen=True, eq=False)
class Plan:
    """Where to go now: a path over space that was seen free, empty to stay on the spot."""

    behavior: Behavior
    stamp: float = -math.inf  # [s] when it was made
    path: Array = field(default_factory=lambda: np.empty((0, 2)))  # (k, 2) in odom [m]
    leg: RouteLeg | None = None  # the leg of the route that it follows
    waypoint: Array | None = None  # (2,) of that leg, in odom [m]
    arrival: Arrival | None = None  # the verdict at the goal
    outcome: Outcome | None = None  # how the drive ends here; None while it goes on
    reason: str = ""  # why it ends

    @property
    def gap(self) -> float:
        """The distance from the end of the path to the waypoint [m]; 0 without one."""
        return 0.0 if self.waypoint is None else float(np.hypot(*(self.path[-1] - self.waypoint)))

    @property
    def blocked_way(self) -> BlockedWay | None:
        """The way in odom from the end of the path to the waypoint, if the path ends before it."""
        if self.waypoint is None or self.gap < TOO_FAR:
            return None
        (x, y), (to_x, to_y) = self.path[-1].tolist(), self.waypoint.tolist()
        return BlockedWay((x, y), (to_x, to_y))

    @property
    def follows_route(self) -> bool:
        """Whether the robot drives along the route."""
        return self.behavior in {Behavior.CROSS, Behavior.GO_THROUGH}
