"""Who is believed when two beliefs disagree: the incumbent, until the challenger has earned it.

Belief that is held against a fresh search at every look finds its place from anywhere, but it also leaves a
right place where the drawing is wrong for a few metres: in a niche drawn as a hall, before a door drawn as
wall. So beside it, and without any search, the belief is carried along that the robot was confident in. It
gives way only when the other has explained the looks better by more than that confidence was worth.
"""

from dataclasses import dataclass

import numpy as np

from pilotage.localization.belief import Belief, X, Y
from pilotage.localization.estimate import Hypothesis

MISSED = 8.0
"""Only the last so many log-odds that a place is worth are missed: with more it is as good as certain."""


@dataclass(frozen=True, slots=True)
class IncumbentSettings:
    """What it takes to give a place up."""

    told: float = 40.0  # log-odds that a start which the user gave is worth
    odds: float = 8.0  # log-odds that full confidence in a place which the robot found is worth
    most: float = 1.0  # log-odds that one look can add: for a while any place may be drawn wrong
    least: float = 1.0  # log-odds below which nothing is worth defending
    reach: float = 4.0  # [m] from the place within which hypotheses are the incumbent's
    count: int = 10_000  # hypotheses

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("told", "odds", "least", "reach"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")
        if not self.most > 0.0:
            raise ValueError(f"most must be > 0, got {self.most}")
        if not self.count >= 1:
            raise ValueError(f"count must be >= 1, got {self.count}")


@dataclass(frozen=True, eq=False)
class Incumbent:
    """The belief that is believed, what it is worth, and how far the challenger has come."""

    belief: Belief
    confidence: float  # [0..1] that the robot is where this belief holds it possible, anywhere there
    odds: float  # log-odds that full confidence is worth
    stake: float  # log-odds by which the challenger must lead
    lead: float = 0.0  # log-odds by which it does

    @property
    def is_beaten(self) -> bool:
        """Tell whether the challenger has earned it."""
        return self.lead >= self.stake

    def contested(self, belief: Belief, gain: float, settings: IncumbentSettings) -> "Incumbent":
        """Carry its belief on after a look that the challenger explained better by `gain`.

        What it is worth is settled when the challenger begins to lead.
        """
        lead = max(self.lead + max(-settings.most, min(settings.most, gain)), 0.0)
        stake = self.odds * self.confidence if lead == 0.0 else self.stake
        return Incumbent(belief, self.confidence, self.odds, stake, lead)

    @property
    def credit(self) -> float:
        """What is left of its worth, [0..1]."""
        left = max(self.stake - self.lead, 0.0)
        return min(left / min(self.stake, MISSED), 1.0)


def incumbent_at(
    place: Hypothesis,
    belief: Belief,
    confidence: float,
    settings: IncumbentSettings,
    rng: np.random.Generator,
) -> Incumbent | None:
    """Defend what belief holds about a place, if the robot is confident enough; None if not."""
    stake = settings.odds * confidence
    if stake < settings.least:
        return None
    at, scale = place.sketch_from_base.pose, place.sketch_from_base.scale
    away = np.hypot(belief.states[X] - at.x, belief.states[Y] - at.y)
    members = away <= settings.reach * scale
    if not members.any():
        return None
    own = Belief(belief.states[:, members], belief.log_weights[members])
    return Incumbent(own.resampled(settings.count, rng), confidence, settings.odds, stake)


def gain_of(belief: tuple[Belief, Belief], incumbent: tuple[Belief, Belief]) -> float:
    """Return by how much a belief predicted a look better than the incumbent's, each before and after it."""
    (before, after), (its_before, its_after) = belief, incumbent
    return (after.log_mass - before.log_mass) - (its_after.log_mass - its_before.log_mass)
