"""The openings between regions, and which of them are doors (Wolter 2001, section 4.1)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps.cells.tessellation import Tessellation

NARROWING = 1.42
"""Both sides are this many times as wide as the opening: a door. Where two corridors cross, free space is
sqrt(2) times as wide as they are, and that is none."""

JAMBS = 1.25
"""Between the jambs of a door, free space is this many times as wide beside it as in it."""


@dataclass(frozen=True, eq=False)
class Borders:
    """The pairs of regions with openings between them."""

    sides: NDArray[np.int64]  # (n, 2)
    openings: Array  # (n,) how wide the widest of each is
    is_door: NDArray[np.bool_]  # (n,) whether doors are drawn in all, or both sides narrow to jambs
    reaches: Array  # how wide each region is, indexed by its number


def at_border(sides: NDArray[np.int64], number: int) -> NDArray[np.bool_]:
    """Tell which chords lead out of a region, (n,); `sides` (n, 2) are the regions of both sides of each."""
    led_out: NDArray[np.bool_] = (sides == number).any(axis=1) & (sides[:, 0] != sides[:, 1])
    return led_out


def borders_of(tessellation: Tessellation, regions: NDArray[np.int64], drawn: NDArray[np.bool_]) -> Borders:
    """List the pairs of regions with openings between them.

    `regions` is the region of each piece, (p,); `drawn` tells which chords are doors that are drawn, (n,).
    """
    reaches = np.zeros(len(regions))
    np.maximum.at(reaches, regions[regions >= 0], tessellation.reaches[regions >= 0])
    sides = regions[tessellation.sides]
    between = (sides >= 0).all(axis=1) & (sides[:, 0] != sides[:, 1])
    pairs, owner = np.unique(np.sort(sides[between], axis=1), axis=0, return_inverse=True)
    openings, jambs = np.zeros(len(pairs)), np.zeros(len(pairs))
    np.maximum.at(openings, owner.ravel(), tessellation.widths[between])
    others = np.bincount(owner.ravel(), ~drawn[between], minlength=len(pairs))
    np.maximum.at(
        jambs, owner.ravel(), tessellation.widening[between]
    )  # how far free space widens beside an opening
    narrow = reaches[pairs].min(axis=1)
    is_door = ((narrow >= NARROWING * openings) & (jambs >= JAMBS)) | (others == 0)
    return Borders(pairs, openings, is_door, reaches)


def region_areas(tessellation: Tessellation, regions: NDArray[np.int64]) -> Array:
    """Sum the area of each region, indexed by its number."""
    kept = regions >= 0
    return np.bincount(regions[kept], tessellation.areas[kept], minlength=len(regions)).astype(np.float64)
