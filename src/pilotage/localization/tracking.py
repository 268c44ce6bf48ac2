"""Carry belief from scan to scan: a long walk settles what one look cannot (Wolter 2001, section 3.4)."""

import math
from dataclasses import dataclass, field

import numpy as np

from pilotage.geometry import Pose2
from pilotage.localization.belief import HEADING, LOG_SCALE, STRETCH_P, STRETCH_Q, Belief, X, Y, stretched
from pilotage.localization.proposals import Prior
from pilotage.localization.visibility import Look, VisibilityModel
from pilotage.maps import Atlas


@dataclass(frozen=True, slots=True)
class Drift:
    """How the drawing's falseness changes along the way, and how motion errs (deviations)."""

    log_scale: float = 0.08  # per sqrt(m): 25 % over 10 m
    stretch: float = 0.12  # per sqrt(m), of p and of q
    place: float = 0.1  # [m/sqrt(m)]
    heading: float = 0.04  # [rad/sqrt(m)] angles are drawn off, and walls bent
    length: float = 0.08  # per sqrt(m), of the way itself: a corridor drawn too short
    motion: float = 0.05  # [m/m] of registered motion
    motion_still: float = 0.01  # [m]
    turn: float = 0.02  # [rad/rad] of registered turns
    turn_still: float = 0.005  # [rad]


@dataclass(frozen=True, slots=True)
class TrackingSettings:
    """How belief is carried."""

    prior: Prior = field(default_factory=Prior)
    drift: Drift = field(default_factory=Drift)
    first_count: int = 200_000  # hypotheses before the first scan, if the robot may be anywhere
    count: int = 50_000  # hypotheses once most are settled, at most
    least: int = 10_000  # hypotheses at one place
    by_area: int = 1_000  # hypotheses for each square metre that belief is spread over
    shrink: float = 0.5  # share kept at each resampling on the way from the first count to the last
    resample_below: float = 0.5  # share of effective hypotheses below which belief is resampled
    wall_penalty: float = 3.0  # log-odds of walking through a drawn wall: a door forgotten, a wall moved
    wall_tolerance: float = 0.2  # log of how much longer than the way to the wall a step may be

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        if not self.first_count >= self.count >= self.least >= 1:
            raise ValueError(
                "counts need first_count >= count >= least >= 1, "
                f"got {self.first_count}, {self.count} and {self.least}"
            )
        if not 0.0 < self.shrink <= 1.0:
            raise ValueError(f"shrink must be in (0, 1], got {self.shrink}")

    def count_for(self, area: float, now: int) -> int:
        """Say how many hypotheses are needed for belief that is spread over so much [m²]."""
        enough = max(self.least, min(self.count, round(self.by_area * area)))
        return now if now > self.count else enough


def predict(
    belief: Belief, motion: Pose2, atlas: Atlas, settings: TrackingSettings, rng: np.random.Generator
) -> Belief:
    """Move every hypothesis by the motion of the robot in its own frame, and let the drawing drift."""
    from pilotage.kernels.visibility import LOG_STEP, find_blocked

    drift, prior, count = settings.drift, settings.prior, len(belief)
    distance = math.hypot(motion.x, motion.y)
    root = math.sqrt(distance)
    noise = rng.standard_normal((8, count), dtype=np.float32).astype(np.float64)
    longer = np.exp(drift.length * root * noise[0])
    deviation = drift.motion_still + drift.motion * distance
    steps = stretched(
        belief.states,
        longer * (motion.x + deviation * noise[1]),
        longer * (motion.y + deviation * noise[2]),
    )
    table = atlas.range_table
    tolerance = round(settings.wall_tolerance / LOG_STEP)
    blocked = find_blocked(belief.states[:2], steps, table.log_ranges, table.grid, tolerance)
    states = belief.states.copy()
    astray = drift.place * root * np.exp(states[LOG_SCALE])
    states[X] += steps[0] + astray * noise[3]
    states[Y] += steps[1] + astray * noise[4]
    turn_deviation = drift.heading * root + drift.turn * abs(motion.theta) + drift.turn_still
    states[HEADING] += motion.theta + turn_deviation * noise[5]
    # Ornstein-Uhlenbeck: falseness wanders, and is drawn back to what is usual
    for row, usual, rate, spread, kick in (
        (LOG_SCALE, atlas.log_scale, drift.log_scale * root, prior.log_scale, noise[6]),
        (STRETCH_P, 0.0, drift.stretch * root, prior.stretch, noise[7]),
        (STRETCH_Q, 0.0, drift.stretch * root, prior.stretch, rng.standard_normal(count)),
    ):
        states[row] += rate * kick - (states[row] - usual) * min(rate**2 / (2.0 * spread**2), 1.0)
    return Belief(states, belief.log_weights - settings.wall_penalty * blocked)


def weigh(belief: Belief, seen: Look, model: VisibilityModel, *, news: float = 1.0) -> Belief:
    """Weigh every hypothesis by how well it predicts what is seen.

    Looks from one place err together, so that a look counts only for the share of it that is `news`.
    """
    return Belief(belief.states, belief.log_weights + news * model.score(belief.states, seen))


def thin(belief: Belief, settings: TrackingSettings, rng: np.random.Generator) -> Belief:
    """Resample where few hypotheses carry the weight; many are thinned out little by little."""
    if belief.effective_count >= settings.resample_below * len(belief):
        return belief
    fewer = max(settings.count, int(settings.shrink * len(belief)))
    return belief.resampled(min(fewer, len(belief)), rng)
