"""Find the openings of doors that are drawn with a leaf or its swing."""

import math
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Polyline
from pilotage.maps.cells.tessellation import Tessellation

OFF = 0.5
"""A chord is at a door if its middle is no farther off than this, in widths of most doors or of its own."""

ALONG = 0.8
"""And if it turns from the door by no more than an angle of this cosine."""

SLANT = 0.2
"""What turns from the door by so much more [rad] than another chord leads from its jamb to elsewhere."""

WIDTHS = (0.5, 2.2)
"""And if it is so many times as wide: one leaf of two spans half of the opening."""


def at_doors(tessellation: Tessellation, doors: Sequence[Polyline]) -> NDArray[np.bool_]:
    """Tell which chords are openings of doors that are drawn with a leaf or its swing, (n,).

    Such a chord runs along the door, is about as wide, and no farther from it than a wall is thick.
    """
    found = np.zeros(len(tessellation.chords), dtype=bool)
    if not doors or not len(found):
        return found
    ends = np.array([door.vertices[[0, -1]] for door in doors])
    widths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    middles = shapely.points(tessellation.chords.mean(axis=1))
    door, chord = shapely.STRtree(middles).query(
        shapely.linestrings(ends), predicate="dwithin", distance=OFF * np.minimum(widths, np.median(widths))
    )
    along = np.einsum(
        "ki,ki->k", *(np.diff(lines, axis=1)[:, 0] for lines in (ends[door], tessellation.chords[chord]))
    )
    share = tessellation.widths[chord] / widths[door]
    turns = np.arccos(np.minimum(np.abs(along) / (widths[door] * tessellation.widths[chord]), 1.0))
    is_like = (turns <= math.acos(ALONG)) & (share >= WIDTHS[0]) & (share <= WIDTHS[1])
    least = np.full(len(doors), np.inf)
    np.minimum.at(least, door[is_like], turns[is_like])
    found[chord[is_like & (turns <= least[door] + SLANT)]] = True
    return found
