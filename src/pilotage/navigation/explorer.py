"""Explores rim by rim: keeps to what was begun, and remembers what was vain."""

from collections.abc import Collection

import numpy as np

from pilotage.geometry import Array
from pilotage.localization import PoseHypothesis
from pilotage.maps import Atlas, Roads
from pilotage.maps.route import Point
from pilotage.navigation.cost_to_go import cost_to_go
from pilotage.navigation.exploring import ExploringSettings, choose_rim, farthest
from pilotage.navigation.surroundings import Reach

VAIN = 10
"""So many places are remembered that the robot could not get to."""

SAME = 0.3
"""A place so near [m] to the one that was begun is the same."""

DONE = 0.5
"""What was begun is done once the way left is shorter [m]."""


class Explorer:
    """Chooses where to drive while the place is not known; `goal` is a point of the sketch (y up)."""

    def __init__(self, atlas: Atlas, roads: Roads, goal: Point, settings: ExploringSettings) -> None:
        self.atlas, self.roads, self.goal, self.settings = atlas, roads, goal, settings
        self._cost_to_go = cost_to_go(atlas, roads, goal)
        self._closed: tuple[str, ...] = ()  # gateways that this leaves out
        self._begun: Array | None = None  # (2,) in odom [m]
        self._vain = np.empty((0, 2))  # where the robot could not get to, in odom [m]

    def give_up(self) -> None:
        """Remember that the robot cannot get to where it explores."""
        if self._begun is not None:
            self._vain = np.vstack([self._vain, self._begun])[-VAIN:]
            self._begun = None

    def interrupt(self) -> None:
        """Forget what was begun: the robot does something else."""
        self._begun = None

    def choose(
        self,
        reach: Reach,
        trail: Array,
        places: tuple[PoseHypothesis, ...],
        *,
        belief: Array | None = None,
        closed: Collection[str] = (),
    ) -> tuple[int, bool]:
        """Choose one of `reach.points`, and tell whether it leads on, or only back.

        `trail` (n, 2) is where the robot was, in odom [m]; `places` are those held possible. If the goal is
        to count, `belief` says which way it lies, not through `closed` gateways.
        """
        if self._begun is not None:
            away = np.hypot(*(reach.points - self._begun).T)
            index = int(away.argmin())
            if away[index] < SAME and reach.lengths[index] > DONE:
                return self._begin(reach, index), True
        if tuple(closed) != self._closed:
            self._closed = tuple(closed)
            self._cost_to_go = cost_to_go(self.atlas, self.roads, self.goal, self._closed)
        goal = None if belief is None else (self._cost_to_go, belief)
        shunned = np.vstack([trail, self._vain])
        rim = choose_rim(reach, shunned, places, self.atlas, self.settings, goal=goal)
        if rim is None:
            self._begun = None
            return farthest(reach, shunned), False
        return self._begin(reach, rim), True

    def _begin(self, reach: Reach, index: int) -> int:
        """Keep to a place of `reach.points` from now on."""
        self._begun = reach.points[index]
        return index
