"""Rigid motions of the plane."""

import math
from dataclasses import dataclass
from typing import Self, overload

import numpy as np

from pilotage.geometry.angles import wrap_angle
from pilotage.geometry.arrays import Array


@dataclass(frozen=True, slots=True)
class Pose2:
    """Where frame b stands in frame a, and so the map of points from b to a.

    Named `a_from_b`; equal words touch: `a_from_c = a_from_b @ b_from_c`, and `@` moves points as well.

    >>> room_from_robot = Pose2(2.0, 1.0, math.pi / 2)
    >>> (room_from_robot @ np.array([[1.0, 0.0]])).round(6).tolist()
    [[2.0, 2.0]]
    """

    x: float  # [m, or the unit of frame a]
    y: float  # [the same]
    theta: float  # [rad], wrapped to (-pi, pi]

    def __post_init__(self) -> None:
        """Reject values that are not finite, and wrap the angle."""
        if not (math.isfinite(self.x) and math.isfinite(self.y) and math.isfinite(self.theta)):
            raise ValueError(f"a pose must be finite, got ({self.x}, {self.y}, {self.theta})")
        object.__setattr__(self, "x", float(self.x))
        object.__setattr__(self, "y", float(self.y))
        object.__setattr__(self, "theta", wrap_angle(float(self.theta)))

    @classmethod
    def identity(cls) -> Self:
        """Return the motion that moves nothing."""
        return cls(0.0, 0.0, 0.0)

    @property
    def position(self) -> Array:
        """The origin of frame b in frame a, (2,)."""
        return np.array([self.x, self.y])

    @property
    def rotation(self) -> Array:
        """The rotation matrix, (2, 2)."""
        c, s = math.cos(self.theta), math.sin(self.theta)
        return np.array([[c, -s], [s, c]])

    def inverse(self) -> "Pose2":
        """Return `b_from_a`.

        >>> Pose2(3.0, -1.0, math.pi).inverse().position.round(6).tolist()
        [3.0, -1.0]
        """
        c, s = math.cos(self.theta), math.sin(self.theta)
        return Pose2(-c * self.x - s * self.y, s * self.x - c * self.y, -self.theta)

    @overload
    def __matmul__(self, other: "Pose2") -> "Pose2": ...
    @overload
    def __matmul__(self, other: Array) -> Array: ...
    def __matmul__(self, other: "Pose2 | Array") -> "Pose2 | Array":
        """Compose with a pose, or move points (n, 2)."""
        if isinstance(other, Pose2):
            c, s = math.cos(self.theta), math.sin(self.theta)
            return Pose2(
                self.x + c * other.x - s * other.y,
                self.y + s * other.x + c * other.y,
                self.theta + other.theta,
            )
        return other @ self.rotation.T + self.position
