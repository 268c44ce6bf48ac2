"""Find rows of lines alike, as the steps of stairs and shelves are drawn."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array

STEPS = 5
"""So many lines, one after the other, may be the steps of stairs."""

MOST_LINES = 1000
"""Among more lines no rows are looked for: they are hatches."""

DEPTH = (0.05, 0.6)
"""Steps lie so far apart, as a share of their width."""

ALIKE, EVEN = 0.1, 1.3
"""Their widths and sides differ by this share at most, their depths by this factor."""

PARALLEL = math.radians(3.0)


def rows_of_steps(lines: Array) -> list[NDArray[np.intp]]:
    """Find rows of parallel lines (n, 2, 2) that are alike and evenly spaced; each line is in one row."""
    if not 0 < len(lines) <= MOST_LINES:
        return []
    following, depth, is_first = next_steps(np.concatenate([lines, lines[:, ::-1]]))
    rows: list[NDArray[np.intp]] = []
    used = np.zeros(len(lines), dtype=bool)
    for first in np.argsort(~is_first, kind="stable").tolist():
        row, last = [first % len(lines)], first
        while depth[last] < EVEN * depth[first] and depth[first] < EVEN * depth[last]:
            last = int(following[last])
            if last % len(lines) in row:
                break  # spokes all around: no end
            row.append(last % len(lines))
        if len(row) >= STEPS:
            if not used[row].any():
                rows.append(np.array(row))
            used[row] = True
    return rows


def next_steps(lines: Array) -> tuple[NDArray[np.intp], Array, NDArray[np.bool_]]:
    """Find for each directed line (n, 2, 2) the nearest that may be the next step, to its right.

    Returns which line it is, how far it is away, infinite if there is none, and whether the line is no step
    after another, each (n,).
    """
    along = lines[:, 1] - lines[:, 0]
    widths = np.hypot(along[:, 0], along[:, 1])
    along /= np.where(widths > 0.0, widths, 1.0)[:, np.newaxis]
    between = lines.mean(axis=1)[np.newaxis] - lines.mean(axis=1)[:, np.newaxis]
    beside = np.abs(np.einsum("ijk,ik->ij", between, along))
    across = along[:, ::-1] * (1.0, -1.0)
    ahead = np.einsum("ijk,ik->ij", between, across)
    width = widths[:, np.newaxis]
    follows = (along @ along.T > 0.0) & (np.abs(along @ across.T) < math.sin(PARALLEL))
    follows &= (np.abs(widths - width) < ALIKE * width) & (beside < ALIKE * width)
    follows &= (ahead > DEPTH[0] * width) & (ahead < DEPTH[1] * width)
    depths = np.where(follows, ahead, np.inf)
    return depths.argmin(axis=1), depths.min(axis=1), np.asarray(~follows.any(axis=0))
