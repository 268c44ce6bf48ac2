"""All straight lines that are seen on a drawing, and where they lie."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from pilotage.geometry import Array
from pilotage.interpretation.paint import Seen, shapes_of
from pilotage.interpretation.pieces import straight


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
    lines, areas = shapes_of(seen)
    borders = np.where(shapely.is_empty(areas), lines, shapely.boundary(areas))
    both = ~(shapely.is_empty(areas) | shapely.is_empty(lines))
    borders[both] = shapely.union(borders[both], lines[both])
    return Segments(straight(borders))
