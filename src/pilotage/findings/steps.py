"""Find what looks like stairs, and is taken for something that a robot drives around or over."""

import math
from collections.abc import Iterator

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.findings.finding import Finding, Severity
from pilotage.findings.rooms import named
from pilotage.geometry import Array
from pilotage.interpretation import Interpretation, Role
from pilotage.maps import CellGraph

STEPS = 5
"""So many lines, one after the other, may be the steps of stairs."""

MOST_LINES = 1000
"""Among more lines of furniture no stairs are looked for: hatches."""

DEPTH = (0.05, 0.6)
"""Steps lie so far apart, as a share of their width."""

ALIKE, EVEN = 0.1, 1.3
"""Their widths and sides differ by this share at most, their depths by this factor."""

PARALLEL = math.radians(3.0)


def find_drivable_stairs(graph: CellGraph, interpretation: Interpretation | None) -> Iterator[Finding]:
    """Find rows of lines in a room that look like the steps of stairs and are taken for furniture."""
    if interpretation is None:
        return
    pairs = zip(interpretation.sheet.marks, interpretation.meanings, strict=True)
    rings = [line.ring for mark, meaning in pairs if meaning.role is Role.FURNITURE for line in mark.outlines]
    lines = np.vstack([np.empty((0, 2, 2)), *(np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings)])
    for row in rows_of_steps(lines):
        x, y = lines[row].mean(axis=(0, 1)).tolist()
        for cell in graph.cells:
            if cell.polygon.contains(shapely.Point(x, y)):
                yield Finding(
                    "drivable-stairs",
                    Severity.NOTE,
                    f"{len(row)} lines in {named(cell)} look like steps, and a robot may drive there",
                    "if they are stairs, put them on a layer named 'stairs', or say so: --layer NAME=stairs",
                    (x, y),
                    (cell.cell_id,),
                )


def rows_of_steps(lines: Array) -> list[NDArray[np.intp]]:
    """Find rows of parallel lines (n, 2, 2) that are alike and evenly spaced; each line is in one row."""
    along = lines[:, 1] - lines[:, 0]
    widths = np.hypot(along[:, 0], along[:, 1])
    if not 0 < len(lines) <= MOST_LINES or not widths.any():
        return []
    along /= np.maximum(widths, 1e-12)[:, np.newaxis]
    along[(along[:, 1] < 0.0) | ((along[:, 1] == 0.0) & (along[:, 0] < 0.0))] *= -1.0
    between = lines.mean(axis=1)[np.newaxis] - lines.mean(axis=1)[:, np.newaxis]
    beside = np.abs(np.einsum("ijk,ik->ij", between, along))
    across = along[:, ::-1] * (1.0, -1.0)
    ahead = np.einsum("ijk,ik->ij", between, across)
    width = widths[:, np.newaxis]
    follows = np.abs(along @ across.T) < math.sin(PARALLEL)
    follows &= (np.abs(widths - width) < ALIKE * width) & (beside < ALIKE * width)
    follows &= (ahead > DEPTH[0] * width) & (ahead < DEPTH[1] * width)
    depths = np.where(follows, ahead, np.inf)
    following, depth = depths.argmin(axis=1), depths.min(axis=1)
    rows: list[NDArray[np.intp]] = []
    used = np.zeros(len(lines), dtype=bool)
    for first in np.argsort(follows.any(axis=0), kind="stable"):
        row = [int(first)]
        while depth[row[-1]] < EVEN * depth[first] and depth[first] < EVEN * depth[row[-1]]:
            row.append(int(following[row[-1]]))
        if len(row) >= STEPS and not used[row].any():
            rows.append(np.array(row))
        used[row] |= len(row) >= STEPS
    return rows
