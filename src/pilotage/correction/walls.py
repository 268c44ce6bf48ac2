"""Drawn walls in short pieces, and which of them each surface point shows."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from pilotage import kernels
from pilotage.correction.spline import ElasticMap
from pilotage.geometry import Array, Polyline

PIECE = 0.5
"""[m] Length of a piece at most."""
MISFIT = 0.35
"""Largest |log(predicted / measured)| of a range that shows the predicted wall."""
PARALLEL = 0.75
"""Least cosine between the normals of a surface and of the wall that it is taken for."""
TOUCH = 0.15
"""[m] A line that ends no farther from another touches it."""
CANDIDATES = 6
"""Pieces with the nearest middles, of which that of a point is the nearest."""


@dataclass(frozen=True, eq=False)
class Pieces:
    """Short pieces of drawn walls: where they begin and end."""

    starts: Array  # (n, 2) roughly metres
    ends: Array  # (n, 2)

    @classmethod
    def of(cls, segments: Array) -> Self:
        """Cut segments (m, 4) [roughly metres] into pieces."""
        lengths = np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1])
        counts = np.maximum(np.ceil(lengths / PIECE), 1).astype(np.intp)
        owners = np.repeat(np.arange(len(segments)), counts)
        number = np.arange(len(owners)) - np.repeat(np.cumsum(counts) - counts, counts)
        first, along = segments[owners, :2], segments[owners, 2:] - segments[owners, :2]
        step = along / counts[owners, np.newaxis]
        return cls(first + number[:, np.newaxis] * step, first + (number + 1)[:, np.newaxis] * step)

    def __len__(self) -> int:
        """Count the pieces."""
        return len(self.starts)


@dataclass(frozen=True, eq=False)
class Carried:
    """Pieces as a map carries them to metres."""

    starts: Array  # (n, 2) [m]
    ends: Array  # (n, 2) [m]

    @classmethod
    def by(cls, elastic: ElasticMap, pieces: Pieces) -> Self:
        """Carry pieces."""
        return cls(elastic.from_roughly(pieces.starts), elastic.from_roughly(pieces.ends))

    @cached_property
    def tree(self) -> cKDTree:
        """The middles, indexed."""
        return cKDTree((self.starts + self.ends) / 2.0)

    @cached_property
    def normals(self) -> Array:
        """Unit normals, (n, 2)."""
        along = self.ends - self.starts
        across = np.column_stack([-along[:, 1], along[:, 0]])
        return np.asarray(across / np.maximum(np.hypot(*along.T), 1e-9)[:, np.newaxis])

    def nearest(self, points: Array) -> tuple[NDArray[np.intp], Array]:
        """Find the piece nearest to each point (m, 2), (m,), and where along it that is, 0 to 1, (m,)."""
        count = min(CANDIDATES, len(self.starts))
        candidates = np.asarray(self.tree.query(points, k=count)[1]).reshape(len(points), count)
        starts = self.starts[candidates]
        along = self.ends[candidates] - starts
        squared = np.maximum((along**2).sum(axis=-1), 1e-12)
        shares = np.clip(((points[:, np.newaxis] - starts) * along).sum(axis=-1) / squared, 0.0, 1.0)
        off = starts + shares[..., np.newaxis] * along - points[:, np.newaxis]
        best = (off**2).sum(axis=-1).argmin(axis=1)
        row = np.arange(len(points))
        return candidates[row, best], shares[row, best]

    def predict(self, lasers: Array, points: Array) -> Array:
        """Predict how far beams from lasers (m, 2) towards points (m, 2) go to the first wall, (m,) [m]."""
        towards = points - lasers
        grid = kernels.segment_grid.build_grid(np.hstack([self.starts, self.ends]))
        angles = np.arctan2(towards[:, 1], towards[:, 0])
        return np.asarray(kernels.raycast.cast_through(np.ascontiguousarray(lasers), angles, grid))


def find_posts(lines: Sequence[Polyline]) -> Array:
    """Find the ends of lines [roughly metres] that touch no other line: posts of doors, (n, 2)."""
    tree = shapely.STRtree([shapely.LineString(line.ring) for line in lines])
    ends = [
        (number, end)
        for number, line in enumerate(lines)
        if not line.closed
        for end in line.vertices[[0, -1]]
    ]
    posts = []
    for number, end in ends:
        near = tree.query(shapely.Point(end), predicate="dwithin", distance=TOUCH)
        if set(near.tolist()) <= {number}:
            posts.append(end)
    return np.array(posts).reshape(-1, 2)


@dataclass(frozen=True, eq=False)
class Association:
    """Which surface points show which place of which piece."""

    points: NDArray[np.intp]  # (k,) numbers of surface points
    pieces: NDArray[np.intp]  # (k,)
    shares: Array  # (k,) from the start of the piece, 0, to its end, 1

    def places(self, pieces: "Pieces | Carried") -> Array:
        """Return the places that are shown, (k, 2), in the units of the pieces."""
        starts, ends = pieces.starts[self.pieces], pieces.ends[self.pieces]
        return np.asarray(starts + self.shares[:, np.newaxis] * (ends - starts))


def associate(carried: Carried, lasers: Array, points: Array, normals: Array) -> Association:
    """Take each surface point (m, 2) [m] for the first wall along its beam, if range and direction agree.

    So a point never shows a wall that is hidden behind another.
    """
    predicted = carried.predict(lasers, points)
    towards = points - lasers
    ranges = np.maximum(np.hypot(*towards.T), 1e-6)
    likely = np.abs(np.log(np.clip(predicted, 1e-3, 1e6) / ranges)) < MISFIT
    chosen = np.flatnonzero(likely)
    if len(chosen) == 0:
        return Association(chosen, chosen, np.empty(0))
    hits = lasers[chosen] + towards[chosen] * (predicted[chosen] / ranges[chosen])[:, np.newaxis]
    pieces, shares = carried.nearest(hits)
    parallel = np.abs((carried.normals[pieces] * normals[chosen]).sum(axis=1)) > PARALLEL
    return Association(chosen[parallel], pieces[parallel], shares[parallel])
