"""What the navigator did at one scan, and why: all that a journal, a display or a test needs."""

from dataclasses import dataclass
from enum import Enum

from pilotage.geometry import Twist
from pilotage.localization import Estimate
from pilotage.maps.routing.roadmap import Point

Place = Point | str
"""A goal: a point in the drawing's own units and axes, or the name of a room."""


class Behavior(Enum):
    """What the robot does (Wolter 2001, section 4.2)."""

    LOOK_AROUND = "look around"  # turns on the spot to see all around
    EXPLORE = "explore"  # drives to a frontier
    DRIVE_ON = "drive on"  # drives along the direction in which its position is uncertain
    CROSS = "cross"  # crosses the cell towards its next gateway, or the goal
    GO_THROUGH = "go through"  # goes through the opening of a gateway
    BACK_OUT = "back out"  # leaves a place from which nothing leads on
    WAIT = "wait"  # an obstacle is in the way
    REST = "rest"  # stops at the goal, or stands: the drive is over


class Outcome(Enum):
    """How a drive ended."""

    REACHED = "reached"
    GAVE_UP = "gave up"
    MISMATCH = "mismatch"  # the drawing is not of this building


@dataclass(frozen=True, slots=True)
class Visit:
    """How the drive to one goal ended."""

    goal: Place
    outcome: Outcome
    stamp: float  # [s]
    reason: str  # in plain words


@dataclass(frozen=True, slots=True)
class Step:
    """The command to the wheels, and what was believed when it was given."""

    stamp: float  # [s]
    command: Twist
    behavior: Behavior
    estimate: Estimate  # the last one of the localizer
    next_cell_id: str = ""  # the cell to be entered next; empty in the goal's cell or without a route
    gateway_id: str = ""  # the gateway to that cell
    target: tuple[float, float] | None = None  # where the robot drives to, in its own frame [m]
    distance: float = float("inf")  # [m] left to the goal, by drawing and scale
    closed_gateway_ids: tuple[str, ...] = ()  # drawn open, found blocked
    times_lost: int = 0  # how often the place was lost after it had been found
    outcome: Outcome | None = None  # None while the drive goes on
    reason: str = ""  # why it ended, in plain words
    visits: tuple[Visit, ...] = ()  # the goals that are over, in order
