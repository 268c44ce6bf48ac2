"""Divide a scan into partial shapes where the line of sight passes an edge (Wolter 2001, section 2.1).

The paper removes lines nearly collinear with the line of sight if they are longer than a threshold. Walls
seen at a grazing angle from far away have such lines too; they are kept where they prolong their neighbors
(decision 0005).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.perception.scan import LaserScan
from pilotage.shape.partial import EndCause


@dataclass(frozen=True, slots=True)
class SegmentationSettings:
    """Which lines between neighboring returns are shadow edges and no walls."""

    max_shadow: float = (
        0.10  # [m] the paper's example; a shorter line along the line of sight blocks no sight
    )
    max_grazing: float = math.radians(
        20.0
    )  # [rad] "nearly collinear": at 20 m, beams 1 degree apart are 1 m deep
    tolerance: float = 0.03  # [m] three standard deviations of a range: how exactly a wall runs on
    max_stretch: float = (
        2.0  # [ratio] of a line and the neighbors it prolongs; 1.7 is the last step a wall can make
    )

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("max_shadow", "tolerance", "max_stretch"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")
        if not 0.0 <= self.max_grazing <= math.pi / 2:
            raise ValueError(f"max_grazing must be in [0, pi/2] rad, got {self.max_grazing}")


@dataclass(frozen=True, slots=True)
class Run:
    """Beams whose returns form one contour, counter-clockwise as seen from the laser."""

    beams: NDArray[np.intp]  # (k >= 2,) indices into the scan
    closed: bool
    first_end: EndCause
    last_end: EndCause


def points_in_laser(scan: LaserScan) -> Array:
    """Return the point of every beam in the laser's frame, (n, 2) [m]; the laser where none returned."""
    ranges, directions = np.where(scan.returned, scan.ranges, 0.0), scan.directions
    return np.column_stack([ranges * np.cos(directions), ranges * np.sin(directions)])


def find_runs(scan: LaserScan, settings: SegmentationSettings) -> tuple[Run, ...]:
    """Join neighboring returns and break where there is none and at shadow edges.

    Each run goes counter-clockwise round the laser, so that free space is on its left. A return without a
    neighbor is in none.
    """
    from pilotage.kernels.segmentation import link_returns

    n = len(scan)
    order = np.arange(n) if scan.angle_increment >= 0.0 else np.arange(n)[::-1]
    wraps = n > 2 and abs(n * abs(scan.angle_increment) - math.tau) < abs(scan.angle_increment) / 2
    ranges = scan.ranges[order]
    linked = link_returns(
        points_in_laser(scan)[order],
        np.isfinite(ranges),
        wraps,
        settings.max_shadow,
        settings.max_grazing,
        settings.tolerance,
        settings.max_stretch,
    )
    if wraps and linked.all():
        return (Run(order, closed=True, first_end=EndCause.DRAWN, last_end=EndCause.DRAWN),)
    return tuple(
        Run(
            order[beams],
            closed=False,
            first_end=_end_cause(ranges, beams[0], -1, wraps=wraps),
            last_end=_end_cause(ranges, beams[-1], 1, wraps=wraps),
        )
        for beams in _linked_beams(linked)
    )


def _linked_beams(linked: NDArray[np.bool_]) -> Iterator[NDArray[np.intp]]:
    """Yield each run of at least two linked beams; one that passes the last beam goes on with the first."""
    n = len(linked)
    first_break = int(np.flatnonzero(~linked)[0])
    turned = np.roll(linked, -first_break - 1)  # now the last one is a break
    edges = np.flatnonzero(np.diff(np.concatenate([[False], turned, [False]]).astype(np.int8)))
    for start, stop in sorted(
        ((first_break + 1 + start) % n, (first_break + 1 + stop) % n)
        for start, stop in edges.reshape(-1, 2).tolist()
    ):
        yield np.arange(start, stop + 1 if start < stop else stop + 1 + n) % n


def _end_cause(ranges: Array, beam: int, step: int, *, wraps: bool) -> EndCause:
    """Tell why a contour ends at a beam, from what the next beam, in steps of -1 or 1, reports."""
    neighbor = beam + step
    if not (wraps or 0 <= neighbor < len(ranges)):
        return EndCause.FIELD_LIMIT
    beyond = ranges[neighbor % len(ranges)]
    if math.isnan(beyond) or beyond == math.inf:
        return EndCause.RANGE_LIMIT
    return EndCause.OCCLUDING if ranges[beam] < beyond else EndCause.OCCLUDED
