"""Find rows of lines alike that touch nothing else: steps of stairs, or shelves, and no walls."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.interpretation.bars import NEAR
from pilotage.interpretation.paint import Seen
from pilotage.interpretation.steps import rows_of_steps


def find_rows(seen: Sequence[Seen], diagonal: float) -> set[int]:
    """Find the marks of rows, by number: each is one straight line that touches no other mark."""
    outlines = outlines_of(seen)
    straight = np.flatnonzero(
        [mark.area.is_empty and shapely.get_num_coordinates(mark.line) == 2 for mark in seen]
    )
    tree = shapely.STRtree(outlines)
    touched, _ = tree.query(outlines[straight], predicate="dwithin", distance=NEAR * diagonal)
    free = straight[np.bincount(touched, minlength=len(straight)) == 1]
    lines = shapely.get_coordinates(outlines[free]).reshape(-1, 2, 2)
    return {seen[place].number for row in rows_of_steps(lines) for place in free[row].tolist()}


def outlines_of(seen: Sequence[Seen]) -> NDArray[np.object_]:
    """Return the lines of marks, and of areas without one their boundary, (n,)."""
    return np.array(
        [shapely.boundary(mark.area) if mark.line.is_empty else mark.line for mark in seen], dtype=object
    )
