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

ENCLOSED = 0.4
"""But not if black ink encloses less than this share of what all ink does: then it is furniture and doors."""

OPEN = 0.04
"""Openings up to this share of the picture's diagonal are closed to see what ink encloses."""

COARSE = 400
"""For that a picture is made this small along its longer side [pixels]."""


def fat_ink(ink: Mask, flat: NDArray[np.float32], widths: AreaWidths) -> tuple[list[Mask], Mask]:
    """Part ink that is wide enough for an area by its colors on flattened paper (height, width, 3).

    Returns the colors that may be walls' and the rest.
    """
    if not np.isfinite(widths.dark):
        return [], np.zeros_like(ink)
    lightest, darkest = brightest(flat), 1.0 - brightest(1.0 - flat)
    dark = lightest < DARK
    colored = lightest - darkest >= COLORED * (1.0 - darkest)
    black, deep = (fat_parts(ink & dark & hue, widths.dark, widths.slender) for hue in (~colored, colored))
    gray, light = (fat_parts(ink & ~dark & hue, widths.pale, widths.slender) for hue in (~colored, colored))
    drawn = np.count_nonzero(black | gray)
    rest = np.count_nonzero(deep | light)
    if (
        drawn
        and drawn >= WALLS * (drawn + rest)
        and (not rest or encloses(ink & dark & ~colored | gray, ink))
    ):
        return [gray, black], fat_parts(ink & colored, widths.dark, widths.slender)
    return [gray, light, black, deep], np.zeros_like(ink)


def encloses(black: Mask, ink: Mask) -> bool:
    """Tell whether black ink encloses a good part of what all ink encloses, with doors closed."""
    from skimage.measure import block_reduce

    step = max(1, max(ink.shape) // COARSE)
    of_black, of_all = (enclosed(block_reduce(mask, (step, step), np.max)) for mask in (black, ink))
    return of_black >= ENCLOSED * of_all


def enclosed(ink: Mask) -> int:
    """Count the pixels that ink encloses, with openings closed."""
    from scipy.ndimage import binary_fill_holes, maximum_filter, minimum_filter

    half = round(OPEN * float(np.hypot(*ink.shape)) / 2.0)
    padded = np.pad(ink, 2 * half + 1)
    closed = minimum_filter(maximum_filter(padded, 2 * half + 1), 2 * half + 1)
    return int(np.count_nonzero(binary_fill_holes(closed)))


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
