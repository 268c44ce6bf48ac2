"""Stall detection: the robot does not get away from where it is, whatever it believes."""

import math
from dataclasses import dataclass

from pilotage.geometry import Array

WINDOWS = ((1.0, 0.3), (5.0, 2.0))
"""(time as a multiple of the patience, distance [m]): stalled if the robot stayed within it for this time.

The first window finds a robot that stands, the second one that goes to and fro.
"""


@dataclass(frozen=True, slots=True)
class StallDetector:
    """The recent positions of the robot, each with its time; `patience` [s] is how long it may stand."""

    moments: tuple[tuple[float, float, float], ...] = ()  # [s, m, m], in odom, the oldest first

    def updated(self, stamp: float, position: Array, patience: float) -> "StallDetector":
        """Add the position of now, and drop those that are older than any window."""
        oldest = stamp - (WINDOWS[-1][0] + 1.0) * patience
        kept = tuple(moment for moment in self.moments if moment[0] >= oldest)
        return StallDetector((*kept, (stamp, float(position[0]), float(position[1]))))

    def is_stalled(self, patience: float) -> bool:
        """Tell whether the robot stayed within the distance of a window for all of its time."""
        if not self.moments:
            return False
        stamp, *here = self.moments[-1]
        for times, distance in WINDOWS:
            recent = [(x, y) for then, x, y in self.moments if stamp - then <= times * patience]
            lasts = stamp - self.moments[0][0] >= times * patience
            if lasts and max(math.dist(here, at) for at in recent) < distance:
                return True
        return False
