"""Tell rooms from yards and solid blocks: strokes enclose all three alike (Wolter 2001, section 4.1)."""

from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.maps.cells.borders import at_border
from pilotage.maps.cells.free_space import FreeSpace

YARD_MOUTH, YARD_SHARE = 0.8, 0.12
"""A yard opens to the outside with these shares of its own width and of its outline (decision 0011)."""

FRONT_DOOR = 0.6
"""An opening to the outside is a door if it is narrower than this share of the region's own width."""

BLOCK_OUTSIDE = 0.2
"""A region without an opening is solid unless a larger share of its outline faces the outside."""

MOST = 0.5
"""Doors were not drawn if more than this share of the regions is closed ..."""
AT_OUTER_WALL = 2
"""... and at least so many of these lie at the outer wall."""


@dataclass(frozen=True, slots=True)
class Openings:
    """The widths of what leads out of one region."""

    exits: NDArray[np.float64]  # to the outside
    mouths: NDArray[np.float64]  # those of them that are no drawn doors
    doors: NDArray[np.float64]  # to other regions


def drop_outdoors(
    space: FreeSpace,
    regions: NDArray[np.int64],
    titled: NDArray[np.bool_],
    *,
    solids_known: bool = False,
) -> NDArray[np.int64]:
    """Drop yards and solid blocks among the regions (p,) of pieces: -1.

    `titled` tells the pieces (p,) in which something is written. A closed region with words is a room, and so
    is each one where solids are known, or where doors were not drawn.
    A region that opens to the outside alone is a room if it does so by doors, and has words or solids are
    known. What gapes at the outside is a yard only where solids are known: in a sketch the end of a room or
    corridor is often left open.
    """
    if not space.outside.any():
        return regions
    kept, is_first = regions, True
    while yards := [
        number
        for number in find_yards(space, kept, gaping=solids_known, apart=is_first)
        if not ((solids_known or titled[kept == number].any()) and has_front(space, kept, number))
    ]:
        found = np.isin(kept, yards)
        kept, is_first = np.where(found, -1, kept), False  # what lost its yard to the outside stays
        if not solids_known:
            break
        space = replace(space, outside=space.outside | found)  # what gapes at a yard is a yard, too
    if solids_known:
        return kept
    blocks = [number for number in find_blocks(space, kept) if not titled[kept == number].any()]
    left = np.where(np.isin(kept, blocks), -1, kept)
    return left if (left >= 0).any() else kept


def openings_of(space: FreeSpace, regions: NDArray[np.int64], number: int) -> Openings:
    """Measure what leads out of a region."""
    sides = regions[space.tessellation.sides]
    beside = at_border(sides, number)
    exits = beside & space.outside[space.tessellation.sides].any(axis=1)
    doors = beside & (sides >= 0).all(axis=1)
    widths = space.tessellation.widths
    return Openings(widths[exits], widths[exits & ~space.drawn], widths[doors])


def has_front(space: FreeSpace, regions: NDArray[np.int64], number: int) -> bool:
    """Tell whether a region opens to the outside by doors alone: drawn ones, or far narrower than itself."""
    widest = openings_of(space, regions, number).mouths.max(initial=0.0)
    return bool(widest < FRONT_DOOR * space.tessellation.reaches[regions == number].max())


def find_yards(space: FreeSpace, regions: NDArray[np.int64], *, gaping: bool, apart: bool) -> list[int]:
    """Find regions that belong to the outside.

    With `apart` those that open to the outside alone; with `gaping` those that open to it widely, and far
    wider than to any other region.
    """
    yards = []
    numbers = np.unique(regions[regions >= 0])
    for number in numbers:
        openings = openings_of(space, regions, number)
        if len(openings.exits) == 0:
            continue
        is_apart = len(openings.doors) == 0
        if (apart and is_apart) or (gaping and does_gape(space, regions == number, openings)):
            yards.append(int(number))
    return yards if len(yards) < len(numbers) else []


def does_gape(space: FreeSpace, members: NDArray[np.bool_], openings: Openings) -> bool:
    """Tell whether a region opens to the outside in its full width, and far wider than to any other."""
    if len(openings.mouths) == 0:
        return False
    widest = openings.mouths.max()
    outline = shapely.length(shapely.union_all(space.tessellation.pieces[members]))
    return bool(
        widest >= YARD_MOUTH * space.tessellation.reaches[members].max()
        and openings.mouths.sum() >= YARD_SHARE * outline
        and (len(openings.doors) == 0 or YARD_MOUTH * widest > openings.doors.max())
    )


def find_blocks(space: FreeSpace, regions: NDArray[np.int64]) -> list[int]:
    """Find closed regions between others: what corridors run around is solid unless it has a door.

    Where doors were not drawn there are none.
    """
    outdoors = shapely.union_all(space.tessellation.pieces[space.outside])
    numbers = np.unique(regions[regions >= 0])
    blocks: list[int] = []
    at_outer_wall = 0
    for number in numbers:
        openings = openings_of(space, regions, number)
        if len(openings.exits) == 0 and len(openings.doors) == 0:
            outline = shapely.boundary(shapely.union_all(space.tessellation.pieces[regions == number]))
            facing = shapely.length(shapely.intersection(outline, outdoors))
            if facing <= BLOCK_OUTSIDE * shapely.length(outline):
                blocks.append(int(number))
            else:
                at_outer_wall += 1
    most_are_closed = len(blocks) + at_outer_wall > MOST * len(numbers)
    return [] if most_are_closed and at_outer_wall >= AT_OUTER_WALL else blocks
