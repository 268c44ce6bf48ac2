"""The few colors that fat ink has in a picture of a plan: black, gray, dark and light ones of each hue."""

import numpy as np
from numpy.typing import NDArray

from pilotage.io.picture.width import fat_parts

Mask = NDArray[np.bool_]

DARK = 0.5
"""Ink with no color brighter than this share of paper is dark."""

COLORED = 0.25
"""Ink whose colors differ by this share of paper has a hue."""

HUES = 6
"""So many hues are told apart."""

WALLS = 0.05
"""If this share of fat ink is black or gray, walls are; what has a hue are floors, signs and titles."""


def fat_ink(ink: Mask, flat: NDArray[np.float32], width: float) -> tuple[list[Mask], Mask]:
    """Part ink that is wider than a width [pixels] by its colors on flattened paper (height, width, 3).

    Returns the colors that may be walls' and the rest.
    """
    if not fat_parts(ink, width).any():
        return [], np.zeros_like(ink)
    dark = flat.max(axis=2) < DARK
    colored = np.ptp(flat, axis=2) >= COLORED
    black, gray, deep, light = (
        fat_parts(ink & shade & hue, width) for hue in (~colored, colored) for shade in (dark, ~dark)
    )
    drawn = np.count_nonzero(black | gray)
    if drawn >= WALLS * (drawn + np.count_nonzero(deep | light)):
        return [gray, black], deep | light
    return [gray, light, black, deep], np.zeros_like(ink)


def hue_of(color: tuple[float, float, float]) -> int:
    """Return the number of a hue, from 0 to HUES - 1; -1 for none.

    >>> hue_of((1.0, 0.0, 0.0)), hue_of((0.0, 0.0, 1.0)), hue_of((0.5, 0.5, 0.5))
    (0, 4, -1)
    """
    red, green, blue = color
    span = max(color) - min(color)
    if span < COLORED:
        return -1
    if max(color) == red:
        turn = (green - blue) / span
    elif max(color) == green:
        turn = 2.0 + (blue - red) / span
    else:
        turn = 4.0 + (red - green) / span
    return round(turn) % HUES
