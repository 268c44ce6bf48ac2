"""Find rows of lines alike that touch nothing else: steps of stairs, or shelves, and no walls."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.interpretation.paint import Seen
from pilotage.interpretation.steps import rows_of_steps


def find_rows(seen: Sequence[Seen], touching: NDArray[np.intp]) -> set[int]:
    """Find the marks of rows, by number: each is one straight line that touches no other mark.

    `touching` (2, n) are the places of marks that touch, each with itself as well.
    """
    times = np.bincount(touching[0], minlength=len(seen))
    free = [
        place
        for place in np.flatnonzero(times == 1).tolist()
        if seen[place].area.is_empty and shapely.get_num_coordinates(seen[place].line) == 2
    ]
    lines = shapely.get_coordinates([seen[place].line for place in free]).reshape(-1, 2, 2)
    return {seen[free[member]].number for row in rows_of_steps(lines) for member in row.tolist()}
