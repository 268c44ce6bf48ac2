"""Arrays as values: copied to float64 and made read-only at the door."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def frozen_array(values: ArrayLike) -> Array:
    """Copy to float64 and forbid writing."""
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


def frozen_points(points: ArrayLike, *, name: str, at_least: int) -> Array:
    """Copy points (n, 2) and forbid writing; reject another shape, too few or points that are not finite."""
    array = frozen_array(points)
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"{name} must have shape (n, 2), got {array.shape}")
    if len(array) < at_least:
        raise ValueError(f"{name} must hold at least {at_least} points, got {len(array)}")
    if not np.isfinite(array).all():
        raise ValueError(f"{name} must be finite, got {array[~np.isfinite(array).all(axis=1)][0]}")
    return array


def numbered(lines: Sequence[Array]) -> tuple[Array, NDArray[np.intp]]:
    """Put the points of lines together, (n, 2), and number them by their line, (n,)."""
    return np.concatenate(lines), np.repeat(np.arange(len(lines)), list(map(len, lines)))
