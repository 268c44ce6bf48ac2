"""From a picture to a sheet of marks."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Homography, Polyline
from pilotage.interpretation import Mark, Pen, Sheet
from pilotage.io.picture.ink import find_ink
from pilotage.io.picture.light import flatten
from pilotage.io.picture.photo import find_paper, is_photo, straighten
from pilotage.io.picture.signs import uncovered
from pilotage.io.picture.text import find_words
from pilotage.io.picture.trace import Area, Line, trace
from pilotage.io.picture.width import SLENDER, area_widths, depth_of, width_at

MOST = 2_750_000
"""A picture of more pixels than this is made smaller, and none is made larger than this."""

FEW = 1_000_000
"""A picture of fewer pixels is read at up to twice its size, for its lines are a pixel or two wide."""


@dataclass(frozen=True, eq=False)
class Plane:
    """Where the pixels that were looked at lie: `scale` times their place, moved to `corner`, y up."""

    scale: float
    corner: tuple[float, float]  # [pixels of the straightened plane], y down

    def points(self, pixels: Array) -> Array:
        """Carry points (n, 2), y down, to the plane, y up."""
        return np.asarray((pixels * self.scale + self.corner) * (1.0, -1.0))


def sheet_of(colors: NDArray[np.float32], source: str = "") -> Sheet:
    """Trace a picture (height, width, 3) of shades from 0 to 1; a unit of the sheet is a pixel of it.

    A photo of paper on a table is straightened, and `photo_from_sheet` carries points back to its pixels.
    """
    from skimage.morphology import skeletonize

    scale, working = resized(colors)
    photo = is_photo(working)
    corners = find_paper(working) if photo else None
    corner, homography = (0.0, 0.0), None
    if corners is not None:
        paper = straighten(working, corners)
        working, homography = paper.colors, to_full_size(paper.picture_from_plane, scale)
        corner = (paper.corner[0] * scale, paper.corner[1] * scale)
    flat = uncovered(flatten(working, is_photo=photo))
    ink = find_ink(flat)
    middle = skeletonize(ink.mask)
    depth = depth_of(ink.mask)
    widths = width_at(depth[middle])
    pen_width = float(np.median(widths)) if widths.size else 1.0
    words = find_words(ink.mask, middle, pen_width)
    drawn = ink.mask & ~words.mask
    wide = area_widths(width_at(depth[middle & drawn]), pen_width, float(np.hypot(*drawn.shape)))
    wide = wide if photo else replace(wide, slender=SLENDER)
    areas, lines = trace(drawn, flat, depth, pen_width, wide)
    plane = Plane(scale, corner)
    return Sheet(
        marks_of(areas, lines, plane),
        y_down=True,
        source=source,
        photo_from_sheet=homography,
        left_out=left_out(words.mask, ruled=ink.ruled),
        unread=tuple((x, y) for x, y in plane.points(words.letters).tolist()),
    )


def resized(colors: NDArray[np.float32]) -> tuple[float, NDArray[np.float32]]:
    """Make a picture a size that is good to trace; returns how many pixels one of its pixels was."""
    from PIL import Image

    height, width = colors.shape[:2]
    if FEW <= height * width <= MOST:
        return 1.0, colors
    factor = min(2.0, float(np.sqrt(MOST / (height * width))))
    size = (round(factor * width), round(factor * height))
    between = Image.Resampling.BICUBIC if factor > 1.0 else Image.Resampling.BOX
    working = np.moveaxis(np.empty((3, *size[::-1]), dtype=np.float32), 0, 2)  # each channel in one piece
    for k in range(3):
        channel = Image.fromarray(colors[..., k]).resize(size, between)
        np.clip(np.asarray(channel), 0.0, 1.0, out=working[..., k])
    return width / size[0], working


def to_full_size(homography: Array, scale: float) -> Homography:
    """Carry a homography of small pixels, y down, to one of the picture's own, y up."""
    larger = np.diag([scale, -scale, 1.0])
    return Homography.from_matrix(larger @ homography @ np.linalg.inv(larger))


def marks_of(areas: list[Area], lines: list[Line], plane: Plane) -> tuple[Mark, ...]:
    """Make a mark of each area and each line, in the color of its ink on white paper."""
    marks = []
    for area in areas:
        rings = tuple(Polyline(plane.points(ring), closed=True) for ring in area.rings)
        marks.append(Mark(rings, fill=area.color, source=f"area at {place(rings[0].vertices)}"))
    for line in lines:
        middle = Polyline(plane.points(line.points))
        pen = Pen(line.color, line.width * plane.scale)
        marks.append(Mark((middle,), pen, source=f"line at {place(middle.vertices)}"))
    return tuple(marks)


def place(points: Array) -> str:
    """Write where a mark is, as its file would [pixels, y down]."""
    x, y = points.mean(axis=0)
    return f"{x:.0f},{-y:.0f}"


def left_out(words: NDArray[np.bool_], *, ruled: bool) -> tuple[str, ...]:
    """Say what was not made a mark."""
    found = []
    if words.any():
        found.append("words and small symbols, which a picture shows but does not tell")
    if ruled:
        found.append("the lines of ruled paper")
    return tuple(found)
