"""Corners of polylines: what a sketch gets right when it gets lengths wrong."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Polyline, Pose2, wrap_angle

MIN_TURN = math.radians(35.0)
"""Flatter bends are tremor of the hand or of the laser."""


@dataclass(frozen=True, eq=False)
class Corners:
    """Vertices where two segments meet at an angle, in the direction of their polyline."""

    vertices: Array  # (n, 2)
    directions: Array  # (n,) [rad] halfway between those of the segments before and after
    turns: Array  # (n,) [rad] to the left positive; a corner that juts into free space has < 0
    lengths: Array  # (n,) of the shorter of the two segments

    def __len__(self) -> int:
        """Count the corners."""
        return len(self.vertices)

    def reversed(self) -> "Corners":
        """See the same corners from the other side of the line."""
        return Corners(self.vertices, self.directions + math.pi, -self.turns, self.lengths)

    def moved(self, a_from_b: Pose2) -> "Corners":
        """Carry from frame b to frame a."""
        return Corners(a_from_b @ self.vertices, self.directions + a_from_b.theta, self.turns, self.lengths)

    def joined(self, other: "Corners") -> "Corners":
        """Put two lists together."""
        return Corners(
            np.vstack([self.vertices, other.vertices]),
            np.concatenate([self.directions, other.directions]),
            np.concatenate([self.turns, other.turns]),
            np.concatenate([self.lengths, other.lengths]),
        )

    def chosen(self, indices: NDArray[np.intp]) -> "Corners":
        """Take some of them, or some several times."""
        return Corners(
            self.vertices[indices], self.directions[indices], self.turns[indices], self.lengths[indices]
        )


def find_corners(polylines: Iterable[Polyline]) -> Corners:
    """Find all vertices between two segments where a line turns by at least `MIN_TURN`.

    >>> corners = find_corners([Polyline.through([(0, 0), (2, 0), (2, 1)])])
    >>> corners.vertices.tolist(), corners.turns.round(3).tolist(), corners.lengths.tolist()
    ([[2.0, 0.0]], [1.571], [1.0])
    """
    runs = [_unrolled(polyline) for polyline in polylines]
    runs = [run for run in runs if len(run) >= 3]
    if not runs:
        return Corners(np.empty((0, 2)), np.empty(0), np.empty(0), np.empty(0))
    vertices = np.vstack(runs)
    steps = np.diff(vertices, axis=0)
    lengths, headings = np.hypot(steps[:, 0], steps[:, 1]), np.arctan2(steps[:, 1], steps[:, 0])
    turns = wrap_angle(np.diff(headings))
    inner = np.ones(len(turns), dtype=bool)  # vertices 1 .. n - 2 of the whole, but no ends of a run
    ends = np.cumsum([len(run) for run in runs])[:-1]
    inner[ends - 2] = inner[ends - 1] = False
    bent = np.flatnonzero(inner & (np.abs(turns) >= MIN_TURN))
    return Corners(
        vertices[bent + 1],
        headings[bent] + turns[bent] / 2.0,
        turns[bent],
        np.minimum(lengths[bent], lengths[bent + 1]),
    )


def _unrolled(polyline: Polyline) -> Array:
    """List the vertices so that each corner has one before and one after it."""
    if not polyline.closed:
        return polyline.vertices
    return np.vstack([polyline.vertices, polyline.vertices[:2]])
