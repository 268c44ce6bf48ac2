"""Compare claimed probabilities with how often the claims are right; each episode has the same weight."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pilotage.evaluation.episodes import Trace
from pilotage.geometry import Array

BINS = 10
RESAMPLES = 500


@dataclass(frozen=True, slots=True)
class Bin:
    """Scans whose probability lies in one of ten equal intervals."""

    low: float
    high: float
    share: float  # of all weight
    probability: float  # mean
    right: float  # share that was right


@dataclass(frozen=True, slots=True)
class Calibration:
    """How well probabilities tell what is right."""

    ece: float  # expected calibration error: mean distance between probability and share right, bin by bin
    ece_interval: tuple[float, float]  # 95 %, bootstrap over episodes
    auroc: (
        float  # probability that a right scan has a higher probability than a wrong one; nan if all are alike
    )
    brier: float  # mean squared distance between probability and truth
    bins: tuple[Bin, ...]  # those that are not empty
    episodes: int


def calibration(traces: Sequence[Trace], rng: np.random.Generator) -> Calibration:
    """Calibrate over the scans of all episodes in rooms that the drawing shows."""
    counted = [trace.part(trace.counted) for trace in traces if trace.counted.any()]
    if not counted:
        raise ValueError("calibration needs a scan in a room that the drawing shows, got none")
    probability, right, weight = pooled(counted)
    resampled = [
        expected_error(bins_of(*pooled([counted[k] for k in rng.integers(len(counted), size=len(counted))])))
        for _ in range(RESAMPLES)
    ]
    low, high = np.quantile(resampled, [0.025, 0.975]).tolist()
    bins = bins_of(probability, right, weight)
    return Calibration(
        expected_error(bins),
        (low, high),
        area_under_curve(probability, right, weight),
        float(np.average((probability - right) ** 2, weights=weight)),
        bins,
        len(counted),
    )


def pooled(traces: Sequence[Trace]) -> tuple[Array, Array, Array]:
    """Join episodes: probability, 1 if right else 0, and weight of each scan; an episode weighs 1 in all."""
    return (
        np.concatenate([trace.probability for trace in traces]),
        np.concatenate([trace.right.astype(np.float64) for trace in traces]),
        np.concatenate([np.full(len(trace.way), 1.0 / len(trace.way)) for trace in traces]),
    )


def bins_of(probability: Array, right: Array, weight: Array) -> tuple[Bin, ...]:
    """Sum up scans in equal intervals of probability; empty ones are left out."""
    index = np.minimum((probability * BINS).astype(np.int64), BINS - 1)
    mass, claimed, true = (
        np.bincount(index, weights=values, minlength=BINS)
        for values in (weight, weight * probability, weight * right)
    )
    return tuple(
        Bin(
            k / BINS,
            (k + 1) / BINS,
            float(mass[k] / weight.sum()),
            float(claimed[k] / mass[k]),
            float(true[k] / mass[k]),
        )
        for k in np.flatnonzero(mass).tolist()
    )


def expected_error(bins: Sequence[Bin]) -> float:
    """Average the distance between probability and share right over bins.

    >>> expected_error([Bin(0.5, 0.6, 0.5, 0.5, 0.75), Bin(0.9, 1.0, 0.5, 1.0, 1.0)])
    0.125
    """
    return float(sum(one.share * abs(one.probability - one.right) for one in bins))


def area_under_curve(probability: Array, right: Array, weight: Array) -> float:
    """Return the area under the receiver operating characteristic; ties count half.

    >>> area_under_curve(np.array([0.1, 0.4, 0.4, 0.8]), np.array([0.0, 0.0, 1.0, 1.0]), np.ones(4))
    0.875
    """
    values, index = np.unique(probability, return_inverse=True)
    positive = np.bincount(index, weights=weight * right, minlength=len(values))
    negative = np.bincount(index, weights=weight * (1.0 - right), minlength=len(values))
    if positive.sum() == 0.0 or negative.sum() == 0.0:
        return float("nan")
    below = np.cumsum(negative) - negative
    return float(positive @ (below + negative / 2.0) / (positive.sum() * negative.sum()))
