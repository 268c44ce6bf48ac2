"""Whether the robot may stop: it must know which place this is, and where in it (Wolter 2001, section 4.2).

These are two questions with a remedy each. If the robot is not sure which place this is, it explores: other
frontiers tell the hypotheses apart. If it is not sure where in the place, along a corridor say, it drives on
along the uncertain direction, to the next thing that is drawn.
"""

import math
from dataclasses import dataclass
from enum import Enum

EASING = 0.03
"""How much less probability is enough each time that the robot comes back to the goal.

A robot that has looked for more and found nothing new had better stop than search until its time is over.
It happens in real buildings whose drawings repeat themselves (decision 0019).
"""

LEAST_SURE = 0.7
"""Probability below which the robot never stops."""

SETTLED = 0.6
"""Standard deviation [m] of the position that is good enough to stop; as much more each time.

In a corridor that is drawn without doors the position never settles, and the robot would drive to and fro
(decision 0017).
"""

EXPLORE_FOR = 10.0
"""How long [s] the robot explores if it is not sure which place this is."""

DRIVE_ON_FOR = 20.0
"""How long [s] the robot drives on, at most, if it is not sure where in the place it is."""


class Doubt(Enum):
    """What the robot does not know well enough to stop."""

    NONE = "none"
    WHICH_PLACE = "which place"
    WHERE_IN_IT = "where in it"


@dataclass(frozen=True, slots=True)
class Arrival:
    """How often the robot came to the goal and doubted, and its doubt of now."""

    times_doubted: int = 0
    doubt: Doubt = Doubt.NONE
    until: float = -math.inf  # [s] stamp at which the doubt ends

    def judged(self, stamp: float, probability: float, position_std: float, sure: float) -> "Arrival":
        """Judge at the goal whether the robot may stop; each time less is asked.

        `probability` is that of the place, 0 if the robot is not located, `position_std` [m] the standard
        deviation of its position there, `sure` the probability that is needed the first time.
        """
        needed = max(sure - EASING * self.times_doubted, LEAST_SURE)
        if probability < needed:
            return Arrival(self.times_doubted + 1, Doubt.WHICH_PLACE, stamp + EXPLORE_FOR)
        if position_std > SETTLED * (1 + self.times_doubted):
            return Arrival(self.times_doubted + 1, Doubt.WHERE_IN_IT, stamp + DRIVE_ON_FOR)
        return Arrival(self.times_doubted)

    def forgotten(self) -> "Arrival":
        """Drop the doubt: nothing more can be done about it here."""
        return Arrival(self.times_doubted)

    def updated(self, stamp: float, probability: float, position_std: float, sure: float) -> "Arrival":
        """Drop the doubt once its time is over, or it is settled; arguments as of `judged`."""
        is_settled = {
            Doubt.NONE: False,
            Doubt.WHICH_PLACE: probability >= sure,
            Doubt.WHERE_IN_IT: position_std < SETTLED,
        }[self.doubt]
        return self.forgotten() if stamp >= self.until or is_settled else self
