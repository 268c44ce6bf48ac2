"""How wide lines are, and from which width on ink is an area: thick walls beside thin lines."""

import math
from dataclasses import dataclass

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

SLENDER = 3.0
"""In a clean picture what is hardly wide enough for an area is so over this many widths: arcs and slanted
lines have ragged edges, and are wider here and there. In a photo noise parts walls, too."""


def depth_of(ink: Mask) -> NDArray[np.float32]:
    """Measure how far ink is from its edge [pixels], (height, width)."""
    from scipy.ndimage import distance_transform_edt

    rows, columns = (np.nonzero(ink.any(axis=axis))[0] for axis in (1, 0))
    depth = np.zeros(ink.shape, dtype=np.float32)
    if rows.size:
        box = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
        padded = np.pad(ink[box], 1)
        edge = distance_transform_edt(padded, return_distances=False, return_indices=True)
        inked = np.nonzero(padded)  # most of a picture is paper: no distances are computed there
        away = [nearest[inked] - own for nearest, own in zip(edge, inked, strict=True)]
        depth[box][ink[box]] = np.sqrt((away[0] ** 2 + away[1] ** 2).astype(np.float64))
    return depth


def width_at(depth: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the width of ink that is so far from its edge in its middle [pixels]."""
    return np.asarray(np.maximum(np.float32(1.0), 2.0 * depth - 0.5), dtype=np.float32)


@dataclass(frozen=True, slots=True)
class AreaWidths:
    """From which width on ink is an area [pixels]."""

    dark: float
    pale: float  # infinite if there are none; a blurred line is pale, and wider than it was drawn
    slender: float = 1.0  # how long what is hardly so wide must be, in these widths


def area_widths(widths: NDArray[np.float32], pen_width: float, diagonal: float) -> AreaWidths:
    """Tell areas from lines by the widths of lines (n,) [pixels]; thick dark lines beside thin are areas."""
    from skimage.filters import threshold_otsu

    fat = max(FAT * pen_width, LEAST_FAT * diagonal)
    if not (widths > fat).any():
        fat = math.inf
    lines = np.log(widths[widths <= fat])
    if not lines.size or float(np.ptp(lines)) == 0.0:
        return AreaWidths(fat, fat)
    between = float(threshold_otsu(lines))
    thick, thin = lines[lines > between], lines[lines <= between]
    if min(len(thick), len(thin)) < EACH * len(lines) or np.exp(between) < THINNEST:
        return AreaWidths(fat, fat)
    two_pens = thick.mean() - thin.mean() > np.log(TWO_PENS)
    return AreaWidths(float(np.exp(between)) if two_pens else fat, fat)


def fat_parts(ink: Mask, width: float, slender: float = 1.0) -> Mask:
    """Mark ink that is wider than this [pixels] over more than its own width, (height, width).

    Where two lines cross they are wide, too, but over no length. What is nowhere twice as wide must be so
    over more than `slender` widths.
    """
    from scipy.ndimage import maximum_filter
    from skimage.measure import label, regionprops

    core = deeper_than(ink, width / 2.0)
    labels = label(core, connectivity=2)
    twice = np.bincount(labels[deeper_than(ink, width)], minlength=labels.max() + 1)[1:] > 0
    long = [
        max(part.image.shape) > (1.0 if is_twice else slender) * width
        for part, is_twice in zip(regionprops(labels), twice, strict=True)
    ]
    if not any(long):
        return np.zeros_like(ink)
    core = np.concatenate([[False], long])[labels]
    return np.asarray(ink & maximum_filter(core, 2 * int(np.ceil(width / 2.0)) + 3))


def deeper_than(ink: Mask, depth: float) -> Mask:
    """Mark ink that is farther than this from its edge [pixels], (height, width).

    With `depth_of` it would take five times as long: paper is shifted by all that lies within a disc instead.
    """
    if depth >= max(ink.shape):
        return np.zeros_like(ink)
    reach = int(depth)
    paper = np.pad(~ink, reach + 1, constant_values=True)
    near, wide, half = np.zeros_like(paper), paper.copy(), 0
    for rows in range(reach, -1, -1):  # the disc is a row of pixels more than 2 `half` wide, so many rows off
        while (half + 1) ** 2 + rows**2 <= depth**2:
            half += 1
            wide[:, half:] |= paper[:, :-half]
            wide[:, :-half] |= paper[:, half:]
        near[rows:] |= wide[: len(wide) - rows]
        near[: len(near) - rows] |= wide[rows:]
    return np.asarray(~near[reach + 1 : -reach - 1, reach + 1 : -reach - 1])
