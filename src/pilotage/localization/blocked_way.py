"""Ways that the robot found blocked: evidence against places where the drawing leaves them free."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, Pose2
from pilotage.localization.motion_model import cross_walls
from pilotage.localization.particles import X, Y, displacements
from pilotage.maps import Atlas

FREE_PENALTY = 2.5
"""Log-odds against a way that is blocked and drawn free: a door may be shut, or furniture may stand in it."""

SAME = 1.0
"""[m] Ways that begin and end this close to each other are one."""


@dataclass(frozen=True, slots=True)
class BlockedWay:
    """A straight way that the robot cannot take: found in odom, kept in the frame of a keyframe's robot."""

    start: tuple[float, float]  # [m] as near as the robot can get
    end: tuple[float, float]  # [m] where it cannot get

    def moved(self, target_from_here: Pose2) -> "BlockedWay":
        """Return the way in another frame."""
        start, end = (target_from_here @ np.array([self.start, self.end])).tolist()
        return BlockedWay((start[0], start[1]), (end[0], end[1]))

    def is_same(self, other: "BlockedWay") -> bool:
        """Tell whether another way in the same frame is this one, found again."""
        return math.dist(self.start, other.start) < SAME and math.dist(self.end, other.end) < SAME


def log_ratio_of_ways(states: Array, ways: Iterable[BlockedWay], atlas: Atlas) -> Array:
    """Sum the log-likelihood ratios [nats] of ways in the robot's frame, for states (6, n), (n,)."""
    total = np.zeros(states.shape[1])
    for way in ways:
        starts = states.copy()
        starts[[X, Y]] += displacements(states, *way.start)
        x, y = np.subtract(way.end, way.start).tolist()
        is_free = ~cross_walls(starts, displacements(states, x, y), atlas)
        total -= FREE_PENALTY * is_free
    return total
