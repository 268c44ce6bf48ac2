"""Maps of the plane that keep straight lines straight, as between a sheet of paper and a photo of it."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from pilotage.geometry.arrays import Array
from pilotage.geometry.pose import Pose2


@dataclass(frozen=True)
class Homography:
    """A 3 x 3 matrix that acts on homogeneous points (x, y, 1).

    >>> halving = Homography(((1.0, 0.0, 5.0), (0.0, 1.0, 0.0), (0.0, 0.0, 2.0)))
    >>> halving.points(np.array([[1.0, 4.0]])).tolist()
    [[3.0, 2.0]]
    """

    rows: tuple[tuple[float, float, float], ...]

    @classmethod
    def from_matrix(cls, matrix: Array) -> Self:
        """Take a matrix (3, 3)."""
        return cls(tuple((float(a), float(b), float(c)) for a, b, c in matrix))

    @classmethod
    def between(cls, points: Array, images: Array) -> Self:
        """Find the one that carries four points (4, 2), no three of them on a line, to four others."""
        equations, values = [], []
        for (x, y), (u, v) in zip(points, images, strict=True):
            equations += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
            values += [u, v]
        return cls.from_matrix(np.append(np.linalg.solve(equations, values), 1.0).reshape(3, 3))

    @cached_property
    def matrix(self) -> Array:
        """The matrix (3, 3)."""
        return np.array(self.rows, dtype=np.float64)

    @cached_property
    def inverse(self) -> "Homography":
        """The map back."""
        return Homography.from_matrix(np.asarray(np.linalg.inv(self.matrix), dtype=np.float64))

    def points(self, points: Array) -> Array:
        """Carry points (n, 2)."""
        carried = points @ self.matrix[:, :2].T + self.matrix[:, 2]
        return np.asarray(carried[:, :2] / carried[:, 2:])

    def pose(self, pose: Pose2) -> Pose2:
        """Carry a place and the direction there."""
        x, y, w = self.matrix @ np.append(pose.position, 1.0)
        slope = (self.matrix[:2, :2] - np.outer((x / w, y / w), self.matrix[2, :2])) / w
        dx, dy = slope @ (math.cos(pose.theta), math.sin(pose.theta))
        return Pose2(x / w, y / w, math.atan2(dy, dx))
