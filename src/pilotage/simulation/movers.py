"""What is in the way at one moment beside the building itself."""

from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, frozen_array


@dataclass(frozen=True, eq=False)
class Movers:
    """Where people and closed doors are."""

    people: Array  # (k, 3) x, y, radius [m]
    closed_doors: Array  # (m, 4) x1, y1, x2, y2 [m]

    def __post_init__(self) -> None:
        """Copy and freeze the arrays; refuse other shapes."""
        for name, width in (("people", 3), ("closed_doors", 4)):
            rows = frozen_array(getattr(self, name))
            if rows.ndim != 2 or rows.shape[1] != width:
                raise ValueError(f"{name} must have shape (n, {width}), got {rows.shape}")
            object.__setattr__(self, name, rows)


NOBODY = Movers(np.empty((0, 3)), np.empty((0, 4)))
"""An empty building with all doors open."""
