"""Lead lines on to a wall before which they end so near that the paint of both leaves but a slit."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from pilotage.geometry import Array
from pilotage.interpretation.paint import Seen, parts_of
from pilotage.interpretation.sheet import Sheet

SLIT = 0.5
"""No way leads through a slit of at most this share of the thickness of the thicker line."""

BEYOND = 0.05
"""A line is led this far beyond the other one, as a share of its thickness: rounding leaves no gap then."""

THICKEST = 0.02
"""A line that is thicker than this share of the drawing's diagonal is a road or a carpet."""

LONG = 5.0
"""The last straight piece of a line tells where it leads if it is so many times as long as it is thick."""

TOUCHING = 1e-6
"""Lines that come this near meet, as a share of the drawing's diagonal."""


def led_on(sheet: Sheet, seen: Sequence[Seen], diagonal: float) -> list[Seen]:
    """Lead lines on to what lies straight ahead of their free ends, if only a slit is between the paint."""
    strokes = [
        (place, line, pen.width)
        for place, mark in enumerate(seen)
        if (pen := sheet.marks[mark.number].pen) is not None
        and 0.0 < pen.width <= THICKEST * diagonal
        and not pen.dashed
        for line in parts_of(mark.line)
        if not line.is_empty
    ]
    if not strokes:
        return list(seen)
    points = [shapely.get_coordinates(line) for _, line, _ in strokes]
    segments = np.concatenate([np.stack([p[:-1], p[1:]], axis=1) for p in points])
    widths = np.repeat([width for *_, width in strokes], [len(p) - 1 for p in points])
    tree = shapely.STRtree(shapely.linestrings(segments))
    places = np.repeat([place for place, *_ in strokes], 2)
    own = np.repeat([width for *_, width in strokes], 2)
    ends = np.array([(p[k], p[k] - p[j]) for p in points for k, j in ((0, 1), (-1, -2))])  # (n, 2, 2)
    met = tree.query(shapely.points(ends[:, 0]), predicate="dwithin", distance=TOUCHING * diagonal)[0]
    is_long = np.hypot(*ends[:, 1].T) >= LONG * own
    free = np.flatnonzero((np.bincount(met, minlength=len(ends)) == 1) & is_long)
    if not len(free):
        return list(seen)
    added = defaultdict(list)
    for end, foot in ahead(ends[free], own[free], segments, widths, tree):
        added[int(places[free[end]])].append(shapely.LineString([ends[free[end], 0], foot]))
    return [
        replace(mark, line=shapely.multilinestrings([*parts_of(mark.line), *added[place]]), whole=False)
        if place in added
        else mark
        for place, mark in enumerate(seen)
    ]


def ahead(
    ends: Array, own: Array, segments: Array, widths: Array, tree: shapely.STRtree
) -> list[tuple[int, Array]]:
    """Find where lines that are led on cross others: which of the `ends`, and a point just beyond the other.

    `ends` (n, 2, 2) holds where each line ends and in which direction; lines are `own` (n,) wide, `segments`
    (m, 2, 2) `widths` (m,).
    """
    along = ends[:, 1] / np.hypot(*ends[:, 1].T)[:, None]
    reach = (own + widths.max()) / 2.0 + SLIT * np.maximum(own, widths.max())
    rays = shapely.linestrings(np.stack([ends[:, 0], ends[:, 0] + reach[:, None] * along], axis=1))
    end, other = tree.query(rays, predicate="intersects")
    steps = segments[other, 1] - segments[other, 0]
    across = along[end, 0] * steps[:, 1] - along[end, 1] * steps[:, 0]
    offset = segments[other, 0] - ends[end, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        distances = (offset[:, 0] * steps[:, 1] - offset[:, 1] * steps[:, 0]) / across
    allowed = (own[end] + widths[other]) / 2.0 + SLIT * np.maximum(own[end], widths[other])
    near = (distances > 0.0) & (distances <= allowed)
    nearest: dict[int, float] = {}
    for number, distance in zip(end[near].tolist(), distances[near].tolist(), strict=True):
        nearest[number] = min(distance, nearest.get(number, distance))
    return [
        (number, ends[number, 0] + (distance + BEYOND * own[number]) * along[number])
        for number, distance in nearest.items()
    ]
