"""Whether the robot may stop: it must know which place this is, and where in it (Wolter 2001, section 4.2).

These are two questions, and each has its own remedy. Not sure which place this is, the robot drives to where
the places held possible would look different. Not sure where in it, along a corridor say, it drives on that
way: to the next thing that is drawn.
"""

import math
from dataclasses import dataclass
from enum import Enum

from pilotage.localization import Estimate, Status


class Doubt(Enum):
    """What the robot does not know well enough to stop."""

    NONE = "none"
    WHICH_PLACE = "which place"
    WHERE_IN_IT = "where in it"


@dataclass(frozen=True, slots=True)
class ArrivalSettings:
    """How near the robot comes, and how much it must know to stop."""

    near: float = 0.2  # [m] to the goal
    beside: float = 1.0  # [m] to the goal where no nearer place can be gone to: something stands on it
    sure: float = 0.9  # confidence that it needs
    easing: float = 0.03  # by how much less it needs each time it comes back
    least: float = 0.7  # confidence without which it never stops
    settled: float = 0.6  # [m] spread that the hypotheses at the place may have; as much more each time
    look: float = 10.0  # [s] for which it looks for more where it is not sure which place this is
    drive_on: float = 20.0  # [s] for which it drives on, at most, where it is not sure where in the place

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("near", "settled"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0 m, got {getattr(self, name)}")
        for name in ("sure", "easing", "least"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name} must be in [0, 1], got {getattr(self, name)}")


@dataclass(frozen=True, slots=True)
class Arrival:
    """How often the robot came to where the goal should be and doubted, and what it does about it."""

    times_doubted: int = 0
    doubt: Doubt = Doubt.NONE
    until: float = -math.inf  # [s] stamp until which it looks for more

    def judged(self, stamp: float, estimate: Estimate, spread: float, settings: ArrivalSettings) -> "Arrival":
        """Judge, where the goal should be, whether the robot may stop; each time less is asked.

        `spread` is the deviation of its hypotheses at the place [m].
        """
        needed = max(settings.sure - settings.easing * self.times_doubted, settings.least)
        if estimate.status is not Status.LOCATED or estimate.confidence < needed:
            return Arrival(self.times_doubted + 1, Doubt.WHICH_PLACE, stamp + settings.look)
        if spread > settings.settled * (1 + self.times_doubted):
            return Arrival(self.times_doubted + 1, Doubt.WHERE_IN_IT, stamp + settings.drive_on)
        return Arrival(self.times_doubted)

    def forgotten(self) -> "Arrival":
        """Drop the doubt: nothing more can be done about it here."""
        return Arrival(self.times_doubted)

    def at(self, stamp: float, confidence: float, spread: float, settings: ArrivalSettings) -> "Arrival":
        """Forget the doubt once it has had its time, or is settled; `spread` [m] as in `judged`."""
        is_settled = {
            Doubt.NONE: False,
            Doubt.WHICH_PLACE: confidence >= settings.sure,
            Doubt.WHERE_IN_IT: spread < settings.settled,
        }[self.doubt]
        return self.forgotten() if stamp >= self.until or is_settled else self
