"""Tell rooms from yards and solid blocks: strokes enclose all three alike (Wolter 2001, section 4.1)."""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.maps.cells.free_space import FreeSpace

YARD_MOUTH, YARD_SHARE = 0.8, 0.12
"""A yard opens to the outside with these shares of its own width and of its outline (decision 0011)."""

BLOCK_OUTSIDE = 0.2
"""A region without an opening is solid unless a larger share of its outline faces the outside."""


@dataclass(frozen=True, slots=True)
class Openings:
    """The widths of what leads out of one region."""

    exits: NDArray[np.float64]  # to the outside
    doors: NDArray[np.float64]  # to other regions


def drop_outdoors(space: FreeSpace, regions: NDArray[np.int64]) -> NDArray[np.int64]:
    """Drop yards and solid blocks among the regions (p,) of pieces: -1."""
    if not space.outside.any():
        return regions
    kept = np.where(np.isin(regions, find_yards(space, regions)), -1, regions)
    return np.where(np.isin(kept, find_blocks(space, kept)), -1, kept)


def openings_of(space: FreeSpace, regions: NDArray[np.int64], number: int) -> Openings:
    """Measure what leads out of a region."""
    sides = regions[space.tessellation.sides]
    at_border = (sides == number).any(axis=1) & (sides[:, 0] != sides[:, 1])
    exits = at_border & space.outside[space.tessellation.sides].any(axis=1)
    doors = at_border & (sides >= 0).all(axis=1)
    widths = space.tessellation.widths
    return Openings(widths[exits], widths[doors])


def find_yards(space: FreeSpace, regions: NDArray[np.int64]) -> list[int]:
    """Find regions that belong to the outside: open to it alone, or far wider than to any other region."""
    yards = []
    for number in np.unique(regions[regions >= 0]):
        openings = openings_of(space, regions, number)
        if len(openings.exits) == 0:
            continue
        members = regions == number
        reach = space.tessellation.reaches[members].max()
        widest = openings.exits.max()
        outline = shapely.length(shapely.union_all(space.tessellation.pieces[members]))
        is_wide_open = widest >= YARD_MOUTH * reach and openings.exits.sum() >= YARD_SHARE * outline
        if len(openings.doors) == 0 or (is_wide_open and YARD_MOUTH * widest > openings.doors.max()):
            yards.append(int(number))
    return yards if len(yards) < len(np.unique(regions[regions >= 0])) else []


def find_blocks(space: FreeSpace, regions: NDArray[np.int64]) -> list[int]:
    """Find closed regions between others: what corridors run around is solid unless it has a door."""
    outdoors = shapely.union_all(space.tessellation.pieces[space.outside])
    blocks = []
    for number in np.unique(regions[regions >= 0]):
        openings = openings_of(space, regions, number)
        if len(openings.exits) == 0 and len(openings.doors) == 0:
            outline = shapely.boundary(shapely.union_all(space.tessellation.pieces[regions == number]))
            facing = shapely.length(shapely.intersection(outline, outdoors))
            if facing <= BLOCK_OUTSIDE * shapely.length(outline):
                blocks.append(int(number))
    return blocks
