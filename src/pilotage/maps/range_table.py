"""What could be seen from everywhere on the drawing: ranges in all directions, on a grid."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array
from pilotage.maps.schematic import SchematicMap


@dataclass(frozen=True, slots=True)
class RangeTableSettings:
    """How finely the drawing is looked at."""

    cells: int = 250  # along the drawing's longer side: 20 cm in a building of 50 m
    directions: int = 180  # every 2 degrees
    enclosed: float = 0.8  # share of directions that must meet a stroke for a place to be inside
    clearance: float = 0.3  # [cells] a robot is not nearer than this to a stroke

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("cells", "directions"):
            if not getattr(self, name) >= 1:
                raise ValueError(f"{name} must be >= 1, got {getattr(self, name)}")
        if not 0.0 <= self.enclosed <= 1.0:
            raise ValueError(f"enclosed must be in [0, 1], got {self.enclosed}")
        if not self.clearance >= 0.0:
            raise ValueError(f"clearance must be >= 0 cells, got {self.clearance}")


@dataclass(frozen=True, eq=False)
class RangeTable:
    """Ranges from the middle of each grid cell; cell (column, row) is line column * rows + row.

    Direction k points at 2 pi k / directions from the x axis of the sketch.
    """

    corner: tuple[float, float]  # left and bottom [drawing units]
    cell_size: float  # [drawing units]
    columns: int
    rows: int
    log_ranges: NDArray[np.uint8]  # (columns * rows, directions), levels as in kernels/visibility.py
    places: Array  # (k, 2) middles of the cells where a robot can be [drawing units]
    clearances: Array  # (k,) from there to the nearest stroke [drawing units]

    @property
    def grid(self) -> tuple[float, float, float, int, int]:
        """Left, bottom, cell size, columns and rows, as the kernels take them."""
        return (*self.corner, self.cell_size, self.columns, self.rows)

    @cached_property
    def middles(self) -> Array:
        """The middle of each grid cell, (columns * rows, 2) [drawing units]."""
        return middles_of(self.corner, self.cell_size, self.columns, self.rows)

    def lines_at(self, points: Array) -> NDArray[np.int64]:
        """Find the line of the table for each point (n, 2), (n,); off the grid that of its rim."""
        places = np.floor((points - self.corner) / self.cell_size).astype(np.int64)
        columns, rows = np.clip(places, 0, (self.columns - 1, self.rows - 1)).T
        return np.asarray(columns * self.rows + rows)

    def sees(self, lines: NDArray[np.int64], point: Array) -> NDArray[np.bool_]:
        """Tell from which lines (n,) a point (2,) [drawing units] is in sight, (n,).

        Tolerates one cell and one direction step, so that places close to a wall still see along it.
        """
        offsets = point - self.middles[lines]
        count = self.log_ranges.shape[1]
        turned = np.floor(np.arctan2(offsets[:, 1], offsets[:, 0]) * count / (2.0 * np.pi)).astype(np.int64)
        beside = (self.log_ranges[lines, (turned + side) % count] for side in (0, 1))
        levels = np.maximum(*beside) - float(kernels.visibility.LOG_ZERO)
        ranges = np.exp(levels * kernels.visibility.LOG_STEP) * self.cell_size
        return np.asarray(np.hypot(*offsets.T) <= ranges + self.cell_size)

    @cached_property
    def stretch_tables(self) -> tuple[NDArray[np.int16], NDArray[np.int16]]:
        """Where each stretch turns each direction, and by what it lengthens it."""
        return kernels.visibility.stretch_tables(self.log_ranges.shape[1])


def build_range_table(sketch: SchematicMap, settings: RangeTableSettings) -> RangeTable:
    """Look around from every cell of a grid over the drawing.

    Where no stroke is in sight the range is that of the whole drawing and half as much again. If no place
    is enclosed by strokes, a robot can be anywhere on the sheet.
    """
    left, bottom, right, top = sketch.bounds
    cell = max(right - left, top - bottom) / settings.cells
    columns, rows = (int(np.ceil(extent / cell)) + 1 for extent in (right - left, top - bottom))
    middles = middles_of((left, bottom), cell, columns, rows)
    farthest = 1.5 * sketch.diagonal
    ranges = kernels.sweep.sweep(middles, sketch.segments, settings.directions, farthest)
    logs = np.log(np.maximum(ranges / cell, np.finfo(np.float32).tiny))
    levels = logs / kernels.visibility.LOG_STEP + kernels.visibility.LOG_ZERO
    clearances = ranges.min(axis=1).astype(np.float64)
    met = (ranges < np.float32(farthest)).mean(axis=1)
    free = (clearances > settings.clearance * cell) & (met > settings.enclosed)
    if not free.any():
        free[:] = True
    return RangeTable(
        (left, bottom),
        cell,
        columns,
        rows,
        np.clip(np.round(levels), 0, 255).astype(np.uint8),
        middles[free],
        clearances[free],
    )


def middles_of(corner: tuple[float, float], cell: float, columns: int, rows: int) -> Array:
    """List the middles of the cells of a grid, column by column, (columns * rows, 2)."""
    xs, ys = (
        start + (np.arange(count) + 0.5) * cell for start, count in zip(corner, (columns, rows), strict=True)
    )
    return np.asarray(np.stack(np.meshgrid(xs, ys, indexing="ij"), axis=-1).reshape(-1, 2))
