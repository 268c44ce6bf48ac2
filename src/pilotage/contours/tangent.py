"""Tangent functions: direction as a function of the way along a contour (Wolter 2001, section 3)."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from pilotage.geometry import Array, Polyline, frozen_array, wrap_angle
from pilotage.kernels.steps import Steps


def directions(polyline: Polyline) -> Array:
    """Compute the direction of each segment, in [-pi, pi], (n - 1 + closed,) [rad].

    A segment without length has the direction of the one before it, or after it at the start.
    """
    steps = np.diff(polyline.ring, axis=0)
    has_length = polyline.segment_lengths > 0.0
    latest = np.maximum.accumulate(np.where(has_length, np.arange(len(steps)), 0))
    latest = np.where(has_length[latest], latest, np.argmax(has_length))
    return np.asarray(np.arctan2(steps[latest, 1], steps[latest, 0]))


def turns(polyline: Polyline) -> Array:
    """Compute the turn at each vertex, positive to the left, in (-pi, pi], (n,) [rad]; 0 at open ends."""
    along = directions(polyline)
    ends = (along[-1:], along[:0]) if polyline.closed else (along[:1], along[-1:])
    change = np.diff(np.concatenate([ends[0], along, ends[1]]))
    return wrap_angle(change)


@dataclass(frozen=True, eq=False)
class TangentFunction:
    """Direction at each relative position along a contour: constant on each segment.

    Directions are unwrapped: two of them differ by the turns made between, however often they went around.
    """

    stops: Array  # (n + 1,) from 0 to 1, increasing
    directions: Array  # (n,) [rad]
    length: float  # of the whole contour

    def __post_init__(self) -> None:
        """Copy and freeze the arrays, and reject what is no function."""
        object.__setattr__(self, "stops", frozen_array(self.stops))
        object.__setattr__(self, "directions", frozen_array(self.directions))
        if self.directions.ndim != 1 or self.stops.shape != (len(self.directions) + 1,):
            raise ValueError(f"stops must be one more than directions, got {self.stops.shape} stops")
        if not (np.diff(self.stops) > 0.0).all():
            raise ValueError(f"stops must increase, got {self.stops}")

    @classmethod
    def of(cls, polyline: Polyline) -> Self:
        """Follow a polyline from its first vertex on.

        >>> TangentFunction.of(Polyline.through([(0, 0), (3, 0), (3, 1)])).stops.tolist()
        [0.0, 0.75, 1.0]
        """
        if not polyline.length > 0.0:
            raise ValueError(f"polyline must have a length, got {polyline.vertices[0]} only")
        along = directions(polyline)
        unwrapped = along[0] + np.concatenate([[0.0], np.cumsum(turns(polyline)[1 : len(along)])])
        stops = np.concatenate([[0.0], np.cumsum(polyline.segment_lengths)])
        stops /= stops[-1]
        advances = np.diff(stops) > 0.0
        return cls(np.concatenate([[0.0], stops[1:][advances]]), unwrapped[advances], polyline.length)

    def steps(self, length: float) -> Steps:
        """Lay out for the kernels, as if the contour had this length."""
        return Steps(length * self.stops, self.directions)
