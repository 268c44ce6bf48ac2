"""Where free space narrows: chords from wall to wall at which clearance has a minimum or begins to grow."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps.voronoi import VoronoiDiagram, feet

SLACK = 1e-3
"""By what share of its width a chord may miss its Voronoi edge, or the end of a wall: ties on the grid."""


@dataclass(frozen=True, eq=False)
class Chords:
    """Segments across free space from wall to wall; no two cross, the disc over each is free of walls."""

    segments: Array  # (n, 2, 2)
    widths: Array  # (n,)


def find_chords(diagram: VoronoiDiagram) -> Chords:
    """Find a chord for every Voronoi edge on which its two sites come nearest to each other.

    Between two ends of walls that is the straight line, between an end and a wall the perpendicular; between
    two walls clearance has no minimum inside an edge. The mouth of a corridor is such an edge, too: there
    clearance begins to grow.
    """
    left, right = diagram.sites[:, 0], diagram.sites[:, 1]
    left_is_end = (left[:, :2] == left[:, 2:]).all(axis=1)
    right_is_end = (right[:, :2] == right[:, 2:]).all(axis=1)
    ends = np.where(left_is_end[:, None], left[:, :2], right[:, :2])
    across = np.where(left_is_end[:, None], right, left)
    segments = np.stack([ends, feet(ends, across)], axis=1)
    kept = (left_is_end | right_is_end) & are_minimal(segments, diagram)
    return without_twins(welded(segments[kept], across[kept]))


def widths_of(segments: Array) -> Array:
    """Measure chords (n, 2, 2) from wall to wall."""
    across = segments[:, 1] - segments[:, 0]
    return np.asarray(np.hypot(across[:, 0], across[:, 1]))


def are_minimal(segments: Array, diagram: VoronoiDiagram) -> NDArray[np.bool_]:
    """Tell which chords (k, 2, 2) have their middle on their Voronoi edge."""
    across = segments[:, 1] - segments[:, 0]
    widths = widths_of(segments)
    along = np.column_stack([-across[:, 1], across[:, 0]])
    middle = segments.mean(axis=1)
    reach = [np.einsum("ij,ij->i", diagram.vertices[k] - middle, along) for k in diagram.edges.T]
    slack = SLACK * widths**2
    return np.asarray((np.minimum(*reach) <= slack) & (np.maximum(*reach) >= -slack) & (widths > 0.0))


def welded(segments: Array, walls: Array) -> Array:
    """Let a chord that ends beside an end of its wall (n, 4) end there."""
    moved = segments.copy()
    slack = SLACK * widths_of(segments)
    for end in (walls[:, :2], walls[:, 2:]):
        gap = np.hypot(*(end - segments[:, 1]).T)
        moved[gap <= slack, 1] = end[gap <= slack]
    return moved


def without_twins(segments: Array) -> Chords:
    """Leave out chords that join the same two points as another."""
    swapped = (segments[:, 0, 0] > segments[:, 1, 0]) | (
        (segments[:, 0, 0] == segments[:, 1, 0]) & (segments[:, 0, 1] > segments[:, 1, 1])
    )
    ordered = np.where(swapped[:, None, None], segments[:, ::-1], segments)
    unique = np.unique(ordered.reshape(-1, 4), axis=0).reshape(-1, 2, 2)
    return Chords(unique, widths_of(unique))
