"""Weighted particles on the drawing, each with a local affine map of its own.

A drawing is metrically false as a whole. So a particle does not only say where the robot is: it says how its
surroundings are carried to the sketch here and now, by a scale and a stretch that drift along the way.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array

X, Y, HEADING, LOG_SCALE, STRETCH_P, STRETCH_Q = range(6)


@dataclass(frozen=True, eq=False)
class Particles:
    """Particles as columns x, y, heading, log scale, p, q of `Affine2.from_state`; y up [drawing units]."""

    states: Array  # (6, n)
    log_weights: Array  # (n,) the sum of the weights is the mass of the set: its evidence

    def __len__(self) -> int:
        """Count the particles."""
        return int(self.states.shape[1])

    @cached_property
    def log_mass(self) -> float:
        """The logarithm of the sum of the weights; -inf without particles."""
        if len(self) == 0:
            return -math.inf
        highest = float(self.log_weights.max())
        return highest + math.log(float(np.exp(self.log_weights - highest).sum()))

    @cached_property
    def shares(self) -> Array:
        """The weights as shares of the mass, which sum to 1, (n,)."""
        return np.asarray(np.exp(self.log_weights - self.log_mass))

    @property
    def effective_size(self) -> float:
        """Number of equally weighted particles that would be as uncertain: 1 / sum of squared shares."""
        return float(1.0 / np.sum(self.shares**2))

    def members(self, chosen: NDArray[np.intp]) -> "Particles":
        """Keep the particles at these indices, with their weights."""
        return Particles(self.states.take(chosen, axis=1), self.log_weights[chosen])

    def scaled(self, log_factors: Array | float) -> "Particles":
        """Multiply all weights by a factor, or each by its own (n,), given as logarithms."""
        return Particles(self.states, self.log_weights + log_factors)

    def picked(self, count: int, offset: float = 0.5) -> Array:
        """Pick states at even steps of the summed shares (systematic resampling), (6, count)."""
        picked = np.searchsorted(np.cumsum(self.shares), (np.arange(count) + offset) / count)
        return self.states.take(np.minimum(picked, len(self) - 1), axis=1)

    def resampled(self, count: int, rng: np.random.Generator) -> "Particles":
        """Draw particles by weight; all weigh the same then, and the mass stays."""
        log_weight = self.log_mass - math.log(count)
        return Particles(self.picked(count, rng.random()), np.full(count, log_weight))


def join(sets: Sequence[Particles]) -> Particles:
    """Join sets of particles; their weights stay."""
    if not sets:
        return Particles(np.empty((6, 0)), np.empty(0))
    return Particles(
        np.hstack([one.states for one in sets]), np.concatenate([one.log_weights for one in sets])
    )


def displacements(states: Array, x: Array | float, y: Array | float) -> Array:
    """Carry a displacement in the robot's frame [m] to the sketch under each particle, (2, n)."""
    count = states.shape[1]
    carried: Array = kernels.displacement.displace(
        states, np.full(count, x, np.float64), np.full(count, y, np.float64)
    )
    return carried


def weighted_sum(values: Array, weights: Array) -> Array:
    """Sum values (..., n) by weights (n,); without BLAS, whose threads get in the way of other processes."""
    return np.asarray(np.einsum("...n,n->...", values, weights))


def mean_state(states: Array, weights: Array) -> Array:
    """Average particles that stand close together, headings on the circle, (6,)."""
    mean = weighted_sum(states, weights) / weights.sum()
    sine, cosine = weighted_sum(np.stack([np.sin(states[HEADING]), np.cos(states[HEADING])]), weights)
    mean[HEADING] = math.atan2(float(sine), float(cosine))
    return np.asarray(mean)
