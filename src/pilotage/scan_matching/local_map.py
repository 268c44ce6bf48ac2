"""The local map of what was seen on the last metres (Wolter 2001, section 3.3).

It holds shapes, not points. It is small, it forgets, and it never closes a loop: what comes into sight again
is entered again, where the robot now believes it to be.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array, segments_of
from pilotage.shape import PartialShape

if TYPE_CHECKING:
    from pilotage.kernels.segment_field import SegmentField

FIELD_CELL = 0.1
"""[m] Resolution at which the nearest segment is known: a third of the widest search kernel."""

FIELD_REACH = 0.6
"""[m] Distance from a segment up to which it is known as the nearest; the widest kernel scale is 0.5 m."""


@dataclass(frozen=True, eq=False)
class LocalMap:
    """Partial shapes in the `odom` frame, the oldest first."""

    shapes: tuple[PartialShape, ...] = ()
    entered_at: tuple[float, ...] = ()  # [m] traveled when each shape was entered

    @cached_property
    def segments(self) -> Array:
        """All segments of all shapes, (m, 4) [m]."""
        return segments_of([shape.polyline for shape in self.shapes])

    @cached_property
    def segment_field(self) -> "SegmentField":
        """The segments, ready for nearest-segment queries."""
        return kernels.segment_field.build_segment_field(self.segments, FIELD_CELL, FIELD_REACH)

    def extended(self, new: tuple[PartialShape, ...], traveled: float, window: float) -> "LocalMap":
        """Enter new shapes, and forget those entered more than `window` metres of travel ago (3.3, step 4).

        Known shapes stay as they were first seen: to replace them by newer ones, as the paper does, lets the
        map drift faster (decision 0006). What was forgotten is entered again if it is still in sight.
        """
        kept = [index for index, entered_at in enumerate(self.entered_at) if entered_at >= traveled - window]
        return LocalMap(
            (*(self.shapes[index] for index in kept), *new),
            (*(self.entered_at[index] for index in kept), *(traveled for _ in new)),
        )


def owners_of_segments(shapes: tuple[PartialShape, ...]) -> NDArray[np.intp]:
    """Return the index of the shape that each of the segments of some shapes belongs to, (m,)."""
    return np.repeat(np.arange(len(shapes)), [len(shape.polyline.ring) - 1 for shape in shapes])
