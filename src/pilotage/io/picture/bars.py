"""Part traced lines where the pen changes: a bar on a line, which marks a door or a window, is thicker."""

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.io.picture.width import width_at

THICKER = 1.7
"""A bar is so many times as thick as the line it lies on."""

LEAST = 3.0
"""And thicker than this [pixels]: below it widths cannot be told."""

SLENDER = 3.0
"""It is longer than so many of its widths: where lines meet they are thick, too, but over no length."""


def part_bars(
    runs: list[Array], depth: NDArray[np.float32], pen_width: float
) -> tuple[list[Array], list[Array]]:
    """Cut runs of pixels (n, 2) into thin ones and bars; they share the pixel where they meet."""
    thin, bars = [], []
    for run in runs:
        columns, rows = np.floor(run).astype(np.int64).T
        widths = width_at(depth[rows, columns])
        first = 0
        for begin, end in thick_parts(widths, max(LEAST, THICKER * pen_width)):
            bars.append(run[begin : end + 1])
            thin.append(run[first : begin + 1])
            first = end
        thin.append(run[first:])
    return [run for run in thin if len(run) > 1], bars


def thick_parts(widths: NDArray[np.float32], thick: float) -> list[tuple[int, int]]:
    """List where widths along a run exceed this for long enough: the first and the last pixel of each."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], widths > thick, [False]]).astype(np.int8)))
    spans = [(begin, end - 1) for begin, end in edges.reshape(-1, 2).tolist()]
    return [
        (begin, end)
        for begin, end in spans
        if end - begin > SLENDER * float(np.median(widths[begin : end + 1]))
    ]
