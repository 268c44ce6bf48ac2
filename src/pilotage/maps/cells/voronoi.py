"""The Voronoi diagram of the walls (Wolter 2001, section 4.1).

Its builder fails on segments that cross, and never sees any: they are cut on an integer grid before.
"""

import math
from dataclasses import dataclass

import numpy as np
import pyvoronoi
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array

GRID_STEPS = 2**26
"""Steps of the grid across the drawing: exact for any drawing, and well within 32-bit integers."""

RETRIES = 5
"""How often to turn the segments and try again before giving up."""

TURN = math.radians(0.7)
"""By how much to turn them [rad]: no drawing repeats itself at this angle."""

START_POINT, END_POINT = 1, 2
"""Boost's source categories of a Voronoi cell that belongs to an end of a segment."""


@dataclass(frozen=True, eq=False)
class VoronoiDiagram:
    """Vertices, and the edges between two sites that do not touch.

    A site is a segment, or one of its ends; for an end both points of `sites` are the same, and exactly those
    of `segments`.
    """

    segments: Array  # (n, 4) as they were built from: on the grid, cut where they crossed
    vertices: Array  # (m, 2) [units of the segments]
    clearances: Array  # (m,) distance from each vertex to the nearest segment
    edges: NDArray[np.int64]  # (k, 2) first and last vertex of each finite edge
    sites: Array  # (k, 2, 4) the sites left and right of each edge as x1, y1, x2, y2


def snap(segments: Array, step: float) -> Array:
    """Move all ends to a grid and cut segments where they cross: (n, 4) to (m, 4), none of length 0."""
    lines = shapely.linestrings(segments.reshape(-1, 2, 2))
    noded = shapely.union_all(lines, grid_size=step)
    coordinates = [shapely.get_coordinates(part) for part in shapely.get_parts(noded)]
    cut = [np.hstack([points[:-1], points[1:]]) for points in coordinates if len(points) > 1]
    return np.vstack(cut) if cut else np.empty((0, 4))


def are_planar(segments: Array) -> bool:
    """Tell whether segments meet at their ends only."""
    lines = shapely.linestrings(segments.reshape(-1, 2, 2))
    first, second = shapely.STRtree(lines).query(lines, predicate="intersects")
    once = first < second
    meets = shapely.relate_pattern(lines[first[once]], lines[second[once]], "FF*F*****")
    return bool(meets.all())


def find_voronoi(segments: Array) -> VoronoiDiagram:
    """Build the Voronoi diagram of segments (n, 4); where they cross, they are cut first.

    Raises ValueError if there are none, or if no grid makes them meet at their ends only.
    """
    if len(segments) == 0:
        raise ValueError("segments must hold at least one segment, got none")
    points = segments.reshape(-1, 2)
    center = (points.min(axis=0) + points.max(axis=0)) / 2.0
    extent = float(np.abs(points - center).max())
    if extent == 0.0:
        raise ValueError("segments must span more than one point")
    step = 2.0 * extent / GRID_STEPS
    for turns in range(RETRIES):
        c, s = math.cos(turns * TURN), math.sin(turns * TURN)
        turned_from_drawn = np.array([[c, -s], [s, c]])
        turned = ((points - center) / step) @ turned_from_drawn.T
        on_grid = snap(turned.reshape(-1, 4), 1.0)
        if are_planar(on_grid):
            diagram = build(on_grid)
            return carried(diagram, turned_from_drawn.T, center, step)
    raise ValueError(f"segments must meet at their ends only once snapped to a grid of {step}")


def build(segments: Array) -> VoronoiDiagram:
    """Build the diagram of segments on the integer grid that meet at their ends only."""
    builder = pyvoronoi.Pyvoronoi(1)
    for x1, y1, x2, y2 in segments.astype(np.int64).tolist():
        builder.AddSegment([[x1, y1], [x2, y2]])
    builder.Construct()
    vertices = np.array([(v.X, v.Y) for v in builder.GetVertices()], dtype=np.float64).reshape(-1, 2)
    site_of_cell = np.array([(c.site, c.source_category) for c in builder.GetCells()], dtype=np.int64)
    half_edges = [(e.start, e.end, e.cell, e.twin, e.is_primary) for e in builder.GetEdges()]
    table = np.array(half_edges, dtype=np.int64).reshape(-1, 5)
    start, end, cell, twin, primary = table.T
    chosen = (primary == 1) & (np.arange(len(table)) < twin) & (start >= 0) & (end >= 0)
    left = site_geometry(segments, site_of_cell[cell[chosen]])
    right = site_geometry(segments, site_of_cell[cell[twin[chosen]]])
    edges = np.column_stack([start[chosen], end[chosen]])
    clearances = np.full(len(vertices), np.inf)
    for column in (0, 1):
        reach = distances(vertices[edges[:, column]], left)
        np.minimum.at(clearances, edges[:, column], reach)
    return VoronoiDiagram(segments, vertices, clearances, edges, np.stack([left, right], axis=1))


def site_geometry(segments: Array, sites: NDArray[np.int64]) -> Array:
    """Write each site (k, 2: segment and category) as x1, y1, x2, y2; an end twice."""
    chosen = segments[sites[:, 0]].copy()
    is_start, is_end = sites[:, 1] == START_POINT, sites[:, 1] == END_POINT
    chosen[is_start, 2:] = chosen[is_start, :2]
    chosen[is_end, :2] = chosen[is_end, 2:]
    return chosen


def feet(points: Array, segments: Array) -> Array:
    """Find the point of each segment (k, 4) that is nearest to the point (k, 2) of the same row."""
    first, along = segments[:, :2], segments[:, 2:] - segments[:, :2]
    square = np.einsum("ij,ij->i", along, along)
    share = np.einsum("ij,ij->i", points - first, along) / np.where(square > 0.0, square, 1.0)
    return np.asarray(first + np.clip(share, 0.0, 1.0)[:, None] * along)


def distances(points: Array, segments: Array) -> Array:
    """Measure from each point (k, 2) to the segment (k, 4) of the same row."""
    gaps = points - feet(points, segments)
    return np.asarray(np.hypot(gaps[:, 0], gaps[:, 1]))


def carried(diagram: VoronoiDiagram, rotation: Array, center: Array, step: float) -> VoronoiDiagram:
    """Carry a diagram from the turned grid back to the drawing."""

    def drawn_from_grid(points: Array) -> Array:
        x, y = points.reshape(-1, 2).T
        (a, b), (c, d) = rotation
        drawn = np.column_stack([a * x + b * y, c * x + d * y]) * step + center
        return np.asarray(drawn.reshape(points.shape))

    return VoronoiDiagram(
        drawn_from_grid(diagram.segments),
        drawn_from_grid(diagram.vertices),
        diagram.clearances * step,
        diagram.edges,
        drawn_from_grid(diagram.sites),
    )
