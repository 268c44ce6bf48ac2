"""Rules for driving that a person draws: where not to drive, where to drive slowly, which way to pass."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array, Polyline
from pilotage.maps.cells.graph import Gateway


@dataclass(frozen=True)
class Zones:
    """Areas as rings, and arrows from their first to their last vertex, y up [drawing units].

    They say nothing of walls: the robot localizes as if they were not there.
    """

    keep_out: tuple[Polyline, ...] = ()  # the robot never drives in
    slow: tuple[Polyline, ...] = ()  # at half speed
    one_way: tuple[Polyline, ...] = ()  # an arrow across a gateway: the only way to pass it

    @property
    def lines(self) -> tuple[tuple[Polyline, ...], ...]:
        """The three kinds, in the order of the fields."""
        return self.keep_out, self.slow, self.one_way

    def __bool__(self) -> bool:
        """Whether there are any."""
        return any(self.lines)

    @cached_property
    def keep_out_area(self) -> shapely.Geometry:
        """Where the robot never drives in."""
        return area_of(self.keep_out)

    @cached_property
    def slow_area(self) -> shapely.Geometry:
        """Where the robot drives slowly."""
        return area_of(self.slow)

    def are_kept_out(self, points: Array) -> NDArray[np.bool_]:
        """Tell which points (n, 2) the robot must not drive to, (n,)."""
        return np.asarray(shapely.contains_xy(self.keep_out_area, *points.T))

    def is_slow(self, point: Array) -> bool:
        """Tell whether to drive slowly at a point (2,)."""
        return bool(shapely.contains_xy(self.slow_area, *point))

    def entered_through(self, gateway: Gateway) -> str:
        """Name the cell that a one-way gateway leads to; empty if it may be passed both ways.

        Where arrows contradict each other, the last one holds.
        """
        entered = ""
        along = gateway.segment[1] - gateway.segment[0]
        left = np.array([-along[1], along[0]])  # where the first cell lies
        opening = shapely.linestrings(gateway.segment)
        for arrow in self.one_way:
            if shapely.intersects(opening, shapely.linestrings(arrow.vertices)):
                first, last = arrow.vertices[[0, -1]]
                entered = gateway.cell_ids[0 if (last - first) @ left > 0.0 else 1]
        return entered


def area_of(rings: tuple[Polyline, ...]) -> shapely.Geometry:
    """Join what rings enclose."""
    area = shapely.union_all([shapely.make_valid(shapely.polygons(ring.vertices)) for ring in rings])
    shapely.prepare(area)
    return area
