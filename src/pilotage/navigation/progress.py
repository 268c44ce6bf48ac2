"""Whether the robot gets on at all: standing still tells, not a belief that shifts."""

import math
from dataclasses import dataclass

from pilotage.geometry import Array

LASTING = ((1.0, 0.3), (5.0, 2.0))
"""For so many times the patience, the robot has not got so far away [m]."""


@dataclass(frozen=True, slots=True)
class Progress:
    """Where the robot was of late, each with its time."""

    moments: tuple[tuple[float, float, float], ...] = ()  # [s, m, m], in odom, the oldest first

    def at(self, stamp: float, here: Array, patience: float) -> "Progress":
        """Remember where the robot is now, and forget what is too long ago to matter."""
        oldest = stamp - (LASTING[-1][0] + 1.0) * patience
        kept = tuple(moment for moment in self.moments if moment[0] >= oldest)
        return Progress((*kept, (stamp, float(here[0]), float(here[1]))))

    def is_stuck(self, patience: float) -> bool:
        """Tell whether the robot has not got away from where it is, though nothing told it to stay.

        `patience` [s] is how long it may stand; it may go to and fro for longer.
        """
        if not self.moments:
            return False
        stamp, *here = self.moments[-1]
        for times, reach in LASTING:
            lately = [(x, y) for then, x, y in self.moments if stamp - then <= times * patience]
            lasts = stamp - self.moments[0][0] >= times * patience
            if lasts and max(math.dist(here, at) for at in lately) < reach:
                return True
        return False
