"""Find letters that were turned into outlines: small painted shapes in rows."""

from collections.abc import Sequence

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.interpretation.sheet import Mark

TALLEST = 0.03
"""No letter is higher than this share of the drawing's diagonal: a title is."""

APART = 0.6
"""Letters of a word are no farther apart than this share of their height."""

SPACE = 1.5
"""Letters of one mark are no farther apart than so many of their heights: there is a space between words."""

LIKE = 2.2
"""Letters of a word differ in height by no more than this factor: x and l."""

WORD = 3
"""So many letters make a word."""

CURVED = 6
"""A letter has more corners than this, but for some: columns and chairs have four."""

SOME = 0.4
"""So many letters of a word have many corners, as a share."""


def find_glyphs(marks: Sequence[Mark], diagonal: float) -> set[int]:
    """Find the places of marks that are letters, or words of letters."""
    boxes, corners, owners = [], [], []
    for place, mark in enumerate(marks):
        if mark.pen is not None or mark.fill is None:
            continue
        for outline in mark.outlines:
            low, high = outline.vertices.min(axis=0), outline.vertices.max(axis=0)
            boxes.append((*low.tolist(), *high.tolist()))
            corners.append(len(outline))
            owners.append(place)
    if not boxes:
        return set()
    bounds, vertices, holders = without_parts(np.array(boxes), np.array(corners), np.array(owners))
    sizes = (bounds[:, 2:] - bounds[:, :2]).max(axis=1)
    small = sizes <= TALLEST * diagonal
    words = rustworkx.PyGraph()
    words.add_nodes_from(range(len(bounds)))
    shapes = shapely.box(*bounds.T)
    reach = np.where(small, SPACE * sizes, 0.0)
    first, second = shapely.STRtree(shapes).query(shapes, predicate="dwithin", distance=reach)
    alike = np.maximum(sizes[first], sizes[second]) <= LIKE * np.minimum(sizes[first], sizes[second])
    near = shapely.distance(shapes[first], shapes[second]) <= APART * sizes[first]
    near |= holders[first] == holders[second]
    beside = (first != second) & small[first] & small[second] & alike & near
    words.add_edges_from_no_data(
        [(int(a), int(b)) for a, b in zip(first[beside], second[beside], strict=True)]
    )
    letters = np.zeros(len(bounds), dtype=bool)
    for group in rustworkx.connected_components(words):
        members = sorted(group)
        if len(members) >= WORD and np.mean(vertices[members] > CURVED) >= SOME:
            letters[members] = True
    return set(holders.tolist()) - set(holders[~letters].tolist())


def without_parts(
    bounds: Array, corners: NDArray[np.int64], owners: NDArray[np.int64]
) -> tuple[Array, NDArray[np.int64], NDArray[np.int64]]:
    """Leave out the eye of an O and the dot of an i: count their corners with the letter that they belong to.

    Takes and returns the boxes (n, 4) of outlines, how many corners they have, and the places of their marks.
    """
    shapes, sizes = shapely.box(*bounds.T), (bounds[:, 2:] - bounds[:, :2]).max(axis=1)
    whole, part = shapely.STRtree(shapes).query(shapes, predicate="dwithin", distance=APART * sizes)
    is_eye = shapely.contains(shapes[whole], shapes[part]) & (bounds[whole] != bounds[part]).any(axis=1)
    is_dot = sizes[whole] > LIKE * sizes[part]
    belongs = (owners[whole] == owners[part]) & (is_eye | is_dot)
    counts = corners.copy()
    np.add.at(counts, whole[belongs], corners[part[belongs]])
    kept = np.ones(len(bounds), dtype=bool)
    kept[part[belongs]] = False
    return bounds[kept], counts[kept], owners[kept]
