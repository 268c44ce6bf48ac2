"""Gateways that are drawn open and found closed."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pilotage.geometry import Array
from pilotage.navigation.guidance import Leg


@dataclass(frozen=True, slots=True)
class ClosureSettings:
    """When a gateway is taken to be closed, and for how long."""

    close_by: float = 1.5  # [m] to a gateway from which on it can be seen what lies behind it
    behind: float = 0.8  # [m] to the point behind it that one can come near to, or else it looks closed
    before: float = 3.0  # [m] to the gateway that is to blame where the robot is stuck
    lasting: float = 300.0  # [s] for which it is not tried again

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in self.__slots__:
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")


@dataclass(frozen=True, eq=False)
class Closures:
    """Which gateways are closed, and before which the robot stands."""

    since: Mapping[str, float] = field(default_factory=dict)  # when each was found closed [s]
    facing: Mapping[str, float] = field(default_factory=dict)  # how long the robot was close to each [s]
    faced_from: Array = field(default_factory=lambda: np.zeros(2))  # where that began, in odom [m]

    @property
    def gateway_ids(self) -> tuple[str, ...]:
        """The gateways that are closed."""
        return tuple(self.since)

    def lasting(self, stamp: float, settings: ClosureSettings) -> "Closures":
        """Open again what was closed long ago."""
        since = {one: then for one, then in self.since.items() if stamp - then < settings.lasting}
        return replace(self, since=since)

    def opened(self) -> "Closures":
        """Open all: no other way is left."""
        return replace(self, since={})

    def blamed(self, leg: Leg, stamp: float, settings: ClosureSettings) -> "Closures":
        """Close the gateway ahead of a robot that is stuck near it."""
        if not leg.gateway_id or float(np.hypot(*leg.middle)) >= settings.before:
            return self
        return replace(self, since={**self.since, leg.gateway_id: stamp})

    def faced(
        self,
        leg: Leg,
        settings: ClosureSettings,
        *,
        here: Array,
        gap: float,
        stamp: float,
        lasted: float,
        patience: float,
    ) -> "Closures":
        """Close a gateway that the robot, `here` (2,) in odom [m], stays close to and does not get through.

        It is closed, at the time `stamp` [s], once the robot stayed longer than `patience` [s]; `lasted` [s]
        is the time since it was last asked. `gap` [m] is how near one can come to the point behind the
        gateway; where that is not near, time counts twice.
        """
        facing = self.facing
        if facing and math.dist(here, self.faced_from) > 2.0 * settings.close_by:
            facing = {}
        if not leg.gateway_id or float(np.hypot(*leg.middle)) > settings.close_by:
            return replace(self, facing=facing)
        began = self.faced_from if facing else here
        time = facing.get(leg.gateway_id, 0.0) + (2.0 if gap > settings.behind else 1.0) * lasted
        others = {one: value for one, value in facing.items() if one != leg.gateway_id}
        if time > patience:
            return Closures({**self.since, leg.gateway_id: stamp}, others, began)
        return Closures(self.since, {**others, leg.gateway_id: time}, began)
