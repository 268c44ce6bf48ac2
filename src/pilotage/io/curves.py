"""Cut curves into chords."""

import math
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from pilotage.geometry import Array

STEP = math.pi / 16.0
"""A chord spans at most this turn of its curve [rad]: it strays from a circle by 0.5 % of the radius."""

FEWEST_CHORDS = 4
"""Chords of an arc at least: with fewer, its circle cannot be told."""

MOST_CHORDS = 64
"""Chords of one Bezier curve at most."""


def bezier(control: ArrayLike) -> Array:
    """Cut a Bezier curve of any degree, control points (k, 2), into chords: its points without the first.

    The number of chords follows the turn of the control polygon, which is never less than the curve's.

    >>> len(bezier([(0, 0), (0, 1), (1, 1)])), len(bezier([(0, 0), (1, 0), (2, 0), (3, 0)]))
    (8, 1)
    """
    points = np.asarray(control, dtype=np.float64)
    steps = np.diff(points, axis=0)
    steps = steps[np.abs(steps).max(axis=1) > 0.0]
    headings = np.arctan2(steps[:, 1], steps[:, 0])
    turns = np.abs((np.diff(headings) + math.pi) % (2.0 * math.pi) - math.pi)
    chords = min(max(1, math.ceil(float(turns.sum()) / STEP - 1e-9)), MOST_CHORDS)
    share = (np.arange(1, chords + 1) / chords)[:, None]
    layer = [points[k : k + 1].repeat(chords, axis=0) for k in range(len(points))]
    while len(layer) > 1:  # de Casteljau
        layer = [a + share * (b - a) for a, b in pairwise(layer)]
    return layer[0]


def arc(center: ArrayLike, radii: tuple[float, float], start: float, sweep: float) -> Array:
    """Cut an arc of an ellipse along x and y into chords (n, 2); angles are those of its circle [rad].

    >>> arc((0, 0), (2, 1), 0.0, math.pi / 2).round(6)[[0, -1]].tolist()
    [[2.0, 0.0], [0.0, 1.0]]
    """
    sweep = min(max(sweep, -2.0 * math.pi), 2.0 * math.pi)
    angles = start + sweep * np.linspace(
        0.0, 1.0, max(FEWEST_CHORDS, math.ceil(abs(sweep) / STEP - 1e-9)) + 1
    )
    return np.asarray(center) + np.column_stack([radii[0] * np.cos(angles), radii[1] * np.sin(angles)])
