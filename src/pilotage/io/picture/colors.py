"""The few colors that fat ink has in a picture of a plan: black, gray, dark and light ones of each hue."""

import numpy as np
from numpy.typing import NDArray

from pilotage.io.picture.width import AreaWidths, fat_parts

Mask = NDArray[np.bool_]

DARK = 0.5
"""Ink with no color brighter than this share of paper is dark."""

COLORED = 0.3
"""Ink whose colors differ by this share of its contrast to paper has a hue."""

HUES = 6
"""So many hues are told apart."""

WALLS = 0.05
"""If this share of fat ink is black or gray, walls are; what has a hue are floors, signs and titles."""


def fat_ink(ink: Mask, flat: NDArray[np.float32], widths: AreaWidths) -> tuple[list[Mask], Mask]:
    """Part ink that is wide enough for an area by its colors on flattened paper (height, width, 3).

    Returns the colors that may be walls' and the rest.
    """
    if not np.isfinite(widths.dark):
        return [], np.zeros_like(ink)
    lightest, darkest = brightest(flat), 1.0 - brightest(1.0 - flat)
    dark = lightest < DARK
    colored = lightest - darkest >= COLORED * (1.0 - darkest)
    black, deep = (fat_parts(ink & dark & hue, widths.dark) for hue in (~colored, colored))
    gray, light = (fat_parts(ink & ~dark & hue, widths.pale) for hue in (~colored, colored))
    drawn = np.count_nonzero(black | gray)
    if drawn >= WALLS * (drawn + np.count_nonzero(deep | light)):
        return [gray, black], fat_parts(ink & colored, widths.dark)
    return [gray, light, black, deep], np.zeros_like(ink)


def brightest(flat: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the brightest of the three colors of each pixel."""
    return np.maximum(np.maximum(flat[..., 0], flat[..., 1]), flat[..., 2])


def hue_of(color: tuple[float, float, float]) -> int:
    """Return the number of a hue, from 0 to HUES - 1; -1 for none.

    >>> hue_of((1.0, 0.0, 0.0)), hue_of((0.0, 0.0, 1.0)), hue_of((0.5, 0.5, 0.5))
    (0, 4, -1)
    """
    red, green, blue = color
    span = max(color) - min(color)
    if span < COLORED * (1.0 - min(color)) or span == 0.0:
        return -1
    if max(color) == red:
        turn = (green - blue) / span
    elif max(color) == green:
        turn = 2.0 + (blue - red) / span
    else:
        turn = 4.0 + (red - green) / span
    return round(turn) % HUES
