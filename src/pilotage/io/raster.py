"""Read a drawing from a picture: a filled plan or a line drawing.

How the shading is recognized, and nowhere else (`recognize`): by what touches the edge of the picture.

- No color fills the edge: a photo or a scan of a line drawing (`LINES`).
- The edge is gray and a good part of the picture is lighter: a plan as robots draw it. What is light is free.
- Otherwise what differs from the edge is ink. Thin ink is the strokes of a pen of any color (`LINES`).
- Fat ink that fills little of what lies within its outermost marks is thick walls (`LINES`).
- Other fat ink is free space: light on a dark ground (`LIGHT_IS_FREE`) or dark on light (`DARK_IS_FREE`).

`io/picture` reads line drawings. Name a `Shading` to override what is recognized. A picture is read in
pixels from its upper left corner, y up and so below 0; a resolution that a file claims is never believed.
"""

from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import TypeVar

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.errors import FileError
from pilotage.geometry import Polyline
from pilotage.interpretation import Sheet
from pilotage.io.files import check_regular
from pilotage.maps import SchematicMap

Mask = NDArray[np.bool_]
Scalar = TypeVar("Scalar", bound=np.generic)

LIGHT = 0.9
"""Share of the range of shades from which on a shade is light: 230 of 255."""

DARK = 0.25
"""Share of the range of shades up to which a shade is dark."""

FLOOR_SHARE = 0.03
"""On a gray ground at least this share of a plan is light: less is the glare of a photograph."""

PEN_WIDTH = 0.012
"""Ink of less mean width than this share of the picture's diagonal is a pen's: 12 pixels of 1000."""

SOLID = 0.25
"""Free space fills at least this share of its convex hull; walls, however thick, fill less."""

STAIR = 1.0
"""How far a contour may move to become straight [pixels]: the steps that pixels make of a slanted wall."""

FORMATS = ("PNG", "JPEG", "PPM", "GIF", "TIFF", "WEBP", "BMP")
"""What Pillow may take a file for, whatever its name; others, such as PostScript, would run a program."""

MAX_PIXELS = 20_000_000
"""A larger picture would need more than 2 GB of memory."""

OPAQUE = 128
"""Alpha from which on a pixel is seen."""


class Shading(Enum):
    """What a picture means by its shades, as a user names it."""

    RECOGNIZED = "recognized"
    LIGHT_IS_FREE = "light-is-free"
    DARK_IS_FREE = "dark-is-free"
    LINES = "lines"


@dataclass(frozen=True, eq=False)
class Picture:
    """Colors of a picture from 0 to 1, what is transparent in the color of its edge."""

    colors: NDArray[np.float32]  # (height, width, 3)

    @property
    def shades(self) -> NDArray[np.float32]:
        """Gray of each pixel, stretched from 0 (darkest) to 1 (lightest), (height, width)."""
        gray = self.colors.mean(axis=2)
        low, high = gray.min(), gray.max()
        return np.asarray((gray - low) / (high - low if high > low else 1.0))

    @property
    def diagonal(self) -> float:
        """[pixels]."""
        height, width = self.colors.shape[:2]
        return float(np.hypot(height, width))


def sheet_or_plan(picture: Picture, shading: Shading, path: Path) -> Sheet | SchematicMap:
    """Find the marks of a line drawing, or the free space of a filled plan, in a picture.

    Both are in pixels, y up. Raises FileError if a filled plan shows no free space.
    """
    from pilotage.io.picture import sheet_of

    if shading is Shading.RECOGNIZED:
        shading = recognize(picture)
    if shading is Shading.LINES:
        return sheet_of(picture.colors, source=str(path))
    light = picture.shades >= LIGHT
    return from_free_space(
        light if shading is Shading.LIGHT_IS_FREE else picture.shades < 1.0 - LIGHT + DARK, path
    )


