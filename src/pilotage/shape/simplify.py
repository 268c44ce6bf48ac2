"""Simplify polylines by discrete curve evolution (Wolter 2001, section 2.2)."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from pilotage import kernels
from pilotage.geometry import Array, Polyline
from pilotage.kernels import evolution


@dataclass(frozen=True, slots=True)
class Simplification:
    """When to stop: once every inner vertex is at least this relevant, eq. (1).

    Relevance grows with scale. What is measured in metres has metric noise and takes a fixed threshold; for a
    drawing or an outline of unknown scale multiply a share by a length of its own, such as 0.0025 times the
    diagonal of the sheet or 0.006 times the perimeter.
    """

    min_relevance: float = 0.03  # [rad times unit of the polyline]; a right angle of 0.1 m sides has 0.079

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        if not self.min_relevance >= 0.0:
            raise ValueError(f"min_relevance must be >= 0, got {self.min_relevance}")


def simplify(polyline: Polyline, until: Simplification) -> Polyline:
    """Delete the least relevant vertex until all that remain are relevant enough (section 2.2).

    The result is a subset of the vertices, in their order. End points are kept, closed polylines keep three
    vertices, and no vertex is deleted if the line would then cross itself.

    >>> wall = Polyline.through([(0, 0), (1, 0.01), (2, 0), (2, 1)])
    >>> simplify(wall, Simplification(min_relevance=0.1)).vertices.tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]]
    """
    return simplify_all([polyline], until)[0]


def simplify_all(
    polylines: Sequence[Polyline], until: Simplification, *, compiled: bool = False
) -> tuple[Polyline, ...]:
    """Simplify polylines jointly: none comes to cross another, or to leave one that ends on it.

    Who does so again and again asks for the `compiled` kernel, which takes a second to load.

    >>> cable = Polyline.through([(0, 0), (1, 0.1), (2, 0)])
    >>> pin = Polyline.through([(1, -1), (1, 0.05)])
    >>> [len(line) for line in simplify_all([cable, pin], Simplification(min_relevance=1.0))]
    [3, 2]
    """
    if not polylines:
        return ()
    starts = np.cumsum([0, *(len(polyline) for polyline in polylines)])
    closed = np.array([polyline.closed for polyline in polylines])
    vertices = np.vstack([polyline.vertices for polyline in polylines])
    kernel = kernels.evolution_compiled if compiled else evolution
    keep = kernel.evolve_runs(vertices, starts, closed, until.min_relevance)
    return tuple(
        polyline.subset(np.flatnonzero(keep[first:last]))
        for polyline, (first, last) in zip(polylines, pairwise(starts), strict=True)
    )


def relevances(polyline: Polyline) -> Array:
    """Compute the relevance of each vertex, eq. (1), (n,) [rad times unit of the polyline]; infinite at ends.

    >>> relevances(Polyline.through([(0, 0), (2, 0), (2, 2)])).round(4).tolist()
    [inf, 1.5708, inf]
    """
    n = len(polyline)
    values = np.array([evolution.relevance(polyline.vertices, b - 1, b, (b + 1) % n) for b in range(n)])
    if not polyline.closed:
        values[[0, -1]] = np.inf
    return values
