"""Tell rooms from yards and solid blocks: strokes enclose all three alike."""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.maps.cells.free_space import FreeSpace


@dataclass(frozen=True, slots=True)
class EnclosureSettings:
    """When a region of free space is no room after all."""

    yard_mouth: float = 0.8  # it opens to the outside with this share of its own width ...
    yard_share: float = 0.12  # ... and of its outline, and nothing inside is as wide: the end of a yard
    block_outside: float = 0.2  # it has no opening, and no more of its outline faces the outside: a block

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("yard_mouth", "yard_share", "block_outside"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")


@dataclass(frozen=True, slots=True)
class Openings:
    """The widths of what leads out of one region."""

    exits: NDArray[np.float64]  # to the outside
    doors: NDArray[np.float64]  # to other regions


def drop_outdoors(
    space: FreeSpace, regions: NDArray[np.int64], settings: EnclosureSettings
) -> NDArray[np.int64]:
    """Give up yards and blocks among the regions (p,) of pieces: -1."""
    if not space.outside.any():
        return regions
    kept = np.where(np.isin(regions, find_yards(space, regions, settings)), -1, regions)
    return np.where(np.isin(kept, find_blocks(space, kept, settings)), -1, kept)


def openings_of(space: FreeSpace, regions: NDArray[np.int64], number: int) -> Openings:
    """Measure what leads out of a region."""
    sides = regions[space.tessellation.sides]
    at_border = (sides == number).any(axis=1) & (sides[:, 0] != sides[:, 1])
    exits = at_border & space.outside[space.tessellation.sides].any(axis=1)
    doors = at_border & (sides >= 0).all(axis=1)
    widths = space.tessellation.widths
    return Openings(widths[exits], widths[doors])


def find_yards(space: FreeSpace, regions: NDArray[np.int64], settings: EnclosureSettings) -> list[int]:
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
        agape = (
            widest >= settings.yard_mouth * reach and openings.exits.sum() >= settings.yard_share * outline
        )
        if len(openings.doors) == 0 or (agape and settings.yard_mouth * widest > openings.doors.max()):
            yards.append(int(number))
    return yards if len(yards) < len(np.unique(regions[regions >= 0])) else []


def find_blocks(space: FreeSpace, regions: NDArray[np.int64], settings: EnclosureSettings) -> list[int]:
    """Find closed regions amid others: what corridors run around is solid unless it has a door."""
    outdoors = shapely.union_all(space.tessellation.pieces[space.outside])
    blocks = []
    for number in np.unique(regions[regions >= 0]):
        openings = openings_of(space, regions, number)
        if len(openings.exits) == 0 and len(openings.doors) == 0:
            outline = shapely.boundary(shapely.union_all(space.tessellation.pieces[regions == number]))
            facing = shapely.length(shapely.intersection(outline, outdoors))
            if facing <= settings.block_outside * shapely.length(outline):
                blocks.append(int(number))
    return blocks
