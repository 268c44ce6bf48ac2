"""From a scan to partial shapes in the robot's frame (Wolter 2001, sections 2.1 and 2.2).

The scan is divided where the line of sight passes an edge (2.1), and each part is simplified slightly (2.2).
The paper removes lines that are nearly collinear with the line of sight if they are longer than a threshold.
Walls seen at a grazing angle from far away have such lines too; they are kept where they prolong their
neighbors (decision 0005).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array, Polyline
from pilotage.perception.scan import LaserScan
from pilotage.shape import EndCause, PartialShape

MAX_GRAZING = math.radians(20.0)
"""[rad] "Nearly collinear" with the line of sight: beams 1 degree apart are 1 m deep at 20 m."""


@dataclass(frozen=True, slots=True)
class PerceptionSettings:
    """How a scan becomes shapes."""

    max_shadow: float = 0.10  # [m] a longer line along the line of sight is a shadow edge and no wall
    range_tolerance: float = 0.03  # [m] three standard deviations of a range
    max_line_ratio: float = 2.0  # a longer line is kept up to this many times its neighbors; 0: never
    min_relevance: float = 0.03  # [rad m] keeps a right angle between sides of 4 cm

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("max_shadow", "range_tolerance", "max_line_ratio", "min_relevance"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")


def perceive(scan: LaserScan, settings: PerceptionSettings) -> tuple[PartialShape, ...]:
    """Return the partial shapes of a scan in the base frame, free space on their left.

    They come in the order of beams, counter-clockwise. A scan without returns shows none.
    """
    runs = find_runs(scan, settings)  # section 2.1
    if not runs:
        return ()
    points = scan.base_from_laser @ points_in_laser(scan)
    vertices = points[np.concatenate([run.beams for run in runs])]
    starts = np.cumsum([0, *(len(run.beams) for run in runs)])
    closed = np.array([run.closed for run in runs])
    keep = kernels.evolution_compiled.evolve_runs(  # section 2.2
        vertices, starts, closed, settings.min_relevance
    )
    return tuple(
        PartialShape(Polyline(vertices[start:end][keep[start:end]], run.closed), run.first_end, run.last_end)
        for run, start, end in zip(runs, starts[:-1].tolist(), starts[1:].tolist(), strict=True)
    )


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


def find_runs(scan: LaserScan, settings: PerceptionSettings) -> tuple[Run, ...]:
    """Join neighboring returns; break at shadow edges and where a beam did not return (section 2.1).

    Each run goes counter-clockwise around the laser, so that free space is on its left. A return without a
    neighbor is in no run.
    """
    n = len(scan)
    order = np.arange(n) if scan.angle_increment >= 0.0 else np.arange(n)[::-1]
    wraps = n > 2 and abs(n * abs(scan.angle_increment) - math.tau) < abs(scan.angle_increment) / 2
    ranges = scan.ranges[order]
    linked = kernels.segmentation.link_returns(  # section 2.1: shadow edges
        points_in_laser(scan)[order],
        np.isfinite(ranges),
        wraps,
        settings.max_shadow,
        MAX_GRAZING,
        settings.range_tolerance,
        settings.max_line_ratio,
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
