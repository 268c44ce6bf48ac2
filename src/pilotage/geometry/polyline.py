"""Polylines: the one carrier of shape, seen or drawn."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from pilotage.geometry.arrays import Array, frozen_points
from pilotage.geometry.pose import Pose2
from pilotage.geometry.similarity import Similarity2
from pilotage.geometry.span import Span


@dataclass(frozen=True, eq=False)
class Polyline:
    """Vertices (n >= 2, 2) joined in order; closed ones join the last to the first without repeating it.

    Free space lies left of its direction.

    >>> Polyline.through([(0, 0), (3, 0), (3, 4)]).length
    7.0
    """

    vertices: Array
    closed: bool = False

    def __post_init__(self) -> None:
        """Copy and freeze the vertices."""
        object.__setattr__(self, "vertices", frozen_points(self.vertices, name="vertices", at_least=2))

    @classmethod
    def through(cls, points: ArrayLike, *, closed: bool = False) -> Self:
        """Join points given in any array-like form."""
        return cls(np.asarray(points, dtype=np.float64), closed)

    def __len__(self) -> int:
        """Count the vertices."""
        return len(self.vertices)

    def __eq__(self, other: object) -> bool:
        """Tell whether both have the same vertices in the same order."""
        if not isinstance(other, Polyline):
            return NotImplemented
        return self.closed == other.closed and np.array_equal(self.vertices, other.vertices)

    __hash__ = None  # type: ignore[assignment]  # arrays have no hash, and no one needs one

    @cached_property
    def ring(self) -> Array:
        """The vertices, the first repeated at the end if closed: (n + closed, 2)."""
        return np.vstack([self.vertices, self.vertices[:1]]) if self.closed else self.vertices

    @cached_property
    def segment_lengths(self) -> Array:
        """Length of each segment, (n - 1 + closed,)."""
        steps = np.diff(self.ring, axis=0)
        return np.hypot(steps[:, 0], steps[:, 1])

    @property
    def length(self) -> float:
        """Length along the line."""
        return float(self.segment_lengths.sum())

    def reversed(self) -> "Polyline":
        """Run the other way: free space changes sides."""
        return Polyline(self.vertices[::-1], self.closed)

    def subset(self, keep: Iterable[int]) -> "Polyline":
        """Keep the vertices with these indices, in their order."""
        return Polyline(self.vertices[np.fromiter(keep, dtype=np.intp)], self.closed)

    def moved(self, a_from_b: Pose2 | Similarity2) -> "Polyline":
        """Carry from frame b to frame a."""
        return Polyline(a_from_b @ self.vertices, self.closed)

    def cut(self, span: Span) -> "Polyline":
        """Take a stretch as an open polyline of its own.

        >>> Polyline.through([(0, 0), (4, 0), (4, 4)]).cut(Span(0, 2, trim_first=0.25)).vertices.tolist()
        [[1.0, 0.0], [4.0, 0.0], [4.0, 4.0]]
        """
        points = self.vertices[np.arange(span.first, span.last + 1) % len(self)].copy()
        first = points[0] + span.trim_first * (points[1] - points[0])
        last = points[-1] + span.trim_last * (points[-2] - points[-1])
        points[0], points[-1] = first, last
        return Polyline(points)


def segments_of(polylines: Sequence[Polyline]) -> Array:
    """List all segments of all polylines, (m, 4) as x1, y1, x2, y2.

    >>> segments_of([Polyline.through([(0, 0), (1, 0)]), Polyline.through([(2, 0), (3, 0)])]).tolist()
    [[0.0, 0.0, 1.0, 0.0], [2.0, 0.0, 3.0, 0.0]]
    """
    if not polylines:
        return np.empty((0, 4))
    rings = [polyline.ring for polyline in polylines]
    vertices = np.concatenate(rings)
    segments = np.hstack([vertices[:-1], vertices[1:]])
    between_polylines = np.cumsum([len(ring) for ring in rings[:-1]], dtype=np.intp) - 1
    return np.delete(segments, between_polylines, axis=0)
