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
    def effective_count(self) -> float:
        """How many equal hypotheses would be as uncertain: 1 / sum of squared weights."""
        return float(1.0 / np.sum(self.weights**2))

    def resampled(self, count: int, rng: np.random.Generator) -> "Belief":
        """Draw hypotheses by weight, evenly (systematic resampling), so that all weigh the same."""
        picked = np.searchsorted(np.cumsum(self.weights), (np.arange(count) + rng.random()) / count)
        states = self.states[:, np.minimum(picked, len(self) - 1)]
        return Belief(states, np.zeros(count))


def stretched(states: Array, points_x: Array | float, points_y: Array | float) -> Array:
    """Carry one displacement in the robot's frame [m] to the sketch under each hypothesis, (2, n)."""
    cosine, sine = np.cos(states[HEADING]), np.sin(states[HEADING])
    x, y = cosine * points_x - sine * points_y, sine * points_x + cosine * points_y
    p, q = states[STRETCH_P], states[STRETCH_Q]
    size = np.hypot(p, q)
    share = np.sinh(size) / np.maximum(size, np.finfo(float).tiny)
    share = np.where(size > 0.0, share, 1.0)
    scale, even = np.exp(states[LOG_SCALE]), np.cosh(size)
    # exp([[p, q], [q, -p]]) = cosh(size) I + sinh(size) / size [[p, q], [q, -p]]
    return np.stack(
        [scale * ((even + share * p) * x + share * q * y), scale * (share * q * x + (even - share * p) * y)]
    )


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
