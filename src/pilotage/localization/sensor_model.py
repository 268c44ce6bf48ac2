"""The sensor model: a beam model in ratios to a null model (Wolter 2001, section 5).

The paper names its main weakness itself: contours may be matched with walls that cannot be seen from there.
So a place is judged by visibility: by the ranges that the drawing predicts along the beams.

With e = log(predicted / measured), the density of a reading is a mixture as in the beam model of
Probabilistic Robotics (Thrun, Burgard and Fox 2005, section 6.3), but in logarithms of ranges, since a
drawing has no true scale: a normal density for the drawn wall (hit), exponential densities for readings that
are too short (furniture, people) and too long (beyond: an open door, a wall that is not there), and the null
model for readings that have nothing to do with the drawing (rand).

The null model says how ranges look in any building: log-normal, with the parameters below. A likelihood is
always given as its ratio to the null model's. So it does not depend on the unit of range, a particle that
explains nothing costs at most log(z_rand) a beam, and the evidence of a place says directly how much better
than "on no place of this drawing" it is.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array
from pilotage.localization.motion_model import WALL_TOLERANCE
from pilotage.maps import Atlas
from pilotage.perception import LaserScan

NULL_MEAN, NULL_STD = 1.0, 0.85
"""Of the logarithm of a range [m] in any building: measured on aces, belgioioso, csail and freiburg-079."""
NULL_FLOOR = 0.03
"""Share of the null model that is uniform over `NULL_EXTENT`: no reading is impossible."""
NULL_EXTENT = 8.0
"""Range of logarithms of ranges [m]: from 3 cm to 100 m."""

WIDEST = 12.0
"""Largest |log(predicted / measured)| that is told apart: more than from a millimetre to 100 metres."""
CLASS_WIDTH, CLASSES, FIRST_CLASS = 0.2, 40, -16
"""Measured ranges are grouped by their logarithm for the table of ratios: from 4 cm to 120 m."""

BEAMS = 45
"""Beams of a scan that are compared, evenly spaced: more of them err together."""
MIN_RANGE, MAX_RANGE = 0.05, 30.0
"""[m] Shorter readings are dust or the robot itself; longer ones count as no return."""
NO_RETURN_RATIO = math.log(0.15)
"""Log-ratio of a beam that does not return although a wall is predicted within `NO_RETURN_BEYOND`."""
NO_RETURN_BEYOND = 15.0
"""[m] Glass, black walls and grazed walls do not return from nearer."""


@dataclass(frozen=True, slots=True)
class SensorSettings:
    """The mixture of the beam model, and the weight of a scan."""

    z_hit: float = 0.35  # share of readings that show the drawn wall
    z_short: float = 0.45  # share of readings that are too short: furniture and people
    z_beyond: float = 0.02  # share of readings that are too long: open doors, missing walls
    z_rand: float = 0.05  # share of readings that have nothing to do with the drawing
    sigma_hit: float = 0.18  # standard deviation of log(predicted / measured): walls are drawn 18 % off
    lambda_short: float = 0.7  # decay of short readings per unit of log(predicted / measured)
    lambda_beyond: float = 5.0  # decay of long readings, the same
    null_log_ratio: float = -1.0  # [nats] of a scan from which on it speaks for the drawing
    effective_beams: float = 3.0  # weight of a scan, in independent beams: a drawing's errors are correlated

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("z_hit", "z_short", "z_beyond", "z_rand", "sigma_hit", "lambda_short", "lambda_beyond"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name} must be > 0 and finite, got {getattr(self, name)}")
        if not 0.0 <= self.effective_beams <= BEAMS:
            raise ValueError(f"effective_beams must be in [0, {BEAMS}], got {self.effective_beams}")
        if not math.isfinite(self.null_log_ratio):
            raise ValueError(f"null_log_ratio must be finite, got {self.null_log_ratio}")

    def hit_density(self, error: Array) -> Array:
        """Return the density of readings of the drawn wall at e, weighted by its share."""
        normal = np.exp(-(error**2) / (2.0 * self.sigma_hit**2)) / (self.sigma_hit * math.sqrt(math.tau))
        return np.asarray(self.z_hit * normal)

    def density(self, error: Array) -> Array:
        """Return the density of readings that the drawing predicts at e: hit, short and beyond."""
        distance = np.abs(error)
        short = self.z_short * self.lambda_short * np.exp(-self.lambda_short * distance)
        beyond = self.z_beyond * self.lambda_beyond * np.exp(-self.lambda_beyond * distance)
        return np.asarray(self.hit_density(error) + np.where(error > 0.0, short, beyond))


def null_density(log_range: NDArray[np.floating]) -> Array:
    """Return the density of the logarithm of a range [m] in any building."""
    normal = np.exp(-((log_range - NULL_MEAN) ** 2) / (2.0 * NULL_STD**2)) / (NULL_STD * math.sqrt(math.tau))
    return np.asarray((1.0 - NULL_FLOOR) * normal + NULL_FLOOR / NULL_EXTENT)


@dataclass(frozen=True, eq=False)
class SparseScan:
    """A scan thinned for comparison with a drawing: directions and log ranges in whole steps."""

    beams: NDArray[np.int32]  # (m,) directions in the robot's frame, 0 .. HEADINGS - 1 steps
    levels: NDArray[np.int32]  # (m,) log metres in steps of LOG_STEP, or NO_RETURN

    def __len__(self) -> int:
        """Count the beams."""
        return len(self.beams)

    @cached_property
    def classes(self) -> NDArray[np.int32]:
        """The class of each range in the table of ratios, (m,)."""
        log_ranges = self.levels * kernels.visibility.LOG_STEP
        classes = np.floor(log_ranges / CLASS_WIDTH).astype(np.int32) - FIRST_CLASS
        return np.asarray(np.clip(classes, 0, CLASSES - 1), dtype=np.int32)


def thin_scan(scan: LaserScan) -> SparseScan:
    """Take evenly spaced beams of a scan, as seen from the robot's base."""
    visibility = kernels.visibility
    chosen = np.unique(np.linspace(0, len(scan) - 1, BEAMS).astype(np.intp))
    directions, ranges = scan.directions[chosen], scan.ranges[chosen]
    used = (ranges > MIN_RANGE) | (ranges == np.inf)
    directions, ranges = directions[used], ranges[used]
    returned = ranges <= MAX_RANGE
    reached = np.where(returned, ranges, MAX_RANGE)
    ends = np.column_stack([reached * np.cos(directions), reached * np.sin(directions)])
    x, y = (scan.base_from_laser @ ends).T
    beams = np.round(np.arctan2(y, x) / math.tau * visibility.HEADINGS).astype(np.int32) % visibility.HEADINGS
    levels = np.round(np.log(np.maximum(np.hypot(x, y), MIN_RANGE)) / visibility.LOG_STEP)
    return SparseScan(beams, np.where(returned, levels, visibility.NO_RETURN).astype(np.int32))


