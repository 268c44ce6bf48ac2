"""Trace the middle of pen strokes in a picture as polylines."""

from itertools import pairwise

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array

Mask = NDArray[np.bool_]

STRAIGHTNESS = 0.35
"""How far a traced line may stray from the middle of the ink, in mean widths of the pen."""

SPUR = 1.5
"""Side branches shorter than this many widths of the pen are the raggedness of its edge, not strokes."""

NEIGHBORS = ((0, 1), (1, 0), (1, 1), (1, -1))
"""Half of the eight neighbors of a pixel, as row and column."""


def trace_lines(ink: Mask) -> list[Array]:
    """Thin ink to its middle and follow it: polylines (n, 2) of x and y [pixels], y down, in order."""
    from skimage.morphology import skeletonize

    middle = skeletonize(ink)
    if not middle.any():
        return []
    pen_width = float(np.count_nonzero(ink)) / float(np.count_nonzero(middle))
    rows, columns = np.nonzero(middle)
    points = np.column_stack([columns + 0.5, rows + 0.5])
    paths = follow(neighbor_graph(middle), SPUR * pen_width)
    lines = [shapely.LineString(points[path]) for path in paths]
    straight = shapely.simplify(lines, max(STRAIGHTNESS * pen_width, 0.5))
    return [np.asarray(shapely.get_coordinates(line)) for line in straight]


def neighbor_graph(middle: Mask) -> rustworkx.PyGraph:
    """Join each pixel of a thinned picture to its neighbors; a diagonal only where no corner pixel joins."""
    number = np.full(np.add(middle.shape, 2), -1, dtype=np.int64)
    number[1:-1, 1:-1][middle] = np.arange(np.count_nonzero(middle))
    rows, columns = np.nonzero(number >= 0)
    graph = rustworkx.PyGraph(multigraph=False)
    graph.add_nodes_from(range(len(rows)))
    for down, right in NEIGHBORS:
        other = number[rows + down, columns + right]
        joined = other >= 0
        if down and right:
            joined &= (number[rows + down, columns] < 0) & (number[rows, columns + right] < 0)
        pairs = np.column_stack([number[rows, columns][joined], other[joined]])
        graph.add_edges_from_no_data([(int(a), int(b)) for a, b in pairs])
    return graph


def follow(graph: rustworkx.PyGraph, spur: float) -> list[list[int]]:
    """Cut a graph of pixels into runs between ends and forks, spurs left out."""
    nodes = graph.node_indices()
    degree = {node: graph.degree(node) for node in nodes}
    used: set[tuple[int, int]] = set()
    paths = []
    forks_first = sorted(nodes, key=lambda node: degree[node] == 2)  # a ring without a fork begins anywhere
    for start in forks_first:
        for following in sorted(graph.neighbors(start)):
            if (start, following) in used:
                continue
            path = [start, following]
            while degree[path[-1]] == 2 and path[-1] != start:
                onward = [node for node in graph.neighbors(path[-1]) if node != path[-2]]
                path.append(onward[0])
            used.update({(path[0], path[1]), (path[-1], path[-2])})
            is_spur = len(path) - 1 < spur and {degree[path[0]], degree[path[-1]]} & {1} != set()
            if not (is_spur and max(degree[path[0]], degree[path[-1]]) > 2):
                paths.append(path)
        if degree[start] == 2:
            mark_ring(paths[-1] if paths else [], used)
    return paths


def mark_ring(path: list[int], used: set[tuple[int, int]]) -> None:
    """Note all steps of a closed run, so that it is not followed again from another pixel."""
    for first, second in pairwise(path):
        used.update({(first, second), (second, first)})
