"""Doors that open and close by schedule."""

import math
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, frozen_array


@dataclass(frozen=True, eq=False)
class Door:
    """A leaf that stands in its frame while it is closed and is nowhere while it is open."""

    segment: Array  # (4,) x1, y1, x2, y2 [m]
    closed: tuple[tuple[float, float], ...] = ()  # from when until when [s], as often as it closes

    def __post_init__(self) -> None:
        """Copy and freeze the segment; refuse what is no door and times that run backwards."""
        segment = frozen_array(self.segment)
        if segment.shape != (4,) or not np.isfinite(segment).all():
            raise ValueError(f"a door's segment must be four finite numbers, got {segment}")
        object.__setattr__(self, "segment", segment)
        for since, until in self.closed:
            if not since < until:
                raise ValueError(f"a door must close before it opens again, got {since} to {until} s")

    @property
    def never_opens(self) -> bool:
        """Whether it is closed from the beginning to the end of time."""
        return any(since <= 0.0 and until == math.inf for since, until in self.closed)

    def should_be_closed(self, stamp: float) -> bool:
        """Tell whether its schedule wants it closed at this time [s]."""
        return any(since <= stamp < until for since, until in self.closed)
