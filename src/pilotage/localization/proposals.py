"""Propose where on the drawing the robot may be: anywhere, near a given pose, or where corners agree.

Shape proposes, visibility ranks. A corner that was seen and one that is drawn, bent the same way, fix heading
and place up to scale; the scale is drawn from the prior (Wolter 2001, section 3.4).
"""

import math
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, Pose2
from pilotage.localization.belief import HEADING, LOG_SCALE, X, Y, stretched
from pilotage.maps import Atlas
from pilotage.shape.corners import Corners

ALIKE = math.radians(30.0)
"""Corners bend alike if their turns differ by less: right angles are drawn a little off."""


@dataclass(frozen=True, slots=True)
class Prior:
    """What is known before the first scan."""

    log_scale: float = 0.45  # deviation of the guess that the drawing allows
    stretch: float = 0.18  # deviation of p and q: proportions 30 % off are common
    known_log_scale: float = 0.2  # deviation where the user gave a scale: drawings vary by place
    known_place: float = 1.0  # [m] deviation where the user gave a start
    known_heading: float = math.radians(10.0)  # [rad] the same


def propose_anywhere(atlas: Atlas, prior: Prior, count: int, rng: np.random.Generator) -> Array:
    """Spread hypotheses evenly over the drawing's free space, with any heading, (6, count)."""
    table = atlas.range_table
    chosen = np.arange(count) * len(table.places) // count
    if count < len(table.places):
        chosen = rng.choice(len(table.places), count)
    places = table.places[chosen] + (rng.random((count, 2)) - 0.5) * table.cell_size
    return np.stack([*places.T, rng.uniform(-math.pi, math.pi, count), *_shapes(atlas, prior, count, rng)])


def propose_near(start: Pose2, atlas: Atlas, prior: Prior, count: int, rng: np.random.Generator) -> Array:
    """Scatter hypotheses around a pose in the sketch that the user gave, (6, count)."""
    log_scales, p, q = _shapes(atlas, prior, count, rng)
    deviations = prior.known_place * np.exp(log_scales)
    return np.stack(
        [
            start.x + deviations * rng.standard_normal(count),
            start.y + deviations * rng.standard_normal(count),
            start.theta + prior.known_heading * rng.standard_normal(count),
            log_scales,
            p,
            q,
        ]
    )


def propose_by_corners(
    seen: Corners, atlas: Atlas, prior: Prior, count: int, rng: np.random.Generator
) -> Array:
    """Lay corners seen, in the frame of the robot [m], on drawn ones that bend alike, (6, <= count).

    Corners between long walls are tried more often: clutter has short ones. Empty if nothing bends alike.
    """
    drawn = atlas.corners
    if len(seen) == 0 or len(drawn) == 0:
        return np.empty((6, 0))
    tried = seen.chosen(rng.choice(len(seen), count, p=seen.lengths / seen.lengths.sum()))
    known = drawn.chosen(rng.choice(len(drawn), count))
    alike = np.flatnonzero(np.abs(tried.turns - known.turns) < ALIKE)
    tried, known = tried.chosen(alike), known.chosen(alike)
    states = np.zeros((6, len(alike)))
    states[HEADING] = known.directions - tried.directions
    states[LOG_SCALE:] = _shapes(atlas, prior, len(alike), rng)
    states[[X, Y]] = known.vertices.T - stretched(states, *tried.vertices.T)
    return states


def _shapes(atlas: Atlas, prior: Prior, count: int, rng: np.random.Generator) -> Array:
    """Draw log scales and stretches, (3, count)."""
    deviations = np.array([[prior.log_scale], [prior.stretch], [prior.stretch]])
    usual = np.array([[atlas.log_scale], [0.0], [0.0]])
    return np.asarray(usual + deviations * rng.standard_normal((3, count)))
