"""Compare a drive with the truth: did the robot end where it should, and how directly."""

from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.drives import Drive
from pilotage.navigation import Outcome

NEAR_GOAL = 1.5
"""Distance [m] from the marked point within which the robot may stop: a drawing tells no better."""
NEAR_GOAL_SHARE = 0.1
"""Distance from the marked point within which it may stop, as a share of the room's longer side."""

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Destination:
    """Where a drive should end, in the world."""

    point: Point  # the marked point of the drawing, carried over by control points [m]
    room: shapely.Polygon  # the room of the point [m]
    is_room: bool = False  # whether the goal was given by name, so that anywhere in the room is right

    @property
    def size(self) -> float:
        """The longer side of the smallest rectangle, however turned, around the room [m]."""
        corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(self.room))
        return float(np.hypot(*np.diff(corners, axis=0).T).max())

    @property
    def tolerance(self) -> float:
        """How far from the point the robot may stop [m]."""
        return np.inf if self.is_room else max(NEAR_GOAL, NEAR_GOAL_SHARE * self.size)


@dataclass(frozen=True, slots=True)
class DriveScore:
    """How a drive went."""

    reached: bool  # stopped by its own decision in the right room, and near the point unless that is free
    in_room: bool  # ended in the right room, whatever it says
    miss: float  # [m] from the marked point
    outcome: str  # what the pilot says
    reason: str
    collisions: int
    way: float  # [m] driven
    way_ratio: float  # over the shortest in the true world
    minutes: float
    times_lost: int
    times_recovered: int
    steps: int
    ms_median: float  # [ms] a step
    ms_p95: float


def score(driven: Drive, destination: Destination, shortest: float) -> DriveScore:
    """Compare a drive with the place where it should end and the shortest path there [m]."""
    end = shapely.Point(driven.positions[-1])
    miss = float(end.distance(shapely.Point(destination.point)))
    in_room = bool(destination.room.covers(end))
    step_ms = np.array(driven.step_ms or [np.nan])
    return DriveScore(
        reached=driven.outcome is Outcome.REACHED and in_room and miss <= destination.tolerance,
        in_room=in_room,
        miss=miss,
        outcome=driven.outcome.value if driven.outcome else "goes on",
        reason=driven.reason,
        collisions=driven.collisions,
        way=driven.length,
        way_ratio=driven.length / shortest,
        minutes=driven.minutes,
        times_lost=driven.times_lost,
        times_recovered=driven.times_recovered,
        steps=len(driven.steps),
        ms_median=float(np.median(step_ms)),
        ms_p95=float(np.quantile(step_ms, 0.95)),
    )
