"""What the navigator did at one scan, and why: all that a journal, a display or a test wants to know."""

from dataclasses import dataclass
from enum import Enum

from pilotage.geometry import Twist
from pilotage.localization import Estimate


class Behavior(Enum):
    """What the robot is about (Wolter 2001, section 4.2)."""

    LOOK_AROUND = "look around"  # turns on the spot: what it sees does not tell where it is
    EXPLORE = "explore"  # drives to where the places held possible would look most different
    CROSS = "cross"  # crosses the cell towards its next gateway, or the goal
    GO_THROUGH = "go through"  # goes through the opening of a gateway
    BACK_OUT = "back out"  # leaves a place from which nothing leads on
    WAIT = "wait"  # something moves in the way
    REST = "rest"  # stops where the goal should be, or stands: the drive is over


class Outcome(Enum):
    """How a drive ended."""

    REACHED = "reached"
    GAVE_UP = "gave up"


@dataclass(frozen=True, slots=True)
class Step:
    """The command to the wheels, and what was believed when it was given.

    Two questions are answered apart: in which cell the robot is (`estimate.cell_id`, `cell_belief`), and
    where in it (`estimate.sketch_from_base`, `alignment_error`).
    """

    stamp: float  # [s]
    command: Twist
    behavior: Behavior
    estimate: Estimate
    cell_belief: float = 0.0  # [0..1] probability that the robot is in this cell, wherever in it
    alignment_error: float = float("inf")  # [m] spread of the hypotheses at this place
    next_cell_id: str = ""  # the cell to be entered next; empty in the goal's cell or without a route
    gateway_id: str = ""  # through which
    target: tuple[float, float] | None = None  # where the robot heads, in its own frame [m]
    distance: float = float("inf")  # [m] left to the goal, as far as drawing and scale can tell
    closed_gateway_ids: tuple[str, ...] = ()  # drawn open, found closed
    times_lost: int = 0  # how often the place was lost after it had been found
    outcome: Outcome | None = None  # None while the drive goes on
    reason: str = ""  # why it ended, in plain words
