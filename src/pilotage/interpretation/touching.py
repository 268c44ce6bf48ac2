"""Find which marks touch each other."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.interpretation.bars import NEAR
from pilotage.interpretation.paint import Seen


def find_touching(seen: Sequence[Seen], diagonal: float) -> NDArray[np.intp]:
    """Pair the marks whose lines touch, by their places, (2, n): each pair both ways, and each with itself.

    Of areas without a line the boundary counts.
    """
    outlines = np.array(
        [shapely.boundary(mark.area) if mark.line.is_empty else mark.line for mark in seen], dtype=object
    )
    tree = shapely.STRtree(outlines)
    return np.asarray(tree.query(outlines, predicate="dwithin", distance=NEAR * diagonal))


def among(pairs: NDArray[np.intp], kept: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Return the pairs (2, n) of which both are kept."""
    return pairs[:, kept[pairs].all(axis=0)]
