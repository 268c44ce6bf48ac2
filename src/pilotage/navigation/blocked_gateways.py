"""Gateways that are drawn open and were found blocked."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pilotage.geometry import Array
from pilotage.navigation.route_leg import RouteLeg

CLOSE_BY = 1.5
"""Distance to a gateway [m] from which the robot sees what lies behind it."""

TO_BLAME = 3.0
"""Largest distance [m] of the gateway that blocks a robot which is stalled."""

GETTING_THROUGH = 4.0 / 3.0
"""How long a robot may stay near a gateway, in times its patience: it slows down for a narrow one."""


@dataclass(frozen=True, eq=False)
class BlockedGateways:
    """Which gateways are blocked, and how long the robot has stayed near each of the others."""

    since: Mapping[str, float] = field(default_factory=dict)  # when each was found blocked [s]
    time_near: Mapping[str, float] = field(default_factory=dict)  # how long the robot stayed near each [s]
    near_from: Array = field(default_factory=lambda: np.zeros(2))  # where that began, in odom [m]

    @property
    def gateway_ids(self) -> tuple[str, ...]:
        """The gateways that are blocked."""
        return tuple(self.since)

    def has_more_than(self, before: "BlockedGateways") -> bool:
        """Tell whether a gateway is blocked that was not before."""
        return not self.since.keys() <= before.since.keys()

    def reopened(self, stamp: float, blocked_for: float) -> "BlockedGateways":
        """Try those again that were found blocked more than `blocked_for` [s] ago."""
        since = {one: then for one, then in self.since.items() if stamp - then < blocked_for}
        return replace(self, since=since)

    def all_reopened(self) -> "BlockedGateways":
        """Try all again: no other route is left."""
        return replace(self, since={})

    def close(self, leg: RouteLeg, stamp: float) -> "BlockedGateways":
        """Block the gateway ahead of a robot that is stalled near it."""
        if not leg.gateway_id or float(np.hypot(*leg.middle)) >= TO_BLAME:
            return self
        return replace(self, since={**self.since, leg.gateway_id: stamp})

    def stayed_near(
        self, leg: RouteLeg, here: Array, *, stamp: float, lasted: float, patience: float
    ) -> "BlockedGateways":
        """Block a gateway that the robot, `here` (2,) in odom [m], stays close to and does not get through.

        It is blocked, at the time `stamp` [s], once the robot stayed near it for longer than `patience` [s]
        times `GETTING_THROUGH`; `lasted` [s] is the time since the last call. Going to and fro between
        gateways counts for each.
        """
        time_near = self.time_near
        if time_near and math.dist(here, self.near_from) > 2.0 * CLOSE_BY:
            time_near = {}
        if not leg.gateway_id or float(np.hypot(*leg.middle)) > CLOSE_BY:
            return replace(self, time_near=time_near)
        began = self.near_from if time_near else here
        time = time_near.get(leg.gateway_id, 0.0) + lasted
        others = {one: value for one, value in time_near.items() if one != leg.gateway_id}
        if time > GETTING_THROUGH * patience:
            return BlockedGateways({**self.since, leg.gateway_id: stamp}, others, began)
        return BlockedGateways(self.since, {**others, leg.gateway_id: time}, began)
