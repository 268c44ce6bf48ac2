"""Where in its surroundings the robot stands: the local affine map of the place that it believes in.

In which cell the robot is and where in it are two questions (Wolter 2001, section 4.2). The first is
answered by the weights of all hypotheses, the second by those that stand at one place.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pilotage.geometry import Array, Pose2
from pilotage.localization.belief import HEADING, LOG_SCALE, STRETCH_P, STRETCH_Q, Belief, X, Y, mean_state


@dataclass(frozen=True, eq=False)
class Placement:
    """The mean of the hypotheses at one place."""

    state: Array  # (6,) as in kernels/visibility.py
    spread: float  # [m] root mean square distance of the hypotheses from their mean
    axis: Array  # (2,) along which they are spread most, of the length of their deviation [drawing units]

    @property
    def position(self) -> tuple[float, float]:
        """Where the robot stands in the sketch [drawing units]."""
        return float(self.state[X]), float(self.state[Y])

    @property
    def scale(self) -> float:
        """Drawing units per metre here, the mean of all directions."""
        return math.exp(float(self.state[LOG_SCALE]))

    @cached_property
    def linear(self) -> Array:
        """What carries a displacement in the robot's frame [m] to the sketch [drawing units], (2, 2)."""
        p, q = float(self.state[STRETCH_P]), float(self.state[STRETCH_Q])
        size = math.hypot(p, q)
        share = math.sinh(size) / size if size > 0.0 else 1.0
        stretch = math.cosh(size) * np.eye(2) + share * np.array([[p, q], [q, -p]])
        return np.asarray(self.scale * stretch @ Pose2(0.0, 0.0, float(self.state[HEADING])).rotation)

    def sketch_from_base(self, points: Array) -> Array:
        """Carry points (n, 2) from the robot's frame [m] to the sketch."""
        return np.asarray(points @ self.linear.T + self.position)

    def base_from_sketch(self, points: Array) -> Array:
        """Carry points (n, 2) from the sketch to the robot's frame [m]."""
        return np.asarray(np.linalg.solve(self.linear, (points - self.position).T).T)

    def moved(self, motion: Pose2) -> "Placement":
        """Carry the place along by a motion of the robot in its own frame."""
        state = self.state.copy()
        state[[X, Y]] = self.sketch_from_base(motion.position[np.newaxis])[0]
        state[HEADING] += motion.theta
        return Placement(state, self.spread, self.axis)


def place_at(belief: Belief, point: tuple[float, float], reach: float) -> Placement:
    """Average the hypotheses within `reach` [m] of a point of the sketch; of all if there are none."""
    scale = math.exp(float(belief.states[LOG_SCALE] @ belief.weights))
    away = np.hypot(belief.states[X] - point[0], belief.states[Y] - point[1])
    members = away <= reach * scale
    if not belief.weights[members].sum() > 0.0:
        members[:] = True
    states, weights = belief.states[:, members], belief.weights[members]
    mean = mean_state(states, weights)
    offsets = states[[X, Y]] - mean[[X, Y], np.newaxis]
    variances, axes = np.linalg.eigh(offsets * (weights / weights.sum()) @ offsets.T)
    variances = np.maximum(variances, 0.0)
    spread = math.sqrt(float(variances.sum())) / math.exp(float(mean[LOG_SCALE]))
    return Placement(mean, spread, math.sqrt(float(variances[-1])) * axes[:, -1])
