"""Join regions to what a person would name: thresholds, corridors; drop what is too small (decision 0010)."""

import numpy as np
from numpy.typing import NDArray

from pilotage.maps.cells.borders import at_border, borders_of, region_areas
from pilotage.maps.cells.tessellation import Tessellation

THRESHOLD_DEPTH, THRESHOLD_WIDTH = 1.0, 0.7
"""A threshold is no deeper than its doors are wide, and these are this share of its own width."""

NICHE, NICHE_WALLS = 0.5, 2.0
"""A niche is at most this share of its width deep, and no deeper than so many walls are thick."""

CORRIDOR_MOUTH, CORRIDOR_WIDTH = 2.3, 2.5
"""A corridor leads on where its wider side is less than so many times as wide as the opening, and the opening
less than so many doors wide."""


def join_thresholds(
    tessellation: Tessellation, regions: NDArray[np.int64], named: NDArray[np.bool_]
) -> NDArray[np.int64]:
    """Join the space within the thickness of a wall, under a door's lintel, to the larger room beside it.

    That of a door to the outside goes to its room, unless a name stands in it: `named` tells in which pieces
    (p,) one does.
    """
    joined = regions.copy()
    areas = region_areas(tessellation, regions)
    sides = regions[tessellation.sides]
    for number in np.flatnonzero(areas > 0.0).tolist():
        members = regions == number
        beside = at_border(sides, number)
        widths = tessellation.widths[beside]
        others = np.setdiff1d(sides[beside], number)
        if len(others) != 2 or areas[number] > THRESHOLD_DEPTH * widths.min() ** 2:
            continue
        if others.min() < 0 and named[members].any():
            continue
        if widths.min() >= THRESHOLD_WIDTH * tessellation.reaches[members].max():
            joined[members] = max(others, key=lambda other: areas[other] if other >= 0 else -1.0)
    return joined


def join_niches(
    tessellation: Tessellation,
    regions: NDArray[np.int64],
    named: NDArray[np.bool_],
    drawn: NDArray[np.bool_],
    thickness: float,
) -> NDArray[np.int64]:
    """Join niches in walls of this thickness, without a door or a name, to the rooms that they open to.

    `named` tells in which pieces (p,) a name stands, and `drawn` which chords (n,) are at drawn doors.
    """
    joined = regions.copy()
    areas = region_areas(tessellation, regions)
    sides = regions[tessellation.sides]
    for number in np.setdiff1d(np.flatnonzero(areas > 0.0), regions[named]):
        beside = at_border(sides, number)
        rooms = np.setdiff1d(sides[beside], number)
        if len(rooms) != 1 or rooms[0] < 0 or drawn[beside].any():
            continue
        width = float(tessellation.widths[beside].max())
        if areas[number] <= width * min(NICHE * width, NICHE_WALLS * thickness):
            joined[regions == number] = rooms[0]
    return joined


def join_corridors(
    tessellation: Tessellation,
    regions: NDArray[np.int64],
    named: NDArray[np.bool_],
    drawn: NDArray[np.bool_],
) -> NDArray[np.int64]:
    """Join the pieces of corridors: what leads on through an opening as wide as itself, without a door.

    Where walls have a thickness a door shows as a narrowing of both sides, between jambs; a corridor that
    turns, branches or widens hardly narrows, or goes on behind the opening as narrow as that. A niche leads
    nowhere and stays what it is, and so does a wide room with a name. Two names are never joined; `named`
    tells in which pieces (p,) one stands, and `drawn` which chords (n,) are at doors that are drawn.
    """
    has_name = np.zeros(len(regions), dtype=bool)
    has_name[regions[named & (regions >= 0)]] = True
    found = borders_of(tessellation, regions, drawn)
    borders, openings, reaches, is_door = found.sides, found.openings, found.reaches, found.is_door
    wide = reaches[borders].max(axis=1)
    if not is_door.any():
        return regions
    door = float(np.median(openings[is_door]))
    is_niche = (np.bincount(borders.ravel())[borders] == 1).any(axis=1) & ~is_door
    leads_on = np.bincount(borders[~is_niche].ravel(), minlength=len(regions)) > 1
    is_room = has_name & (reaches > CORRIDOR_WIDTH * door)
    is_same = ~is_door & (wide < CORRIDOR_MOUTH * openings) & (openings < CORRIDOR_WIDTH * door)
    is_same &= (leads_on & ~is_room)[borders].all(axis=1)
    joined = np.arange(len(regions))
    for first, second in joined[borders[is_same][np.argsort(-openings[is_same], kind="stable")]]:
        one, other = joined[first], joined[second]
        if one != other and not (has_name[one] and has_name[other]):
            has_name[one] |= has_name[other]
            joined[joined == other] = one
    return np.where(regions >= 0, joined[regions], -1)


def drop_small(
    tessellation: Tessellation, regions: NDArray[np.int64], named: NDArray[np.bool_], min_area: float
) -> NDArray[np.int64]:
    """Drop regions that are still too small because nothing opens to them, and have no name: -1."""
    areas = region_areas(tessellation, regions)
    numbers = np.flatnonzero(areas > 0.0)
    small = numbers[areas[numbers] < min_area * areas.sum()]
    small = np.setdiff1d(small, regions[named])
    return np.where(np.isin(regions, small), -1, regions)
