"""What the robot knows when it plans: the value between sensing and acting."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pilotage.geometry import Array, Twist
from pilotage.localization import Estimate
from pilotage.navigation.arrival import Arrival
from pilotage.navigation.goal import BESIDE
from pilotage.navigation.local_grid import LocalGrid, ReachableSet
from pilotage.navigation.memory import Memory
from pilotage.navigation.plan import Plan
from pilotage.navigation.planner import RoutePlanner
from pilotage.navigation.route_leg import RouteLeg
from pilotage.navigation.settings import NavigatorSettings
from pilotage.navigation.step import Behavior

PATH_COST = 0.1
"""Cost [m] of a metre of the path, where the robot goes to the place that is nearest to a waypoint."""

OFF_ROUTE = 1.0
"""Cost [m] there of a place that seems to lie in a cell off the route.

Without it the robot enters the room before its goal, whose far corner is nearer to the waypoint: of 19 packed
drives two were a third longer, and one ended beside its goal (decision 0014).
"""

AT_END = 0.3
"""Distance [m] from the end of the path at which the robot can come no nearer."""


@dataclass(frozen=True, eq=False)
class Situation:
    """All that a behavior may look at."""

    stamp: float  # [s]
    estimate: Estimate  # for now
    twist: Twist
    has_moved: bool  # since the first scan; until then the robot stands where it was told
    turned: float  # [rad] sum of all turns
    trail: Array  # (n, 2) where the robot was, in odom [m]
    local_grid: LocalGrid
    reachable: ReachableSet
    memory: Memory
    planner: RoutePlanner
    leg: RouteLeg | None  # None if the robot does not know its place, or doubts it
    sample: Callable[[int], Array]  # equally probable particles, (6, count)
    settings: NavigatorSettings

    @cached_property
    def approach(self) -> Plan:
        """The path to the reachable place that is nearest to the waypoint, rather on the route."""
        assert self.leg is not None
        odom_from_base, reachable = self.local_grid.odom_from_base, self.reachable
        waypoint = (odom_from_base @ self.leg.waypoint[np.newaxis])[0]
        on_paper = self.estimate.sketch_from_base @ (odom_from_base.inverse() @ reachable.points)
        on_route = self.planner.atlas.are_in(self.leg.route.cell_ids, on_paper)
        index = reachable.nearest(waypoint, path_cost=PATH_COST, extra=np.where(on_route, 0.0, OFF_ROUTE))
        return Plan(Behavior.CROSS, self.stamp, reachable.path_to(index), self.leg, waypoint)

    @property
    def is_in_goal_room(self) -> bool:
        """Whether the goal is a room, and the robot is sure to be in it."""
        knows = self.settings.knows_place(self.estimate)
        is_sure = knows and self.estimate.cell_probability >= self.settings.sure
        return is_sure and self.planner.goal.is_room_around(self.estimate, self.planner.graph)

    @property
    def is_at_goal(self) -> bool:
        """Whether the leading pose is at the goal, or as near to it as the robot can come."""
        if self.leg is None or (self.leg.next_cell_id and self.planner.goal.is_room):
            return False
        distance, plan = self.leg.distance, self.approach
        if distance < self.settings.near:
            return not self.leg.next_cell_id
        left = float(np.hypot(*(plan.path[-1] - self.local_grid.odom_from_base.position)))
        is_no_nearer = plan.gap > self.settings.near and left < AT_END
        return is_no_nearer and distance < BESIDE * (1 + self.memory.detours)

    @property
    def arrival(self) -> Arrival:
        """The verdict at the goal, where the robot knows a place to act on: whether it may stop."""
        if self.is_in_goal_room:
            return Arrival(self.memory.arrival.times_doubted)
        estimate = self.estimate
        anywhere = self.planner.goal.is_room or not self.has_moved  # then it stands where it was told
        probability = estimate.cell_probability if anywhere else estimate.probability
        position_std = 0.0 if anywhere else estimate.position_std
        return self.memory.arrival.judged(self.stamp, probability, position_std, self.settings.sure)
