"""Rigid motions with a change of scale, and the one that fits pairs of points best."""

import cmath
import math
from dataclasses import dataclass
from typing import overload

import numpy as np

from pilotage.geometry.arrays import Array
from pilotage.geometry.pose import Pose2


@dataclass(frozen=True, slots=True)
class Similarity2:
    """Scale first, then move: `point_in_a = pose @ (scale * point_in_b)`.

    A `sketch_from_base` says where the robot stands on the drawing (`pose`, in drawing units) and how many
    drawing units a metre is there (`scale`).

    >>> sketch_from_base = Similarity2(10.0, Pose2(100.0, 50.0, 0.0))
    >>> import numpy as np
    >>> (sketch_from_base @ np.array([[2.0, 0.0]])).tolist()
    [[120.0, 50.0]]
    """

    scale: float  # units of frame a in a unit of frame b
    pose: Pose2  # in units of frame a

    def __post_init__(self) -> None:
        """Reject a scale that is not positive and finite."""
        if not (self.scale > 0.0 and math.isfinite(self.scale)):
            raise ValueError(f"scale must be positive and finite, got {self.scale}")
        object.__setattr__(self, "scale", float(self.scale))

    def inverse(self) -> "Similarity2":
        """Return `b_from_a`."""
        pose = self.pose.inverse()
        return Similarity2(1.0 / self.scale, Pose2(pose.x / self.scale, pose.y / self.scale, pose.theta))

    @overload
    def __matmul__(self, other: "Similarity2") -> "Similarity2": ...
    @overload
    def __matmul__(self, other: Pose2) -> "Similarity2": ...
    @overload
    def __matmul__(self, other: Array) -> Array: ...
    def __matmul__(self, other: "Similarity2 | Pose2 | Array") -> "Similarity2 | Array":
        """Compose with a similarity or a pose, or move points (n, 2)."""
        if isinstance(other, Pose2):
            other = Similarity2(1.0, other)
        if isinstance(other, Similarity2):
            moved = Pose2(self.scale * other.pose.x, self.scale * other.pose.y, other.pose.theta)
            return Similarity2(self.scale * other.scale, self.pose @ moved)
        return self.pose @ (self.scale * other)


def fit_similarity(
    points: Array, images: Array, weights: Array | None = None, *, rigid: bool = False
) -> Similarity2:
    """Fit `image_from_point` to pairs (n, 2) by weighted least squares (Umeyama 1991).

    `weights` are (n,); a `rigid` one has scale 1. Raises ValueError if all points or all images coincide.

    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> found = fit_similarity(square, 2.0 * square + 5.0)
    >>> round(found.scale, 9), round(found.pose.x, 9), round(found.pose.theta, 9)
    (2.0, 5.0, 0.0)
    """
    shares = np.full(len(points), 1.0 / max(len(points), 1)) if weights is None else weights / weights.sum()
    a, b = points @ np.array([1.0, 1.0j]), images @ np.array([1.0, 1.0j])  # as complex numbers
    middle_a, middle_b = complex(shares @ a), complex(shares @ b)
    covariance = complex(shares @ ((a - middle_a).conj() * (b - middle_b)))
    variance = float(shares @ np.abs(a - middle_a) ** 2)
    if not (variance > 0.0 and abs(covariance) > 0.0):
        raise ValueError("points must not coincide, nor their images")
    factor = covariance / (abs(covariance) if rigid else variance)
    shift = middle_b - factor * middle_a
    return Similarity2(abs(factor), Pose2(shift.real, shift.imag, cmath.phase(factor)))
