"""Make lines and areas of ink: thin ink is lines along its middle, fat ink is areas."""

from collections import defaultdict
from dataclasses import dataclass
from statistics import median

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.interpretation.sheet import Color
from pilotage.io.picture.arcs import part_arcs, with_leaf
from pilotage.io.picture.bars import part_bars
from pilotage.io.picture.colors import COLORED, DARK, brightest, fat_ink, hue_of
from pilotage.io.picture.join import join_straight
from pilotage.io.picture.skeleton import straightened, trace_runs
from pilotage.io.picture.width import AreaWidths, width_at

Mask = NDArray[np.bool_]

DOORS = (0.01, 0.12)
"""Doors are this wide, as shares of the picture's diagonal."""

LEAVES = 0.25
"""If a smaller share of the arcs has a leaf, they are bends: a hand draws walls so."""

RIM = 2
"""Ink is blurred over so many pixels."""

MOSTLY = 0.5
"""Walls are black or gray if this share of thin ink is."""

BLURRED = 0.2
"""The rim of ink in a color is gray, too, less than this share of it."""

STAIR = 0.8
"""How far a contour may move to become straight [pixels]: the steps that pixels make of a slanted wall."""


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


def trace(
    ink: Mask,
    flat: NDArray[np.float32],
    depth: NDArray[np.float32],
    pen_width: float,
    widths: AreaWidths,
) -> tuple[list[Area], list[Line]]:
    """Trace ink on flattened paper (height, width, 3), what is wide as areas; `depth` is that of all ink.

    Each color of fat ink is traced by itself.
    """
    fat, grounds = fat_ink(ink, flat, widths)
    black = ink & (brightest(flat) < DARK)
    thin = (ink & ~rimmed(grounds)) | (black & ~grounds)
    for color in fat:
        thin &= ~rimmed(color)
    thin &= ~free_signs(ink, thin, flat)
    plain, bars = lines_of(thin, ink, depth, pen_width)
    lines = [line_of(points, flat, depth) for points in plain]
    lines += of_one_pen([line_of(points, flat, depth) for points in bars])
    return [area for color in fat for area in areas_of(color, flat)], lines


def free_signs(ink: Mask, thin: Mask, flat: NDArray[np.float32]) -> Mask:
    """Mark ink in colors that touches no black or gray, where most thin ink is that: arrows of routes."""
    from skimage.measure import label

    lightest, darkest = brightest(flat), 1.0 - brightest(1.0 - flat)
    plain = ink & (lightest - darkest < COLORED * (1.0 - darkest))
    if np.count_nonzero(plain & thin) < MOSTLY * np.count_nonzero(thin):
        return np.zeros_like(ink)
    parts = label(ink, connectivity=2)
    total = np.bincount(parts.ravel())
    grays = np.bincount(parts[plain], minlength=len(total))
    free = grays < BLURRED * total
    free[0] = False
    return np.asarray(free[parts])


def lines_of(
    thin: Mask, ink: Mask, depth: NDArray[np.float32], pen_width: float
) -> tuple[list[Array], list[Array]]:
    """Trace thin ink: arcs of doors smooth, all other lines as long as they go on, and bars, (n, 2) each."""
    runs, mean_width = trace_runs(thin)
    radii = (DOORS[0] * float(np.hypot(*thin.shape)), DOORS[1] * float(np.hypot(*thin.shape)))
    parts = [part_arcs(run, pen_width, radii) for run in runs]
    rest = [run for others, _ in parts for run in others]
    arcs = [with_leaf(arc, ink) for _, found in parts for arc in found]
    if sum(arc.has_leaf for arc in arcs) < LEAVES * len(arcs):
        rest, arcs = runs, []
    others, bars = part_bars([run for run in rest if len(run) > 1], depth, pen_width)
    lines = join_straight(straightened(others, mean_width), pen_width)
    lines += [line for arc in arcs for line in arc.lines]
    return lines, straightened(bars, mean_width)


def line_of(points: Array, flat: NDArray[np.float32], depth: NDArray[np.float32]) -> Line:
    """Take width and color of a line (n, 2) from the ink below it."""
    rows, columns = pixels_along(points, depth.shape)
    broad = float(np.median(width_at(depth[rows, columns])))
    return Line(points, broad, color_of(flat[rows, columns]))


def of_one_pen(bars: list[Line]) -> list[Line]:
    """Give bars of one hue one width and one color."""
    by_hue: dict[int, list[Line]] = defaultdict(list)
    for bar in bars:
        by_hue[hue_of(bar.color)].append(bar)
    pens = {
        hue: (median([bar.width for bar in alike]), color_of(np.array([bar.color for bar in alike])))
        for hue, alike in by_hue.items()
    }
    return [Line(bar.points, *pens[hue]) for hue, alike in by_hue.items() for bar in alike]


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


def rimmed(fat: Mask) -> Mask:
    """Add the blurred rim of fat ink, which is no line beside it."""
    from scipy.ndimage import binary_dilation

    return np.asarray(binary_dilation(fat, np.ones((3, 3), dtype=bool), iterations=RIM))


def areas_of(fat: Mask, flat: NDArray[np.float32]) -> list[Area]:
    """Trace the outlines of areas and their holes; areas of one hue have one color."""
    from skimage.measure import label, regionprops

    islands = regionprops(label(fat, connectivity=1))
    pixels = [flat[tuple(island.coords.T)] for island in islands]
    hues = [hue_of(color_of(colors)) for colors in pixels]
    colors = {
        hue: color_of(
            np.concatenate([part for part, other in zip(pixels, hues, strict=True) if other == hue])
        )
        for hue in set(hues)
    }
    areas = [
        Area(outlines_of(island.image, island.bbox[:2]), colors[hue])
        for island, hue in zip(islands, hues, strict=True)
    ]
    return [area for area in areas if area.rings]


def outlines_of(image: Mask, corner: tuple[int, int]) -> tuple[Array, ...]:
    """Trace an island, given its pixels and the row and column of their corner, rings (n, 2) y down."""
    from skimage.measure import find_contours

    contours = find_contours(np.pad(image, 1).astype(np.float64), 0.5)
    rings = [shapely.LineString(ring[:, ::-1] + (corner[1] - 0.5, corner[0] - 0.5)) for ring in contours]
    straight = [shapely.get_coordinates(ring)[:-1] for ring in shapely.simplify(rings, STAIR)]
    return tuple(ring for ring in straight if len(ring) > 2)
