"""Turn hatching so dense that its lines touch into areas: what CAD programs print of a solid wall."""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import shapely

from pilotage.geometry import Array, Polyline
from pilotage.interpretation.sheet import Mark, Pen
from pilotage.io.sheet_builder import outlines_of_area

FEWEST_LINES = 50
"""A hatching has at least so many lines of one direction and one pen."""

LEAST_WIDTH = 3.0
"""An area is at least this wide, in widths of its lines: less is a heavy line."""

FEWEST_IN_A_STRIP = 8
"""So many lines side by side cover a strip."""

NEAR = 1.5
"""The ends of lines that touch are at most so many widths apart: the distance of four coordinates."""

DETAIL = 0.3
"""The teeth that hatching has at its edge are cut off, up to this share of the width of its lines."""

Key = tuple[Pen, int]


def filled_hatching(marks: Sequence[Mark]) -> list[Mark]:
    """Replace lines that touch their neighbors by the areas they cover, in the order of their first lines."""
    replaced: dict[int, Mark | None] = {}
    for (pen, _), indices in hatchings(marks).items():
        if len(indices) >= FEWEST_LINES:
            lines = directed(np.array([marks[k].outlines[0].vertices for k in indices]))
            for covered, rings in covered_areas(lines, pen.width):
                first, *others = sorted(indices[k] for k in covered)
                area = replace(marks[first], outlines=rings, pen=None, fill=pen.color)
                replaced[first] = area
                replaced.update(dict.fromkeys(others))
    return [mark for k, old in enumerate(marks) if (mark := replaced.get(k, old)) is not None]


def hatchings(marks: Sequence[Mark]) -> dict[Key, list[int]]:
    """Collect straight lines of one pen and one direction: indices of marks."""
    found: defaultdict[Key, list[int]] = defaultdict(list)
    for k, mark in enumerate(marks):
        if mark.fill is None and mark.pen is not None and mark.pen.width > 0.0 and len(mark.outlines) == 1:
            points = mark.outlines[0].vertices
            if len(points) == 2 and not mark.pen.dashed:
                (x, y), (end_x, end_y) = points.tolist()
                angle = math.degrees(math.atan2(end_y - y, end_x - x))
                found[mark.pen, round(angle) % 180].append(k)
    return found


def directed(lines: Array) -> Array:
    """Turn lines (n, 2, 2) of one direction around where they run against the first."""
    steps = lines[:, 1] - lines[:, 0]
    return np.where((steps @ steps[0] < 0.0)[:, None, None], lines[:, ::-1], lines)


def covered_areas(lines: Array, width: float) -> Iterator[tuple[list[int], tuple[Polyline, ...]]]:
    """Yield areas that lines (n, 2, 2) of a width cover: which lines, and the rings around them."""
    members = [chain for chain in chains_of(lines, NEAR * width) if len(chain) >= FEWEST_IN_A_STRIP]
    strips = shapely.buffer(
        [shapely.Polygon(np.vstack([lines[chain, 0], lines[chain[::-1], 1]])) for chain in members],
        width,
        join_style="mitre",
    )
    joined = shapely.buffer(shapely.union_all(strips), -width / 2.0, join_style="mitre")
    parts = shapely.get_parts(joined)
    wide = parts[~shapely.is_empty(shapely.buffer(parts, -LEAST_WIDTH * width / 2.0))]
    if not len(wide):
        return
    strip, part = shapely.STRtree(wide).query(shapely.point_on_surface(strips), predicate="intersects")
    for k, area in enumerate(wide):
        covered = [line for chain in strip[part == k] for line in members[chain]]
        rings = tuple(outlines_of_area(shapely.simplify(area, DETAIL * width)))
        if covered and rings:
            yield covered, rings


def chains_of(lines: Array, reach: float) -> list[Array]:
    """Link lines (n, 2, 2) whose ends are near each other: the indices of each chain, side by side."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    pairs = cKDTree(lines.reshape(-1, 4)).query_pairs(reach, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(lines), len(lines)))
    _, labels = connected_components(links, directed=False)
    along = (lines[:, 1] - lines[:, 0]).mean(axis=0)
    offsets = lines.mean(axis=1) @ (along[::-1] * (-1.0, 1.0))
    order = np.lexsort((offsets, labels))
    return np.split(order, np.flatnonzero(np.diff(labels[order])) + 1)
