"""All straight lines that are seen on a drawing, and where they lie."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from pilotage.geometry import Array
from pilotage.interpretation.paint import Seen, parts_of


@dataclass(frozen=True, eq=False)
class Segments:
    """All straight lines that are seen, also those around areas."""

    ends: Array  # (n, 2, 2)

    @cached_property
    def tree(self) -> shapely.STRtree:
        """Find segments by place."""
        return shapely.STRtree(shapely.linestrings(self.ends))

    @cached_property
    def lengths(self) -> Array:
        """[drawing units], (n,)."""
        return np.asarray(np.hypot(*(self.ends[:, 1] - self.ends[:, 0]).T))


def segments_of(seen: Sequence[Seen]) -> Segments:
    """Take all lines and borders of areas apart."""
    ends = [np.empty((0, 2, 2))]
    for mark in seen:
        border = mark.line if mark.area.is_empty else shapely.union(mark.line, shapely.boundary(mark.area))
        for part in parts_of(border):
            points = shapely.get_coordinates(part)
            if len(points) > 1:
                ends.append(np.stack([points[:-1], points[1:]], axis=1))
    return Segments(np.concatenate(ends))
