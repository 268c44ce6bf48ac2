"""Draw the walls that signs hide: plans of escape ways have them painted over walls, strong in color."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.io.picture.colors import COLORED, DARK, brightest

Mask = NDArray[np.bool_]

STRONG = 0.6
"""A sign takes at least this share of paper's light in one color; floors are paler."""

SYMBOL = 0.008
"""What is white in a sign is at most this wide, as a share of the picture's diagonal."""

LEAST = 0.008
"""A sign is at least this wide: lines in a color are not."""

MOST = 0.1
"""It hides at most this much of a wall."""

EDGE = 4
"""Where a sign ends its color and that of a wall mix over so many pixels."""

STUB = 4.0
"""The direction of a wall is that of its last piece, so many times as long as it is thick."""

IN_LINE = np.cos(np.radians(12.0))
"""Pieces of one wall are in line up to this."""

INSIDE = 0.9
"""So much of what is drawn lies below the sign, as a share."""


@dataclass(frozen=True, eq=False)
class End:
    """Where a wall runs into a sign."""

    at: Array  # (2,) column and row [pixels]
    into: Array  # (2,) of length 1
    thickness: float  # [pixels]


def uncovered(flat: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return flattened paper (height, width, 3) with black walls drawn where they run below signs.

    A wall does if it runs into a sign on both sides, in line, or if two walls meet below it.
    """
    from skimage.draw import polygon2mask
    from skimage.measure import label, regionprops

    lightest, darkest = brightest(flat), 1.0 - brightest(1.0 - flat)
    colored = lightest - darkest >= COLORED * (1.0 - darkest)
    diagonal = float(np.hypot(*flat.shape[:2]))
    signs = with_symbols(colored & (darkest < 1.0 - STRONG), diagonal)
    if not signs.any():
        return flat
    black = (lightest < DARK) & ~colored
    result = flat.copy(order="K")
    margin = round(MOST * diagonal / 4.0) + EDGE
    for sign in regionprops(label(signs, connectivity=2)):
        top, left = (max(0, edge - margin) for edge in sign.bbox[:2])
        box = slice(top, sign.bbox[2] + margin), slice(left, sign.bbox[3] + margin)
        below = np.zeros_like(signs[box])
        below[tuple((sign.coords - (top, left)).T)] = True
        for bar in hidden(below, black[box] & ~signs[box], MOST * diagonal):
            result[box][polygon2mask(below.shape, bar[:, ::-1])] = 0.0
    return result


def with_symbols(strong: Mask, diagonal: float) -> Mask:
    """Fill the symbols in signs that strong colors show, and leave lines out."""
    from scipy.ndimage import maximum_filter, minimum_filter

    if not strong.any():
        return strong
    symbol, least = (2 * round(share * diagonal / 2.0) + 1 for share in (SYMBOL, LEAST))
    closed = minimum_filter(maximum_filter(strong, symbol), symbol)
    return np.asarray(maximum_filter(minimum_filter(closed, least), least))


def hidden(sign: Mask, black: Mask, longest: float) -> Iterator[Array]:
    """List the bars of wall, (4, 2) columns and rows, that a sign hides."""
    near = grown(sign)
    for first, second in combinations(ends_at(sign, black), 2):
        thickness = min(first.thickness, second.thickness)
        turn = float(first.into @ second.into)
        gap = second.at - first.at
        apart = float(np.hypot(*gap))
        if apart == 0.0 or apart > longest:
            continue
        if min(first.into @ gap, -second.into @ gap) >= IN_LINE * apart:
            ways = [(first.at, second.at)]
        elif abs(turn) < np.sqrt(1.0 - IN_LINE**2):
            along = np.linalg.solve(np.column_stack([first.into, -second.into]), gap)
            if along.min() <= 0.0 or along.max() > longest:
                continue
            corner = first.at + along[0] * first.into
            ways = [(end.at, corner + thickness / 2.0 * end.into) for end in (first, second)]
        else:
            continue
        if all(share_within(near, *way) > INSIDE for way in ways):
            yield from (bar_of(*way, thickness) for way in ways)


def ends_at(sign: Mask, black: Mask) -> Iterator[End]:
    """List the walls that run into a sign."""
    from skimage.measure import label, regionprops

    for contact in regionprops(label(black & grown(sign), connectivity=2)):
        at = contact.coords[:, ::-1].mean(axis=0)
        reach = STUB * contact.area / EDGE
        rows, columns = np.nonzero(black)
        places = np.column_stack([columns, rows])
        places = places[np.hypot(*(places - at).T) < reach]
        offsets = places - places.mean(axis=0)
        spread, axes = np.linalg.eigh(offsets.T @ offsets)
        beyond = float(axes[:, 1] @ (at - places.mean(axis=0)))  # 0 if it runs along the sign, or is a corner
        along = axes[:, 1] * np.sign(beyond)
        if (
            beyond != 0.0
            and spread[1] > 2.0 * spread[0]
            and share_within(sign, at + EDGE * along, at + 2 * EDGE * along) == 1.0
        ):
            variance = spread[0] / len(places)  # of a row of n pixels: (n^2 - 1) / 12
            yield End(at, along, float(np.sqrt(12.0 * variance + 1.0)))


def grown(sign: Mask) -> Mask:
    """Add the edge of a sign."""
    from scipy.ndimage import binary_dilation

    return np.asarray(binary_dilation(sign, np.ones((3, 3), dtype=bool), iterations=EDGE))


def share_within(mask: Mask, start: Array, end: Array) -> float:
    """Tell how much of the way between two places lies in a mask, as a share."""
    places = np.round(np.linspace(start, end, max(2, int(np.hypot(*(end - start)))))).astype(int)
    inside = ((places >= 0) & (places < mask.shape[::-1])).all(axis=1)
    columns, rows = places[inside].T
    return float(mask[rows, columns].sum() / len(places))


def bar_of(start: Array, end: Array, thickness: float) -> Array:
    """Return the corners of a bar (4, 2) of a thickness."""
    bar = shapely.buffer(shapely.linestrings([start, end]), thickness / 2.0, cap_style="flat")
    return np.asarray(shapely.get_coordinates(bar)[:-1])
