"""What is known before the first scan, and particles drawn from it."""

import math
from dataclasses import dataclass

import numpy as np

from pilotage.errors import PilotageError
from pilotage.geometry import Array, Pose2
from pilotage.localization.particles import HEADING, LOG_SCALE, X, Y, displacements
from pilotage.maps import Atlas
from pilotage.shape.corners import Corners

MAX_TURN_DIFFERENCE = math.radians(30.0)
"""A seen and a drawn corner may be the same if their turns differ by less: angles are drawn a little off."""

MIN_DIAGONAL, MAX_DIAGONAL = 1.0, 10_000.0
"""[m] of a drawing: a scale by which it is smaller or larger is a slip, or metres per unit were given."""


class ScaleError(PilotageError, ValueError):
    """A scale that is given makes a drawing smaller or larger than any building."""


@dataclass(frozen=True, slots=True)
class Prior:
    """Standard deviations of what is known before the first scan."""

    log_scale: float = 0.45  # of the logarithm of the scale that is guessed from the size of the drawing
    stretch: float = 0.18  # of p and of q: proportions that are off by 30 % are common
    given_log_scale: float = 0.2  # of the logarithm of a scale that the user gives
    given_position: float = 1.0  # [m] of a start that the user gives
    given_heading: float = math.radians(10.0)  # [rad] of a heading that the user gives

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in self.__slots__:
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name} must be > 0 and finite, got {getattr(self, name)}")


def check_scale(scale: float, diagonal: float) -> None:
    """Reject a scale [drawing units per metre] by which a drawing of this diagonal [units] is no building.

    Raises ScaleError, or ValueError if the scale is not positive and finite.
    """
    if not (scale > 0.0 and math.isfinite(scale)):
        raise ValueError(f"scale must be positive and finite, got {scale}")
    if not MIN_DIAGONAL <= diagonal / scale <= MAX_DIAGONAL:
        raise ScaleError(
            f"a scale is drawing units per metre: at {scale:g} the drawing would be"
            f" {diagonal / scale:.3g} m across"
        )


def draw_anywhere(atlas: Atlas, prior: Prior, count: int, rng: np.random.Generator) -> Array:
    """Draw states evenly over the free space of the drawing, with any heading, (6, count)."""
    table = atlas.range_table
    chosen = np.arange(count) * len(table.places) // count
    if count < len(table.places):
        chosen = rng.choice(len(table.places), count)
    points = table.places[chosen] + (rng.random((count, 2)) - 0.5) * table.cell_size
    return np.stack(
        [*points.T, rng.uniform(-math.pi, math.pi, count), *_draw_scales(atlas, prior, count, rng)]
    )


def draw_near(
    start: Pose2, atlas: Atlas, prior: Prior, count: int, rng: np.random.Generator, *, heading_std: float
) -> Array:
    """Draw states around a pose in the sketch that the user gave, (6, count); `heading_std` in rad."""
    log_scales, p, q = _draw_scales(atlas, prior, count, rng)
    position_std = prior.given_position * np.exp(log_scales)
    return np.stack(
        [
            start.x + position_std * rng.standard_normal(count),
            start.y + position_std * rng.standard_normal(count),
            start.theta + heading_std * rng.standard_normal(count),
            log_scales,
            p,
            q,
        ]
    )


def draw_at_corners(seen: Corners, atlas: Atlas, prior: Prior, count: int, rng: np.random.Generator) -> Array:
    """Lay corners seen, in the robot's frame [m], on drawn corners that turn alike, (6, <= count).

    A pair of corners fixes position and heading up to the scale, which is drawn from the prior (Wolter 2001,
    section 3.4). Corners between long walls are tried more often: clutter has short ones.
    """
    drawn = atlas.corners
    if len(seen) == 0 or len(drawn) == 0:
        return np.empty((6, 0))
    ours = seen.chosen(rng.choice(len(seen), count, p=seen.lengths / seen.lengths.sum()))
    theirs = drawn.chosen(rng.choice(len(drawn), count))
    alike = np.flatnonzero(np.abs(ours.turns - theirs.turns) < MAX_TURN_DIFFERENCE)
    ours, theirs = ours.chosen(alike), theirs.chosen(alike)
    states = np.zeros((6, len(alike)))
    states[HEADING] = theirs.directions - ours.directions
    states[LOG_SCALE:] = _draw_scales(atlas, prior, len(alike), rng)
    states[[X, Y]] = theirs.vertices.T - displacements(states, *ours.vertices.T)
    return states


def _draw_scales(atlas: Atlas, prior: Prior, count: int, rng: np.random.Generator) -> Array:
    """Draw log scale, p and q from the prior, (3, count)."""
    std = np.array([[prior.log_scale], [prior.stretch], [prior.stretch]])
    mean = np.array([[atlas.log_scale], [0.0], [0.0]])
    return np.asarray(mean + std * rng.standard_normal((3, count)))
