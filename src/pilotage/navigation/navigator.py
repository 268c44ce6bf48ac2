"""Scan in, command out: drives a robot to a goal that is marked on a drawing."""

import math
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Twist
from pilotage.localization import Localizer
from pilotage.navigation.step import Behavior, Outcome, Step
from pilotage.perception import LaserScan, Odometry


@dataclass(frozen=True, slots=True)
class NavigatorSettings:
    """How the robot drives."""

    radius: float = 0.2  # [m] of the robot's footprint, a disc about its base
    time_limit: float = 1800.0  # [s] after which the robot gives up


class Navigator:
    """Drives to `goal`, a point of the sketch (y up): the localizer holds the place, this the drive.

    Raises RouteError if the goal cannot be gone to at all, NotEnclosedError if the drawing has no cells.
    """

    def __init__(
        self, localizer: Localizer, goal: tuple[float, float], settings: NavigatorSettings | None = None
    ) -> None:
        self.settings = settings if settings is not None else NavigatorSettings()
        self.localizer = localizer
        self.goal = goal
        self._began: float | None = None

    def step(self, scan: LaserScan, odometry: Odometry) -> Step:
        """Take one scan in, give one command out."""
        estimate = self.localizer.update(scan, odometry)
        self._began = scan.stamp if self._began is None else self._began
        if scan.stamp - self._began >= self.settings.time_limit:
            reason = f"the goal was not reached within {self.settings.time_limit:.0f} s"
            return Step(
                scan.stamp, Twist(0.0, 0.0), Behavior.REST, estimate, outcome=Outcome.GAVE_UP, reason=reason
            )
        points = scan.points_in_base
        ahead = points[(np.abs(points[:, 1]) < self.settings.radius + 0.1) & (points[:, 0] > 0.0)]
        free = float(ahead[:, 0].min(initial=math.inf)) - self.settings.radius
        command = Twist(0.5, 0.0) if free > 0.6 else Twist(0.0, 0.6)
        return Step(scan.stamp, command, Behavior.EXPLORE, estimate)
