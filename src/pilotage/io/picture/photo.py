"""Find the sheet of paper in a photo, and straighten its perspective."""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array, Homography

COARSE = 400
"""Paper is looked for in a picture made this small along its longer side [pixels]."""

LEAST_AREA = 0.2
"""Paper covers at least this share of the picture."""

LEAST_SQUARE = 0.93
"""Paper and the quadrangle around it overlap by at least this share of both."""

MOST_EDGE = 0.05
"""Paper touches at most this share of the edge of the picture: all of it is in view."""

FLAT_EDGE = 0.55
"""The edge of a drawing by a program has one color for at least this share; no camera sees that."""

ONE_COLOR = 0.012
"""Colors that differ by no more than this in each channel are one: files lose some of it."""

INSET = 0.012
"""The rim of the paper is left out by this share of its shorter side: shadows and crooked cuts."""


@dataclass(frozen=True, eq=False)
class Straightened:
    """A picture of the paper alone, seen from straight above."""

    colors: NDArray[np.float32]  # (height, width, 3)
    corner: tuple[float, float]  # of the picture in the straightened plane [pixels], y down
    picture_from_plane: Array  # 3 x 3 homography [pixels], y down


def is_photo(colors: NDArray[np.float32]) -> bool:
    """Tell a camera's picture from a program's: no color fills its edge."""
    edge = np.concatenate([colors[0], colors[-1], colors[:, 0], colors[:, -1]])
    alike = (np.abs(edge - np.median(edge, axis=0)) <= ONE_COLOR).all(axis=1)
    return bool(alike.mean() < FLAT_EDGE)


def find_paper(colors: NDArray[np.float32]) -> Array | None:
    """Find the corners of the one sheet of paper, clockwise on the picture, (4, 2) of x and y [pixels]."""
    from scipy.ndimage import binary_fill_holes, binary_opening, gaussian_filter, label
    from skimage.filters import threshold_otsu
    from skimage.measure import find_contours

    step = max(1, max(colors.shape[:2]) // COARSE)
    small = gaussian_filter(colors, (step, step, 0))[::step, ::step]
    edge = np.concatenate([small[0], small[-1], small[:, 0], small[:, -1]])
    away = np.linalg.norm(small - np.median(edge, axis=0), axis=2)
    parts, count = label(binary_opening(away > threshold_otsu(away), iterations=2))
    if not count:
        return None
    largest = 1 + int(np.argmax(np.bincount(parts.ravel())[1:]))
    paper = binary_fill_holes(parts == largest)
    rim = np.concatenate([paper[0], paper[-1], paper[:, 0], paper[:, -1]])
    if paper.mean() < LEAST_AREA or rim.mean() > MOST_EDGE:
        return None
    outline = max(find_contours(np.pad(paper, 1).astype(np.float64), 0.5), key=len)[:, ::-1] - 0.5
    corners = quadrangle_around(outline)
    if corners is None or overlap(shapely.Polygon(corners), shapely.Polygon(outline)) < LEAST_SQUARE:
        return None
    return np.asarray(corners * step)


def quadrangle_around(outline: Array) -> Array | None:
    """Fit four straight sides to an outline (n, 2); their corners (4, 2), or None if there are not four."""
    hull = shapely.convex_hull(shapely.MultiPoint(outline))
    for tolerance in np.geomspace(1.0, 30.0, 20):
        ring = shapely.get_coordinates(shapely.simplify(hull, tolerance))[:-1]
        if len(ring) <= 4:
            break
    if len(ring) != 4:
        return None
    starts, ends = ring, np.roll(ring, -1, axis=0)
    sides = [side_along(outline, start, end) for start, end in zip(starts, ends, strict=True)]
    if any(side is None for side in sides):
        return None
    lines = np.array(sides)
    crossings = np.cross(np.roll(lines, 1, axis=0), lines)
    corners = crossings[:, :2] / crossings[:, 2:]
    first = int(np.argmin(corners.sum(axis=1)))
    corners = np.roll(corners, -first, axis=0)
    clockwise = shapely.LinearRing(corners).is_ccw  # with y down
    return np.asarray(corners if clockwise else corners[[0, 3, 2, 1]])


def side_along(outline: Array, start: Array, end: Array) -> Array | None:
    """Fit a line to the outline's points along the middle of a side, (3,) with a x + b y + c = 0."""
    along = end - start
    length = float(np.hypot(*along))
    share = (outline - start) @ along / length**2
    beside = np.abs((outline - start) @ (-along[1], along[0])) / length
    near = outline[(share > 0.1) & (share < 0.9) & (beside < 0.03 * length + 1.0)]
    if len(near) < 3:
        return None
    middle = near.mean(axis=0)
    normal = np.linalg.svd(near - middle)[2][1]
    return np.array([*normal, -normal @ middle])


def overlap(one: shapely.Polygon, other: shapely.Polygon) -> float:
    """Return intersection over union."""
    if not one.is_valid:
        return 0.0
    return float(one.intersection(other.buffer(0)).area / one.union(other.buffer(0)).area)


def straighten(colors: NDArray[np.float32], corners: Array) -> Straightened:
    """Turn the paper between four corners into a rectangle of about its place and size in the picture."""
    from skimage.transform import ProjectiveTransform, warp

    sides = np.hypot(*(np.roll(corners, -1, axis=0) - corners).T)
    width, height = float(sides[[0, 2]].mean()), float(sides[[1, 3]].mean())
    left, top = corners.mean(axis=0) - (width / 2, height / 2)
    right, bottom = left + width, top + height
    rectangle = np.array([(left, top), (right, top), (right, bottom), (left, bottom)])
    picture_from_plane = Homography.between(rectangle, corners).matrix
    inset = INSET * min(width, height)
    corner = np.round([left + inset, top + inset])
    shape = np.round([height - 2 * inset, width - 2 * inset]).astype(int)
    # A pixel's middle lies half a pixel from its corner, in either plane.
    to_plane = np.array([[1.0, 0.0, corner[0] + 0.5], [0.0, 1.0, corner[1] + 0.5], [0.0, 0.0, 1.0]])
    to_index = np.array([[1.0, 0.0, -0.5], [0.0, 1.0, -0.5], [0.0, 0.0, 1.0]])
    index_map = ProjectiveTransform(to_index @ picture_from_plane @ to_plane)
    straight = warp(colors, index_map, output_shape=tuple(shape), order=1, mode="edge", preserve_range=True)
    return Straightened(
        np.asarray(straight, dtype=np.float32), (float(corner[0]), float(corner[1])), picture_from_plane
    )
