"""Behaviors in order of priority: the first that proposes a plan wins (Wolter 2001, section 4.2)."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from pilotage.localization import Status
from pilotage.navigation.arrival import Doubt
from pilotage.navigation.braking import SLOW
from pilotage.navigation.frontier import farthest, farthest_along, find_frontiers, frontier_worth
from pilotage.navigation.plan import Plan
from pilotage.navigation.situation import Situation
from pilotage.navigation.step import Behavior, Outcome

SAMPLE = 200
"""Number of particles over which the progress towards the goal is averaged."""

AT_GATEWAY = 1.0
"""Distance [m] from a gateway at which the robot goes through it."""


def give_up(now: Situation) -> Plan | None:
    """End the drive when its time is over, or when no place of the drawing has fitted for long."""
    settings = now.settings
    if now.stamp - now.memory.mismatch_since >= settings.mismatch_patience:
        reason = "this drawing does not fit this building"
        return Plan(Behavior.REST, now.stamp, outcome=Outcome.MISMATCH, reason=reason)
    if now.stamp - now.memory.began >= settings.time_limit:
        reason = f"the goal was not reached within {settings.time_limit:.0f} s"
        return Plan(Behavior.REST, now.stamp, outcome=Outcome.GAVE_UP, reason=reason)
    return None


def look_around(now: Situation) -> Plan | None:
    """Turn on the spot until all was seen, or until there is a place to go to."""
    if now.turned < now.memory.look_until or len(now.reachable.cells) == 0:
        return Plan(Behavior.LOOK_AROUND, now.stamp)
    return None


def drive_on(now: Situation) -> Plan | None:
    """Resolve the doubt where in a place the robot is: drive along the direction of largest uncertainty."""
    if now.memory.arrival.doubt is not Doubt.WHERE_IN_IT:
        return None
    base_from_sketch = np.linalg.inv(now.estimate.sketch_from_base.linear)
    axis = now.local_grid.odom_from_base.rotation @ base_from_sketch @ np.array(now.estimate.position_axis)
    index = farthest_along(now.reachable, axis) if axis.any() else None
    return None if index is None else Plan(Behavior.DRIVE_ON, now.stamp, now.reachable.path_to(index))


def arrive(now: Situation) -> Plan | None:
    """Stop at the goal; end the drive there if the robot may, else look around and doubt."""
    if not (now.is_in_goal_room or now.is_at_goal):
        return None
    if now.twist.linear > SLOW:
        return Plan(Behavior.REST, now.stamp, leg=now.leg)
    arrival = now.arrival
    if arrival.doubt is not Doubt.NONE:
        return Plan(Behavior.LOOK_AROUND, now.stamp, arrival=arrival)
    return Plan(Behavior.REST, now.stamp, leg=now.leg, outcome=Outcome.REACHED, reason=reason_of_arrival(now))


def reason_of_arrival(now: Situation) -> str:
    """Say what is reached, and what speaks against it: a distance that is left, a drawing that fits badly."""
    goal = now.planner.goal
    reason = f"{goal.name!r} ({goal.cell_id})" if goal.is_room else f"the goal in {goal.cell_id}"
    reason += " is reached"
    if now.leg is not None and goal.is_missed_by(now.leg.distance):
        reason += f" as near as the robot can come: {now.leg.distance:.1f} m"
    return reason + (", though the drawing fits badly" if now.estimate.status is Status.MISMATCH else "")


def follow_route(now: Situation) -> Plan | None:
    """Cross the cell to the next gateway and go through it."""
    if now.leg is None:
        return None
    is_near = now.leg.gateway_id and float(np.hypot(*now.leg.middle)) < AT_GATEWAY
    return replace(now.approach, behavior=Behavior.GO_THROUGH if is_near else Behavior.CROSS)


def explore(now: Situation) -> Plan | None:
    """Drive to the frontier of largest worth, and keep to it until it is reached."""
    reachable, exploration, blocked = now.reachable, now.memory.exploration, now.memory.blocked
    index = exploration.target_in(reachable)
    if index is None:
        frontiers = find_frontiers(reachable)
        if len(frontiers) == 0:
            return None
        avoided = np.vstack([now.trail, exploration.unreachable])
        worth = frontier_worth(reachable, frontiers, avoided, now.estimate.hypotheses, now.planner.atlas)
        if now.memory.arrival.doubt is not Doubt.WHICH_PLACE:  # else the goal seemed to be here
            in_base = now.local_grid.odom_from_base.inverse() @ reachable.points[frontiers]
            costs = now.planner.cost_to_go(blocked)
            worth = worth + costs.expected_progress(in_base, now.sample(SAMPLE))
        index = int(frontiers[worth.argmax()])
    return Plan(Behavior.EXPLORE, now.stamp, reachable.path_to(index))


def back_out(now: Situation) -> Plan:
    """Leave a place from which nothing leads on: go to where the robot was not recently."""
    avoided = np.vstack([now.trail, now.memory.exploration.unreachable])
    return Plan(Behavior.BACK_OUT, now.stamp, now.reachable.path_to(farthest(now.reachable, avoided)))


BEHAVIORS: tuple[Callable[[Situation], Plan | None], ...] = (
    give_up,
    look_around,
    drive_on,
    arrive,
    follow_route,
    explore,
    back_out,
)


def make_plan(now: Situation) -> Plan:
    """Return the plan of the first behavior that proposes one; the last one always does."""
    return next(plan for behavior in BEHAVIORS if (plan := behavior(now)) is not None)
