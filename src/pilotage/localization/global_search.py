"""Search the drawing for places that explain the last metres, whatever its scale (Wolter 2001, section 3.4).

Proposals from all over the drawing are weighed by the sensor model over a window of keyframes: cheap tests on
many first, costly tests on few last. Those that remain are refined where they stand.
"""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.localization.blocked_way import log_ratio_of_ways
from pilotage.localization.keyframes import Keyframe, choose_keyframes, corners_in_base, ways_in_base
from pilotage.localization.motion_model import WALL_PENALTY
from pilotage.localization.particles import LOG_SCALE, Particles, X, Y
from pilotage.localization.prior import Prior, draw_anywhere, draw_at_corners
from pilotage.localization.sensor_model import SensorModel

SCANS = 8
"""Scans of the window that are compared."""
KEPT = (6, 30)
"""Of the proposals one in 6 is kept after the newest scan, and one in 30 after half of the scans."""
ROUNDS = 4
"""Rounds of refinement."""
MOVES = np.array([0.3, 0.3, math.radians(4.0), 0.08, 0.08, 0.08])
"""Standard deviations of a refining move: x, y [m], heading [rad], log scale, p, q."""


def global_search(
    window: tuple[Keyframe, ...], model: SensorModel, prior: Prior, count: int, rng: np.random.Generator
) -> Particles:
    """Find where on the drawing the newest keyframe may stand; the mass is the evidence of the window.

    `count` proposals are drawn from the prior, half of them where corners agree. The evidence is the mean
    likelihood ratio over the prior, so it includes the price of having tried many places.
    """
    ours = corners_in_base(window)
    states = np.hstack(
        [
            draw_at_corners(ours, model.atlas, prior, count // 2, rng),
            draw_anywhere(model.atlas, prior, count // 2, rng),
        ]
    )
    log_prior = -math.log(states.shape[1])
    chosen = choose_keyframes(window, SCANS)
    weight = min(sum(one.novelty for one in window) / len(chosen), 1.0)
    for share, some in zip(KEPT, (chosen[:1], chosen[::2]), strict=True):
        scores = log_evidence(states, some, model, weight)
        states = states.take(_best(scores, max(1, count // share)), axis=1)
    ways = ways_in_base(window)

    def score(some: Array) -> Array:
        return log_evidence(some, chosen, model, weight) + log_ratio_of_ways(some, ways, model.atlas)

    scores = score(states)
    log_mass = Particles(states, scores + log_prior).log_mass
    for _ in range(ROUNDS):  # Metropolis: each state wanders to where it explains the window better
        moves = rng.standard_normal(states.shape) * MOVES[:, np.newaxis]
        moves[[X, Y]] *= np.exp(states[LOG_SCALE])
        tried = states + moves
        tried_scores = score(tried)
        taken = np.log(rng.random(len(scores))) < tried_scores - scores
        states = np.where(taken, tried, states)
        scores = np.where(taken, tried_scores, scores)
    found = Particles(states, scores)
    return found.scaled(log_mass - found.log_mass)


def log_evidence(states: Array, keyframes: tuple[Keyframe, ...], model: SensorModel, weight: float) -> Array:
    """Sum the log-likelihood ratios of keyframes, the newest first, for states (6, n) of the newest, (n,).

    Each keyframe counts with this weight, [0..1].
    """
    base_from_odom = keyframes[0].odom_from_base.inverse()
    motions = [base_from_odom @ keyframe.odom_from_base for keyframe in keyframes]
    log_ratios, crossings = model.log_ratio_along(
        states,
        [keyframe.scan for keyframe in keyframes],
        np.array([[motion.x, motion.y, motion.theta] for motion in motions]),
    )
    return weight * log_ratios - WALL_PENALTY * crossings


def _best(scores: Array, count: int) -> NDArray[np.intp]:
    """Find the best scores, in order of their index."""
    if count >= len(scores):
        return np.arange(len(scores))
    return np.sort(np.argpartition(-scores, count)[:count])
