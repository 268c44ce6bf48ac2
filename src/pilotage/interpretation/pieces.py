"""Take lines apart into straight pieces, and make fewer of them: drawings repeat lines and hatch walls."""

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.interpretation.paint import parts_of

DIRECTIONS = 3000
"""Pieces whose directions fall into one of so many bins of half a turn may lie on one line."""


def straight(lines: shapely.Geometry | NDArray[np.object_]) -> Array:
    """Take lines apart, (n, 2, 2)."""
    points, owners = shapely.get_coordinates(parts_of(lines), return_index=True)
    return np.asarray(np.stack([points[:-1], points[1:]], axis=1)[owners[:-1] == owners[1:]])


def on_grid(ends: Array, grain: float) -> Array:
    """Round the ends of pieces (n, 2, 2) to a grid, and keep each of them once, and none without length."""
    rounded = np.round(ends / grain)
    pairs = np.unique(np.sort(rounded.view(complex).reshape(-1, 2)), axis=0)
    pairs = pairs[pairs[:, 0] != pairs[:, 1]] * grain
    return np.stack([pairs.real, pairs.imag], axis=-1)


def joined(ends: Array, grain: float) -> Array:
    """Join pieces (n, 2, 2) that lie on one line and touch or overlap, up to a grain.

    >>> joined(np.array([[[0.0, 0.0], [1.0, 0.0]], [[2.0, 0.0], [0.5, 0.0]]]), 0.01).tolist()
    [[[0.0, 0.0], [2.0, 0.0]]]
    """
    steps = ends[:, 1] - ends[:, 0]
    ends, steps = ends[steps.any(axis=1)], steps[steps.any(axis=1)]
    if not len(ends):
        return ends
    angles = np.arctan2(steps[:, 1], steps[:, 0])
    directions = np.round(angles / np.pi * DIRECTIONS) % DIRECTIONS
    along = np.stack([np.cos(directions / DIRECTIONS * np.pi), np.sin(directions / DIRECTIONS * np.pi)])
    places = (ends[..., 0] - ends[0, 0, 0]) * along[0, :, None]
    places += (ends[..., 1] - ends[0, 0, 1]) * along[1, :, None]
    ends = np.where((places[:, 0] > places[:, 1])[:, None, None], ends[:, ::-1], ends)
    places.sort(axis=1)
    middles = ends.mean(axis=1) - ends[0, 0]
    offsets = np.round((along[0] * middles[:, 1] - along[1] * middles[:, 0]) / grain)
    order = np.lexsort((places[:, 0], offsets, directions))
    ends, places, offsets, directions = ends[order], places[order], offsets[order], directions[order]
    lines = np.cumsum(np.append(False, (np.diff(directions) != 0.0) | (np.diff(offsets) != 0.0)))
    places += (lines * 2.0 * (np.ptp(places) + grain))[:, None]  # one line after the other
    reach = np.maximum.accumulate(places[:, 1])
    begins = np.append(True, places[1:, 0] > reach[:-1] + grain)
    firsts = np.flatnonzero(begins)
    by_end = np.lexsort((places[:, 1], np.cumsum(begins)))
    lasts = by_end[np.append(firsts[1:], len(ends)) - 1]
    return np.stack([ends[firsts, 0], ends[lasts, 1]], axis=1)


def without_scribble(ends: Array, step: float) -> Array:
    """Keep one of all pieces (n, 2, 2) that are shorter than a step and have their middle in one square."""
    short = np.hypot(*(ends[:, 1] - ends[:, 0]).T) < step
    squares = np.floor(ends[short].mean(axis=1) / step)
    _, first = np.unique(squares, axis=0, return_index=True)
    return np.concatenate([ends[~short], ends[short][np.sort(first)]])