class Scores(NamedTuple):
    """What a beam counts."""

    values: NDArray[np.float32]  # by class of range and e, (CLASSES, 2 k + 1)
    no_return: float  # of a beam that does not return although a wall is near
    outside: float  # of each beam of a state off the drawing


@dataclass(frozen=True, eq=False)
class SensorModel:
    """A drawing and the beam model, ready to weigh particles."""

    atlas: Atlas
    settings: SensorSettings

    @cached_property
    def _errors(self) -> Array:
        """Values of e that the tables hold, (2 k + 1,)."""
        step = kernels.visibility.LOG_STEP
        widest = round(WIDEST / step)
        return np.arange(-widest, widest + 1, dtype=np.float64) * step

    @cached_property
    def _null(self) -> Array:
        """The null density of each class of ranges, (CLASSES, 1)."""
        middles = (np.arange(CLASSES) + FIRST_CLASS + 0.5) * CLASS_WIDTH
        return null_density(middles)[:, np.newaxis]

    @cached_property
    def log_ratios(self) -> NDArray[np.float32]:
        """Logarithm of the likelihood ratio to the null model by class of range and e, (CLASSES, 2 k + 1)."""
        ratios = self.settings.density(self._errors) / self._null + self.settings.z_rand
        return np.log(ratios).astype(np.float32)

    @cached_property
    def hit_shares(self) -> NDArray[np.float32]:
        """Probability that a reading shows the drawn wall, by class of range and e, (CLASSES, 2 k + 1)."""
        settings = self.settings
        total = settings.density(self._errors) + settings.z_rand * self._null
        return np.asarray(settings.hit_density(self._errors) / total, dtype=np.float32)

    def log_ratio(self, states: Array, scan: SparseScan) -> Array:
        """Return the tempered log-likelihood ratio to the null model of each state (6, n), (n,).

        All beams of a scan together weigh as much as `effective_beams` of them: it is the drawing that errs,
        and it errs for neighboring beams alike.
        """
        return self.log_ratio_along(states, (scan,), np.zeros((1, 3)))[0]

    def log_ratio_along(
        self, states: Array, scans: Sequence[SparseScan], motions: Array
    ) -> tuple[Array, NDArray[np.int64]]:
        """Sum `log_ratio` of scans: the first from states (6, n), the others at motions (k, 3) from there.

        Returns as well how many steps from scan to scan run through a drawn wall, (n,).
        """
        settings = self.settings
        weights = np.array([settings.effective_beams / max(len(scan), 1) for scan in scans])
        scores = Scores(self.log_ratios, NO_RETURN_RATIO, math.log(settings.z_rand))
        sums, crossings = self._sum(states, scans, motions, weights, scores)
        return sums - settings.null_log_ratio * sum(len(scan) > 0 for scan in scans), crossings

    def fit(self, state: Array, scan: SparseScan) -> float:
        """Return the share of a scan's beams that show the drawn walls, seen from one state (6,), [0..1]."""
        if len(scan) == 0:
            return 0.0
        states, still, whole = np.ascontiguousarray(state)[:, np.newaxis], np.zeros((1, 3)), np.ones(1)
        sums, _ = self._sum(states, (scan,), still, whole, Scores(self.hit_shares, 0.0, 0.0))
        return float(sums[0]) / len(scan)

    def _sum(
        self, states: Array, scans: Sequence[SparseScan], motions: Array, weights: Array, scores: Scores
    ) -> tuple[Array, NDArray[np.int64]]:
        """Sum scores over the beams of weighted scans, for each state, and count the steps through walls."""
        table = self.atlas.range_table
        visibility = kernels.visibility
        columns = [(scan.beams, scan.levels, scan.classes) for scan in scans]
        beams, levels, classes = map(np.concatenate, zip(*columns, strict=True))
        sums: tuple[Array, NDArray[np.int64]] = visibility.sum_over_beams(
            states,
            motions,
            weights,
            np.cumsum([0, *(len(scan) for scan in scans)]),
            (beams, levels, classes),
            table.log_ranges,
            table.grid,
            table.stretch_tables,
            scores.values,
            (round(math.log(NO_RETURN_BEYOND) / visibility.LOG_STEP), scores.no_return),
            scores.outside,
            round(WALL_TOLERANCE / visibility.LOG_STEP),
        )
        return sums
