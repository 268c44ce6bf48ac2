"""Tell ink from paper, and the lines that paper was printed with from both."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage.io.picture.colors import brightest

Mask = NDArray[np.bool_]

LEAST_CONTRAST = 0.12
"""Ink takes at least this share of paper's light."""

FAINT = 0.6
"""Ruled lines have less than this share of the contrast of the pen."""

RULED = 0.55
"""Faint ink is ruling if at least this share of it lies on straight lines across the paper."""

ACROSS = 0.25
"""A line across the paper covers this share of its side, in one piece or with words and walls over it."""

MANY = 6
"""Ruled paper has at least so many lines; fewer are walls in another pen."""

STEEPEST = 0.03
"""Ruled lines slant by at most this much on a straightened sheet."""

SLANTS = 13
"""So many slants are tried."""


@dataclass(frozen=True, eq=False)
class Ink:
    """What was drawn."""

    mask: Mask  # (height, width)
    ruled: bool  # whether lines of ruled or squared paper were taken away


def find_ink(flat: NDArray[np.float32]) -> Ink:
    """Find ink of any color on flattened paper (height, width, 3)."""
    from scipy.ndimage import binary_dilation
    from skimage.filters import threshold_otsu

    contrast = brightest(1.0 - flat)
    drawn = contrast[contrast > LEAST_CONTRAST]
    if not drawn.size or float(np.ptp(drawn)) == 0.0:
        return Ink(contrast > LEAST_CONTRAST, ruled=False)
    between = float(threshold_otsu(drawn))
    pen = float(np.median(drawn[drawn > between]))
    faint_until = min(between, FAINT * pen)
    strong = contrast > faint_until
    faint = (contrast > LEAST_CONTRAST) & ~binary_dilation(strong, iterations=2)
    if is_ruled(faint):
        return Ink(strong, ruled=True)
    return Ink(contrast > max(LEAST_CONTRAST, 0.4 * min(between, 0.6 * pen)), ruled=False)


def is_ruled(faint: Mask) -> bool:
    """Tell whether faint ink is mostly straight lines across the paper, many of them, along either side."""
    total = int(np.count_nonzero(faint))
    if not total:
        return False
    found = [lines_across(faint), lines_across(faint.T)]
    return max(lines for lines, _ in found) >= MANY and sum(ink for _, ink in found) > RULED * total


def lines_across(faint: Mask) -> tuple[int, int]:
    """Count lines across the paper, as steep as most of them are, and the pixels on them."""
    rows, columns = np.nonzero(faint)
    width = faint.shape[1]
    reach = int(STEEPEST * width) + 1  # so that no row is below 0
    best = 0, 0
    for slant in np.linspace(-STEEPEST, STEEPEST, SLANTS):
        row = np.round(rows + slant * columns).astype(np.int64) + reach
        counts = np.bincount(row, minlength=1)
        across = counts > ACROSS * width
        lines = int(np.count_nonzero(across[1:] & ~across[:-1]))
        best = max(best, (lines, int(counts[across].sum())), key=lambda found: found[1])
    return best
