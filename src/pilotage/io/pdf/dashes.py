"""Join dashes that are painted one by one into the lines that they draw: browsers print dashed lines so."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Polyline

FEWEST = 4
"""Fewer dashes may be anything."""

MOSTLY = 0.7
"""So many dashes, as a share, have the usual length, and go on from the one before at the usual distance."""

UNEVEN = 0.1
"""Lengths, distances and widths differ less than this, as a share."""


def dashed_lines(outlines: Sequence[Polyline]) -> tuple[tuple[Polyline, ...], float] | None:
    """Return the lines that a painted path draws dash by dash, and their width; None if it draws none.

    A dash is a rectangle whose outline begins along it; paint closes it. Walls and windows may be rows of
    rectangles, too, but not of one width, one length and one distance.

    >>> row = [Polyline([(x, 0), (x + 2, 0), (x + 2, 1), (x, 1)], closed=True) for x in range(0, 20, 5)]
    >>> dashed_lines(row)[0][0].vertices.tolist()
    [[0.0, 0.5], [17.0, 0.5]]
    """
    corners = np.array([line.vertices for line in outlines if len(line) == 4])
    if len(corners) < max(FEWEST, MOSTLY * len(outlines)):
        return None
    starts, ends = (corners[:, 0] + corners[:, 3]) / 2.0, (corners[:, 1] + corners[:, 2]) / 2.0
    along, across = corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]
    widths, lengths = np.hypot(*across.T), np.hypot(*(ends - starts).T)
    skew = np.abs(corners[:, 2] - corners[:, 1] - across).max(axis=1)
    is_box = (skew <= UNEVEN * widths) & (np.abs((along * across).sum(axis=1)) <= UNEVEN * lengths * widths)
    width, length = float(np.median(widths)), float(np.median(lengths))
    is_even = is_box & (lengths > 0.0) & (widths > 0.0) & (np.abs(widths - width) <= UNEVEN * width)
    if not is_even.all() or np.mean(np.abs(lengths - length) <= UNEVEN * length) < MOSTLY:
        return None
    goes_on = follows(starts, ends)
    if goes_on.mean() < MOSTLY:
        return None
    first = np.flatnonzero(np.append(True, ~goes_on))
    last = np.append(first[1:] - 1, len(starts) - 1)
    return tuple(Polyline(np.array([starts[a], ends[b]])) for a, b in zip(first, last, strict=True)), width


def follows(starts: Array, ends: Array) -> NDArray[np.bool_]:
    """Tell which dashes (n, 2) go on in a line with the one before, at the usual distance, (n - 1,)."""
    steps, gaps = ends - starts, starts[1:] - ends[:-1]
    units = steps / np.hypot(*steps.T)[:, np.newaxis]
    apart = np.hypot(*gaps.T)
    usual = np.median(apart)
    ahead = np.minimum((gaps * units[:-1]).sum(axis=1), (gaps * units[1:]).sum(axis=1))
    return np.asarray(
        (apart > 0.0) & (np.abs(apart - usual) <= UNEVEN * usual) & (ahead >= (1.0 - UNEVEN) * apart)
    )
