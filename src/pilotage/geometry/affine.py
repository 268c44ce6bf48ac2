"""Affine maps of the plane: a change of position, heading, scale and proportions."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Self, overload

import numpy as np

from pilotage.geometry.arrays import Array, frozen_array
from pilotage.geometry.pose import Pose2


@dataclass(frozen=True, eq=False)
class Affine2:
    """`point_in_a = linear @ point_in_b + translation`, named `a_from_b`."""

    linear: Array  # (2, 2)
    translation: Array  # (2,)

    def __post_init__(self) -> None:
        """Freeze the arrays."""
        object.__setattr__(self, "linear", frozen_array(np.asarray(self.linear, dtype=np.float64)))
        object.__setattr__(self, "translation", frozen_array(np.asarray(self.translation, dtype=np.float64)))

    @classmethod
    def from_state(  # noqa: PLR0917  # the order of a particle's state
        cls, x: float, y: float, heading: float, log_scale: float, p: float, q: float
    ) -> Self:
        """Rotate, stretch by the exponential of [[p, q], [q, -p]], scale, move."""
        size = math.hypot(p, q)
        share = math.sinh(size) / size if size > 0.0 else 1.0
        stretch = math.cosh(size) * np.eye(2) + share * np.array([[p, q], [q, -p]])
        linear = math.exp(log_scale) * stretch @ Pose2(0.0, 0.0, heading).rotation
        return cls(linear, np.array([x, y]))

    def __eq__(self, other: object) -> bool:
        """Tell whether two maps are the same number by number."""
        if not isinstance(other, Affine2):
            return NotImplemented
        return np.array_equal(self.linear, other.linear) and np.array_equal(
            self.translation, other.translation
        )

    def __hash__(self) -> int:
        """Hash the numbers."""
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.linear.tobytes(), self.translation.tobytes()))

    @cached_property
    def scale(self) -> float:
        """Units of frame a in a unit of frame b, the mean of all directions."""
        return math.sqrt(abs(float(np.linalg.det(self.linear))))

    @property
    def pose(self) -> Pose2:
        """Where frame b stands in frame a, by polar decomposition."""
        (a, b), (c, d) = self.linear
        return Pose2(float(self.translation[0]), float(self.translation[1]), math.atan2(c - b, a + d))

    def inverse(self) -> "Affine2":
        """Return `b_from_a`."""
        linear: Array = np.linalg.inv(self.linear).astype(np.float64)
        return Affine2(linear, -linear @ self.translation)

    @overload
    def __matmul__(self, other: "Affine2") -> "Affine2": ...
    @overload
    def __matmul__(self, other: Pose2) -> "Affine2": ...
    @overload
    def __matmul__(self, other: Array) -> Array: ...
    def __matmul__(self, other: "Affine2 | Pose2 | Array") -> "Affine2 | Array":
        """Compose with an affine map or a pose, or move points (n, 2)."""
        if isinstance(other, Pose2):
            other = Affine2(other.rotation, other.position)
        if isinstance(other, Affine2):
            return Affine2(self.linear @ other.linear, self.linear @ other.translation + self.translation)
        return np.asarray(other @ self.linear.T + self.translation)
