"""How well a scan agrees with what could be seen from a place on the drawing (Wolter 2001, section 5).

The paper names its main weakness itself: contours alone may be matched with walls that cannot be seen from
there. So hypotheses are ranked by visibility: by the ranges that the drawing predicts along the beams.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps import Atlas
from pilotage.perception import LaserScan

WIDEST = 12.0
"""Largest |log(predicted / measured)| that is told apart: more than from a millimetre to 100 metres."""


@dataclass(frozen=True, slots=True)
class VisibilitySettings:
    """How measured and predicted ranges differ, e = log(predicted / measured)."""

    beams: int = 45  # of a scan, evenly spaced, are looked at
    farthest: float = 30.0  # [m] ranges beyond count as no return
    nearest: float = 0.05  # [m] ranges below are dust, or the robot itself
    deviation: float = 0.15  # of e where a drawn wall is seen: walls are drawn 15 % off
    clutter: float = 0.25  # weight of e > 0: furniture and people before the wall
    clutter_decay: float = 0.4  # per unit of e
    missing: float = 0.05  # weight of e < 0: a drawn wall that is not there, or an open door
    missing_decay: float = 5.0  # per unit of -e
    floor: float = 0.01  # weight of any range at all
    no_return: float = 0.15  # probability of no return although a wall is predicted nearer than ...
    no_return_beyond: float = 15.0  # [m] ... this: glass, black and grazed walls
    outside: float = 0.05  # likelihood of each beam where nothing is drawn
    effective_beams: float = 3.0  # beams err together: those of a scan weigh as much as so many

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        if not self.beams >= 1:
            raise ValueError(f"beams must be >= 1, got {self.beams}")
        for name in ("farthest", "deviation", "floor", "no_return", "no_return_beyond", "outside"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")
        if not 0.0 <= self.effective_beams <= self.beams:
            raise ValueError(f"effective_beams must be in [0, {self.beams}], got {self.effective_beams}")

    def log_likelihood(self, error: Array) -> Array:
        """Return the log-likelihood of e, not normalized: a peak and two tails."""
        seen = np.exp(-(error**2) / (2.0 * self.deviation**2))
        clutter = np.where(error > 0.0, self.clutter * np.exp(-self.clutter_decay * np.abs(error)), 0.0)
        missing = np.where(error <= 0.0, self.missing * np.exp(-self.missing_decay * np.abs(error)), 0.0)
        return np.asarray(np.log(seen + clutter + missing + self.floor))


@dataclass(frozen=True, eq=False)
class Look:
    """What a scan shows, thinned for comparison with a drawing: directions and log ranges in whole steps."""

    beams: NDArray[np.int32]  # (m,) directions in the robot's frame, 0 .. HEADINGS - 1 steps
    levels: NDArray[np.int32]  # (m,) log metres in steps of LOG_STEP, or NO_RETURN

    def __len__(self) -> int:
        """Count the beams."""
        return len(self.beams)


def look(scan: LaserScan, settings: VisibilitySettings) -> Look:
    """Take evenly spaced beams of a scan, as seen from the robot's base."""
    from pilotage.kernels.visibility import HEADINGS, LOG_STEP, NO_RETURN

    chosen = np.unique(np.linspace(0, len(scan) - 1, settings.beams).astype(np.intp))
    directions, ranges = scan.directions[chosen], scan.ranges[chosen]
    used = (ranges > settings.nearest) | (ranges == np.inf)
    directions, ranges = directions[used], ranges[used]
    returned = ranges <= settings.farthest
    reached = np.where(returned, ranges, settings.farthest)
    ends = np.column_stack([reached * np.cos(directions), reached * np.sin(directions)])
    x, y = (scan.base_from_laser @ ends).T
    beams = np.round(np.arctan2(y, x) / math.tau * HEADINGS).astype(np.int32) % HEADINGS
    levels = np.round(np.log(np.maximum(np.hypot(x, y), settings.nearest)) / LOG_STEP)
    return Look(beams, np.where(returned, levels, NO_RETURN).astype(np.int32))


@dataclass(frozen=True, eq=False)
class VisibilityModel:
    """A drawing and how scans differ from it, ready to score hypotheses."""

    atlas: Atlas
    settings: VisibilitySettings

    @cached_property
    def log_likelihoods(self) -> NDArray[np.float32]:
        """The log-likelihood tabulated over whole steps of e, (2 k + 1,)."""
        from pilotage.kernels.visibility import LOG_STEP

        widest = round(WIDEST / LOG_STEP)
        errors = np.arange(-widest, widest + 1, dtype=np.float64) * LOG_STEP
        return self.settings.log_likelihood(errors).astype(np.float32)

    def score(self, states: Array, seen: Look) -> Array:
        """Return the tempered log-likelihood of a look at each hypothesis (6, n), (n,).

        Tempered: beams err together, since it is the drawing that errs, so that all of them weigh as much as
        `effective_beams` of them would alone.
        """
        from pilotage.kernels.visibility import LOG_STEP, score_hypotheses

        if len(seen) == 0:
            return np.zeros(states.shape[1])
        settings, table = self.settings, self.atlas.range_table
        scores = score_hypotheses(
            states,
            seen.beams,
            seen.levels,
            table.log_ranges,
            table.grid,
            table.stretch_tables,
            self.log_likelihoods,
            (round(math.log(settings.no_return_beyond) / LOG_STEP), math.log(settings.no_return)),
            math.log(settings.outside),
        )
        return np.asarray(scores * (settings.effective_beams / len(seen)))
