"""How wide lines are, and from which width on ink is an area: thick walls beside thin lines."""

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]

FAT = 2.2
"""Ink wider than so many widths of the pen is an area."""

LEAST_FAT = 0.004
"""And wider than this share of the picture's diagonal."""

TWO_PENS = 1.7
"""A drawing has thick and thin lines if their mean widths differ by this factor."""

EACH = 0.1
"""And if each of the two has at least this share of the length of all lines."""

THINNEST = 3.5
"""A thick line is wider than this [pixels]: below it widths cannot be told."""

CORNER = 1.5
"""The corner of an area is so many times as far from where a disk fits as its sides are."""


def widths_of(ink: Mask, middle: Mask) -> NDArray[np.float64]:
    """Measure ink at each pixel of its middle lines [pixels], (n,)."""
    from scipy.ndimage import distance_transform_edt

    return np.asarray(np.maximum(1.0, 2.0 * distance_transform_edt(ink)[middle] - 0.5))


def least_area_width(widths: NDArray[np.float64], pen_width: float, diagonal: float) -> float:
    """Tell from which width on ink is an area [pixels]."""
    from skimage.filters import threshold_otsu

    fat = max(FAT * pen_width, LEAST_FAT * diagonal)
    lines = np.log(widths[widths <= fat])
    if not lines.size or float(np.ptp(lines)) == 0.0:
        return fat
    between = float(threshold_otsu(lines))
    thick, thin = lines[lines > between], lines[lines <= between]
    if min(len(thick), len(thin)) < EACH * len(lines) or np.exp(between) < THINNEST:
        return fat
    return float(np.exp(between)) if thick.mean() - thin.mean() > np.log(TWO_PENS) else fat


def fat_parts(ink: Mask, width: float) -> Mask:
    """Mark ink that is wider than this [pixels] over more than its own width, (height, width).

    Where two lines cross they are wide, too, but over no length.
    """
    from scipy.ndimage import distance_transform_edt
    from skimage.measure import label, regionprops

    core = distance_transform_edt(np.pad(ink, 1))[1:-1, 1:-1] > width / 2.0
    labels = label(core, connectivity=2)
    long = [max(part.image.shape) > width for part in regionprops(labels)]
    core = np.concatenate([[False], long])[labels] if long else core
    if not core.any():
        return np.zeros_like(ink)
    return np.asarray(ink & (distance_transform_edt(~core) <= CORNER * width / 2.0 + 1.0))
