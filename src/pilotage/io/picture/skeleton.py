"""Trace the middle of pen strokes in a picture as polylines."""

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


def trace_runs(ink: Mask) -> tuple[list[Array], float]:
    """Thin ink to its middle and follow it from fork to fork.

    Returns the pixels of each run (n, 2) as x and y, y down, and the mean width of the pen [pixels].
    """
    from skimage.morphology import skeletonize

    middle = skeletonize(ink)
    if not middle.any():
        return [], 1.0
    pen_width = float(np.count_nonzero(ink)) / float(np.count_nonzero(middle))
    rows, columns = np.nonzero(middle)
    points = np.column_stack([columns + 0.5, rows + 0.5])
    graph = neighbor_graph(middle)
    remove_spurs(graph, SPUR * pen_width)
    return [points[run] for run in follow(graph)], pen_width


def straightened(runs: list[Array], pen_width: float) -> list[Array]:
    """Draw runs of pixels with as few vertices as the width of the pen allows, (n, 2) each."""
    if not runs:
        return []
    lines = [shapely.LineString(run) for run in runs]
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


def remove_spurs(graph: rustworkx.PyGraph, shortest: float) -> None:
    """Take away the pixels of side branches that are shorter than this."""
    for run in follow(graph):
        first, last = sorted((run[0], run[-1]), key=graph.degree)
        if len(run) - 1 < shortest and graph.degree(first) == 1 and graph.degree(last) > 2:
            graph.remove_nodes_from([node for node in run if node != last])


def follow(graph: rustworkx.PyGraph) -> list[list[int]]:
    """Cut a graph of pixels into runs between ends and forks; a ring is a run, too."""
    degree = {node: graph.degree(node) for node in graph.node_indices()}
    walked: set[int] = set()  # inner pixels of runs
    begun: set[tuple[int, int]] = set()  # first steps of runs, seen from either end
    runs = []
    for start in sorted(degree, key=lambda node: degree[node] == 2):  # a ring has no end to begin at
        for following in sorted(graph.neighbors(start)):
            if start in walked or following in walked or (start, following) in begun:
                continue
            run = run_from(graph, degree, start, following)
            walked.update(run[1:-1])
            begun.update({(run[0], run[1]), (run[-1], run[-2])})
            runs.append(run)
    return runs


def run_from(graph: rustworkx.PyGraph, degree: dict[int, int], start: int, following: int) -> list[int]:
    """Go on from a first step to the next end or fork, or around to the start."""
    run = [start, following]
    while degree[run[-1]] == 2 and run[-1] != start:
        run.append(next(node for node in graph.neighbors(run[-1]) if node != run[-2]))
    return run
