"""Belief over places of the drawing: many weighted hypotheses, each with a scale and a stretch of its own.

A drawing is metrically false as a whole. So no hypothesis speaks of the whole: it says how what surrounds
the robot is carried to the sketch here and now, by a local affine map that drifts along the way.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pilotage.geometry import Array, Pose2, Similarity2

X, Y, HEADING, LOG_SCALE, STRETCH_P, STRETCH_Q = range(6)


@dataclass(frozen=True, eq=False)
class Belief:
    """Hypotheses as columns x, y, heading, log scale and stretch, as in kernels/visibility.py."""

    states: Array  # (6, n)
    log_weights: Array  # (n,) not normalized

    def __len__(self) -> int:
        """Count the hypotheses."""
        return int(self.states.shape[1])

    @cached_property
    def weights(self) -> Array:
        """The weights, which sum to 1, (n,)."""
        weights = np.exp(self.log_weights - self.log_weights.max())
        return np.asarray(weights / weights.sum())

    @property
    def log_mass(self) -> float:
        """The logarithm of the sum of the weights before they are normalized."""
        highest = float(self.log_weights.max())
        return highest + math.log(float(np.exp(self.log_weights - highest).sum()))

    @property
    def effective_count(self) -> float:
        """How many equal hypotheses would be as uncertain: 1 / sum of squared weights."""
        return float(1.0 / np.sum(self.weights**2))

    def resampled(self, count: int, rng: np.random.Generator) -> "Belief":
        """Draw hypotheses by weight, evenly (systematic resampling), so that all weigh the same."""
        return Belief(self.picked(count, rng.random()), np.zeros(count))

    def picked(self, count: int, offset: float = 0.5) -> Array:
        """Pick states at even steps of the summed weights, from a share of a step on, (6, count)."""
        picked = np.searchsorted(np.cumsum(self.weights), (np.arange(count) + offset) / count)
        return np.asarray(self.states[:, np.minimum(picked, len(self) - 1)])

    def mixed(self, other: "Belief", share: float, count: int, rng: np.random.Generator) -> "Belief":
        """Give a share of the whole to another belief, `count` hypotheses in all.

        Where the share is nothing and the count stays, so do the weights.
        """
        taken = round(share * count)
        if taken == 0 and count == len(self):
            return self
        states = [self.resampled(count - taken, rng).states, other.resampled(taken, rng).states]
        return Belief(np.hstack(states), np.zeros(count))


def stretched(states: Array, x: Array | float, y: Array | float) -> Array:
    """Carry a displacement in the robot's frame [m] to the sketch under each hypothesis, (2, n)."""
    from pilotage.kernels.displacement import displace

    count = states.shape[1]
    return displace(states, np.broadcast_to(np.float64(x), count), np.broadcast_to(np.float64(y), count))


def mean_state(states: Array, weights: Array) -> Array:
    """Average hypotheses that stand close together, headings on the circle, (6,)."""
    mean = states @ weights / weights.sum()
    mean[HEADING] = math.atan2(
        float(np.sin(states[HEADING]) @ weights), float(np.cos(states[HEADING]) @ weights)
    )
    return np.asarray(mean)


def similarity_of(state: Array) -> Similarity2:
    """Return `sketch_from_base` of one state (6,), its stretch left out."""
    pose = Pose2(float(state[X]), float(state[Y]), float(state[HEADING]))
    return Similarity2(math.exp(float(state[LOG_SCALE])), pose)
