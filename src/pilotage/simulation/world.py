"""The true building: walls and things as a laser meets them."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from pilotage.geometry import Array, frozen_array
from pilotage.maps import SchematicMap


@dataclass(frozen=True, eq=False)
class World:
    """Opaque segments, rows x1, y1, x2, y2, (n, 4) [m], y up."""

    segments: Array

    def __post_init__(self) -> None:
        """Copy and freeze the segments; refuse another shape and what is not finite."""
        segments = frozen_array(self.segments)
        if segments.ndim != 2 or segments.shape[1] != 4:
            raise ValueError(f"segments must have shape (n, 4), got {segments.shape}")
        if not np.isfinite(segments).all():
            raise ValueError("segments must be finite, got some that are not")
        object.__setattr__(self, "segments", segments)

    @classmethod
    def of(cls, plan: SchematicMap) -> Self:
        """Take every stroke of a plan drawn to scale, its unit the metre, for a wall."""
        return cls(plan.segments)

    def ranges(self, origins: Array, directions: Array) -> Array:
        """Measure from origins (n, 2) [m] along directions (n,) [rad] to a wall, (n,) [m]; inf if none."""
        from pilotage.kernels.raycast import cast

        return np.asarray(
            cast(
                np.ascontiguousarray(origins, dtype=np.float64),
                np.ascontiguousarray(directions, dtype=np.float64),
                self.segments,
            )
        )

    def clearance(self, points: Array) -> Array:
        """Measure from each point (n, 2) [m] to the nearest wall, (n,) [m]."""
        start, along = self.segments[:, :2], self.segments[:, 2:] - self.segments[:, :2]
        squared = np.maximum(np.sum(along**2, axis=1), np.finfo(np.float64).tiny)
        offset = points[:, np.newaxis, :] - start
        share = np.clip(np.sum(offset * along, axis=2) / squared, 0.0, 1.0)
        gap = offset - share[:, :, np.newaxis] * along
        return np.asarray(np.hypot(gap[..., 0], gap[..., 1]).min(axis=1))