def read_picture(path: Path) -> Picture:
    """Read the colors of a picture."""
    from PIL import Image, UnidentifiedImageError
    from PIL.ImageOps import exif_transpose as upright

    check_regular(path)
    try:
        with Image.open(path, formats=FORMATS) as image:
            if image.width * image.height > MAX_PIXELS:
                raise FileError(
                    f"a picture must have at most {MAX_PIXELS // 1_000_000} million pixels,"
                    f" got {image.width} x {image.height}",
                    path,
                )
            rgba = np.asarray(upright(image).convert("RGBA"))
    except FileNotFoundError as error:
        raise FileError("there is no such file", path) from error
    except UnidentifiedImageError as error:  # whose message is the path
        raise FileError("a picture cannot be read (it is damaged, or of an unknown kind)", path) from error
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise FileError(f"a picture cannot be read ({error})", path) from error
    seen = rgba[..., 3] >= OPAQUE
    colors = np.asarray(rgba[..., :3] / np.float32(255.0), dtype=np.float32)
    edge = edge_of(seen)
    if not seen.all():
        colors[~seen] = np.median(edge_of(colors)[edge], axis=0) if edge.any() else 1.0
    return Picture(colors)


def edge_of(pixels: NDArray[Scalar]) -> NDArray[Scalar]:
    """List the pixels along the edge, a hundredth of the shorter side deep; those of the corners twice."""
    depth = max(1, min(pixels.shape[:2]) // 100)
    strips = (pixels[:depth], pixels[-depth:], pixels[:, :depth], pixels[:, -depth:])
    return np.concatenate([strip.reshape(-1, *pixels.shape[2:]) for strip in strips])


def recognize(picture: Picture) -> Shading:
    """Tell what a picture means by its shades; the rules stand at the head of this module."""
    from pilotage.io.picture.photo import is_photo

    if is_photo(picture.colors):
        return Shading.LINES
    shades = picture.shades
    ground = float(np.median(edge_of(shades)))
    if DARK < ground < LIGHT and np.mean(shades >= LIGHT) >= FLOOR_SHARE:
        return Shading.LIGHT_IS_FREE
    ink = shades < 1.0 - LIGHT + DARK if ground > DARK else shades >= LIGHT
    if mean_width(ink) < PEN_WIDTH * picture.diagonal or share_of_hull(ink) < SOLID:
        return Shading.LINES
    return Shading.DARK_IS_FREE if ground > DARK else Shading.LIGHT_IS_FREE


def mean_width(ink: Mask) -> float:
    """Estimate the mean width of marks [pixels]: twice their area over their outline."""
    padded = np.pad(ink, 1)
    outline = np.count_nonzero(padded[1:] != padded[:-1]) + np.count_nonzero(padded[:, 1:] != padded[:, :-1])
    return 2.0 * float(np.count_nonzero(ink)) / max(float(outline), 1.0)


def share_of_hull(ink: Mask) -> float:
    """Measure the share of their convex hull that marks fill."""
    rows = np.nonzero(ink.any(axis=1))[0]
    first, last = ink[rows].argmax(axis=1), ink.shape[1] - ink[rows, ::-1].argmax(axis=1)
    sides = [np.column_stack([columns, edge]) for columns in (first, last) for edge in (rows, rows + 1)]
    hull = shapely.convex_hull(shapely.multipoints(np.vstack(sides)))
    return float(np.count_nonzero(ink) / max(hull.area, 1.0))


def from_free_space(free: Mask, path: Path) -> SchematicMap:
    """Trace the contours of free space, free space on their left."""
    from skimage.measure import find_contours

    rows_and_columns = find_contours(np.pad(free, 1).astype(np.float64), 0.5, positive_orientation="high")
    rings = [np.column_stack([ring[:, 1] - 0.5, 0.5 - ring[:, 0]]) for ring in rows_and_columns]
    straight = shapely.simplify([shapely.LineString(ring) for ring in rings], STAIR)
    outlines = [shapely.get_coordinates(ring)[:-1] for ring in straight]
    strokes = tuple(Polyline(outline, closed=True) for outline in outlines if len(outline) > 2)
    if not strokes:
        raise FileError("a filled plan must show free space, found none", path)
    return SchematicMap(strokes, source=str(path), y_down=True, contours=True)
