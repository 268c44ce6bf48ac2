"""What the robot keeps from plan to plan: stalls, blocked gateways, doubts at the goal, frontiers."""

import math
from collections.abc import Collection
from dataclasses import dataclass, field, replace

from pilotage.localization import BlockedWay, Estimate, Status
from pilotage.navigation.arrival import Arrival, Doubt
from pilotage.navigation.blocked_gateways import BlockedGateways
from pilotage.navigation.dead_reckoning import DeadReckoning
from pilotage.navigation.frontier import Exploration
from pilotage.navigation.plan import Plan
from pilotage.navigation.settings import NavigatorSettings
from pilotage.navigation.stall import StallDetector
from pilotage.navigation.step import Behavior
from pilotage.perception import LaserScan

ALL_AROUND = math.radians(30.0)
"""A scanner that leaves out less than this [rad] sees all around and need not turn."""

BUSY_WITH_DOUBT = (Behavior.DRIVE_ON, Behavior.LOOK_AROUND)
"""Behaviors of a robot that still looks for where in the goal's place it is."""

DETOUR = 10.0
"""How long [s] the robot explores after it stalled on its route; longer by as much each time."""


@dataclass(frozen=True, eq=False)
class Memory:
    """A value that `updated` replaces before each plan, from the plan before it and what came of it."""

    began: float = 0.0  # [s] stamp of the first scan
    unseen_angle: float = 0.0  # [rad] to turn by, so that the scanner has seen all around
    look_until: float = 0.0  # [rad] sum of turns at which the robot has looked around
    stall: StallDetector = field(default_factory=StallDetector)
    blocked: BlockedGateways = field(default_factory=BlockedGateways)
    arrival: Arrival = field(default_factory=Arrival)
    exploration: Exploration = field(default_factory=Exploration)
    detours: int = 0  # how often the robot stalled on its route
    detour_until: float = -math.inf  # [s] stamp until which it explores because of that
    mismatch_since: float = math.inf  # [s] stamp since when the drawing does not fit and no place is known
    blocked_way: BlockedWay | None = None  # in odom; found blocked on the route since the last plan

    @classmethod
    def at_start(cls, scan: LaserScan, estimate: Estimate, blocked: Collection[str] = ()) -> "Memory":
        """Begin with the first scan; the robot looks around if it does not know its place.

        `blocked` are ids of gateways that were found blocked before.
        """
        unseen = math.tau - (len(scan) - 1) * abs(scan.angle_increment)
        unseen = unseen if unseen > ALL_AROUND else 0.0
        return cls(
            began=scan.stamp,
            unseen_angle=unseen,
            look_until=0.0 if estimate.status is Status.LOCATED else unseen,
            blocked=BlockedGateways(dict.fromkeys(blocked, scan.stamp)),
        )

    def updated(
        self, plan: Plan, stamp: float, position: DeadReckoning, settings: NavigatorSettings
    ) -> "Memory":
        """Take note of the last plan, of the time, and of where the robot is now."""
        memory = self._after(plan, stamp, position, settings)
        if position.turned < memory.look_until:
            return replace(memory, stall=StallDetector())
        estimate, here = position.estimate, position.odom_from_base.position
        is_astray = estimate.status is Status.MISMATCH and not settings.knows_place(estimate)
        memory = replace(
            memory,
            stall=memory.stall.updated(stamp, here, settings.patience),
            blocked=memory.blocked.reopened(stamp, settings.blocked_for),
            arrival=memory.arrival.updated(stamp, estimate.probability, estimate.position_std, settings.sure),
            mismatch_since=min(memory.mismatch_since, stamp) if is_astray else math.inf,
        )
        if memory.stall.is_stalled(settings.patience):
            memory = after_stall(memory, plan, stamp)
        tried = memory.detours > self.detours or memory.blocked.has_more_than(self.blocked)
        return replace(memory, blocked_way=plan.blocked_way if tried else None)

    def for_new_goal(self, stamp: float) -> "Memory":
        """Begin anew at a time [s], but keep what was found blocked."""
        fresh = replace(self, began=stamp, stall=StallDetector(), arrival=Arrival(), detours=0)
        blocked = BlockedGateways(self.blocked.since)
        return replace(fresh, blocked=blocked, detour_until=-math.inf, mismatch_since=math.inf)

    def with_blocked(self, blocked: BlockedGateways) -> "Memory":
        """Replace the blocked gateways."""
        return replace(self, blocked=blocked)

    def _after(
        self, plan: Plan, stamp: float, position: DeadReckoning, settings: NavigatorSettings
    ) -> "Memory":
        """Take note of the last plan, which was followed until the time `stamp` [s]."""
        target = plan.path[-1] if plan.behavior is Behavior.EXPLORE else None
        memory = replace(self, exploration=replace(self.exploration, target=target), blocked_way=None)
        if plan.arrival is not None:
            look_until = position.turned + self.unseen_angle
            memory = replace(memory, arrival=plan.arrival, look_until=look_until)
        elif self.arrival.doubt is Doubt.WHERE_IN_IT and plan.behavior not in BUSY_WITH_DOUBT:
            memory = replace(memory, arrival=self.arrival.forgotten())  # nothing led on
        if plan.leg is not None and plan.follows_route:
            blocked = self.blocked.stayed_near(
                plan.leg,
                position.odom_from_base.position,
                stamp=stamp,
                lasted=stamp - plan.stamp,
                patience=settings.patience,
            )
            memory = replace(memory, blocked=blocked)
        return memory


def after_stall(memory: Memory, plan: Plan, stamp: float) -> Memory:
    """Give up what the robot tried when it stalled, and give the next thing its time."""
    restarted = replace(memory, stall=StallDetector())
    if plan.leg is not None and plan.follows_route:
        detours = memory.detours + 1
        return replace(
            restarted,
            blocked=memory.blocked.close(plan.leg, stamp),
            detours=detours,
            detour_until=stamp + DETOUR * detours,
        )
    if plan.behavior is Behavior.EXPLORE:
        return replace(restarted, exploration=memory.exploration.given_up())
    if plan.behavior is Behavior.DRIVE_ON:
        return replace(restarted, arrival=memory.arrival.forgotten())
    return restarted
