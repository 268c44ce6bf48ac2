"""Make lines and areas of ink: thin ink is lines along its middle, fat ink is areas."""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.interpretation.sheet import Color
from pilotage.io.picture.arcs import part_arcs, with_leaf
from pilotage.io.picture.join import join_straight
from pilotage.io.tracing import straightened, trace_runs

Mask = NDArray[np.bool_]

FAT = 2.2
"""Ink wider than so many widths of the pen is an area."""

LEAST_FAT = 0.004
"""And wider than this share of the picture's diagonal: lines of two pens are lines."""

RIM = 2
"""Ink is blurred over so many pixels."""

CORNER = 1.5
"""The corner of an area is so many times as far from where a disk fits as its sides are."""

DOORS = (0.01, 0.12)
"""Doors are this wide, as shares of the picture's diagonal."""

STAIR = 0.8
"""How far a contour may move to become straight [pixels]: the steps that pixels make of a slanted wall."""


DARK = 0.5
"""Ink with no color brighter than this share of paper is black, or a pen's blue: no floor."""


@dataclass(frozen=True, eq=False)
class Line:
    """The middle of a stroke."""

    points: Array  # (n, 2) [pixels], y down
    width: float  # of the ink [pixels]
    color: Color


@dataclass(frozen=True, eq=False)
class Area:
    """An area of ink."""

    rings: tuple[Array, ...]  # its outline and its holes, each (n, 2) [pixels], y down
    color: Color


def pen_width_of(ink: Mask, middle: Mask) -> float:
    """Measure the width of most strokes [pixels], given the ink and its middle lines."""
    from scipy.ndimage import distance_transform_edt

    if not middle.any():
        return 1.0
    return float(max(1.0, 2.0 * np.median(distance_transform_edt(ink)[middle]) - 0.5))


def trace(ink: Mask, flat: NDArray[np.float32], pen_width: float) -> tuple[list[Area], list[Line]]:
    """Trace ink on flattened paper (height, width, 3), each color of fat ink by itself."""
    from scipy.ndimage import distance_transform_edt

    width = max(FAT * pen_width, LEAST_FAT * float(np.hypot(*ink.shape)))
    dark = ink & (flat.max(axis=2) < DARK)
    fat_dark, fat_pale = fat_parts(dark, width), fat_parts(ink & ~dark, width)
    thin = ((ink & ~rimmed(fat_pale)) | dark) & ~rimmed(fat_dark)
    depth = distance_transform_edt(np.pad(thin, 1))[1:-1, 1:-1]
    lines = []
    for points in lines_of(thin, ink, pen_width):
        rows, columns = pixels_along(points, ink.shape)
        broad = float(max(1.0, 2.0 * np.median(depth[rows, columns]) - 0.5))
        lines.append(Line(points, broad, color_of(flat[rows, columns])))
    return [*areas_of(fat_pale, flat), *areas_of(fat_dark, flat)], lines


def lines_of(thin: Mask, ink: Mask, pen_width: float) -> list[Array]:
    """Trace thin ink: arcs of doors smooth, all other lines as long as they go on, (n, 2) each."""
    runs, mean_width = trace_runs(thin)
    radii = (DOORS[0] * float(np.hypot(*thin.shape)), DOORS[1] * float(np.hypot(*thin.shape)))
    parts = [part_arcs(run, pen_width, radii) for run in runs]
    others = straightened([run for rest, _ in parts for run in rest if len(run) > 1], mean_width)
    arcs = [arc for _, found in parts for arc in found]
    return [*join_straight(others, pen_width), *(line for arc in arcs for line in with_leaf(arc, ink).lines)]


def pixels_along(points: Array, shape: tuple[int, ...]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """List rows and columns of the pixels along a line (n, 2), a pixel apart."""
    steps = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    along = np.linspace(0.0, steps[-1], max(3, int(steps[-1])))
    columns, rows = (np.interp(along, steps, points[:, axis]).astype(np.int64) for axis in (0, 1))
    return np.minimum(rows, shape[0] - 1), np.minimum(columns, shape[1] - 1)


def color_of(pixels: NDArray[np.float32]) -> Color:
    """Return the middle color of pixels (n, 3)."""
    red, green, blue = np.median(pixels, axis=0).astype(float).round(2).tolist()
    return red, green, blue


def fat_parts(ink: Mask, width: float) -> Mask:
    """Mark ink that a disk of this width [pixels] fits into, (height, width)."""
    from scipy.ndimage import distance_transform_edt

    core = distance_transform_edt(np.pad(ink, 1))[1:-1, 1:-1] > width / 2.0
    if not core.any():
        return np.zeros_like(ink)
    return np.asarray(ink & (distance_transform_edt(~core) <= CORNER * width / 2.0 + 1.0))


def rimmed(fat: Mask) -> Mask:
    """Add the blurred rim of fat ink, which is no line beside it."""
    from scipy.ndimage import binary_dilation

    return np.asarray(binary_dilation(fat, np.ones((3, 3), dtype=bool), iterations=RIM))


def areas_of(fat: Mask, flat: NDArray[np.float32]) -> list[Area]:
    """Trace the outlines of areas and their holes."""
    from skimage.measure import find_contours, label, regionprops

    areas = []
    for island in regionprops(label(fat, connectivity=1)):
        top, left = island.bbox[:2]
        contours = find_contours(np.pad(island.image, 1).astype(np.float64), 0.5)
        rings = [np.column_stack([ring[:, 1] + left - 0.5, ring[:, 0] + top - 0.5]) for ring in contours]
        straight = [
            shapely.get_coordinates(ring)
            for ring in shapely.simplify([shapely.LineString(r) for r in rings], STAIR)
        ]
        outlines = tuple(ring[:-1] for ring in straight if len(ring) > 3)
        if outlines:
            rows, columns = island.coords.T
            areas.append(Area(outlines, color_of(flat[rows, columns])))
    return areas
