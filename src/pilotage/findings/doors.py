"""Tell whether doors join rooms, and where one could be cut into a room that has none."""

from itertools import pairwise

import numpy as np
import shapely

from pilotage.findings.finding import Mend, MendKind
from pilotage.geometry import Array
from pilotage.maps import CellGraph
from pilotage.maps.routing.places import connected_cells

WALLS = (0.004, 0.01, 0.02, 0.04)
"""Thicknesses of walls that are tried, as shares of the drawing's diameter."""

DOOR = 0.03
"""Width of a door as a share of the drawing's diameter, where there is none to compare with."""

MOST_OF_WALL = 0.6
"""A door takes at most this share of a straight wall."""

NEAR = 1.5
"""A door that is drawn this near to a wall may lead through it, as a share of the usual door's width."""

NAMED = 3
"""Where so many rooms have a name, doors lead to these."""

NOWHERE = np.empty((0, 2))


def door_width(graph: CellGraph) -> float:
    """Return the usual width of a door [drawing units]: the median of all gateways, if there are any."""
    widths = [gateway.width for gateway in graph.gateways]
    return float(np.median(widths)) if widths else DOOR * graph.diameter


def has_doors(graph: CellGraph) -> bool:
    """Tell whether doors join rooms: where several have a name, two of these.

    A corridor without doors falls into pieces, and so does the space that boxes leave between them.
    """
    names = {cell.cell_id for cell in graph.cells if cell.label}
    parts = connected_cells(graph)
    if len(names) < NAMED or 2 * max(map(len, parts)) >= len(graph.cells):
        return bool(graph.gateways)
    return any(len(names & part) > 1 for part in parts)


def suggest_door(
    room: shapely.Polygon, others: list[shapely.Polygon], graph: CellGraph, drawn: Array = NOWHERE
) -> Mend | None:
    """Cut a door where one is drawn (n, 2), else in the middle of the longest straight wall to another room.

    Returns None if no other room is near.
    """
    for thickness in np.array(WALLS) * graph.diameter:
        near = shapely.buffer(others, thickness, join_style="mitre")
        shared = shapely.intersection(room.exterior, near)  # each alone: a door leads to one room
        sides = np.concatenate([np.empty((0, 2, 2)), *map(straight_sides, shared)])
        if len(sides):
            lengths = np.hypot(*(sides[:, 1] - sides[:, 0]).T)
            width = door_width(graph)
            side = nearest_side(sides[lengths >= width], drawn, width)
            side = sides[lengths.argmax()] if side is None else side
            return cut(side, min(width, MOST_OF_WALL * float(np.hypot(*(side[1] - side[0])))))
    return None


def nearest_side(sides: Array, drawn: Array, width: float) -> Array | None:
    """Find the piece of a side (n, 2, 2), nearest to a drawn door; None if none is near."""
    lines = shapely.linestrings(sides)
    if len(lines) == 0 or len(drawn) == 0:
        return None
    marks, found = shapely.points(drawn), shapely.STRtree(lines)
    (mark, line), distance = found.query_nearest(marks, max_distance=NEAR * width, return_distance=True)
    if len(mark) == 0:
        return None
    k = int(distance.argmin())
    side = lines[line[k]]
    half = min(width / MOST_OF_WALL, side.length) / 2.0
    along = min(max(float(side.project(marks[mark[k]])), half), side.length - half)
    return np.array([side.interpolate(along - half).coords[0], side.interpolate(along + half).coords[0]])


def straight_sides(lines: shapely.Geometry) -> Array:
    """List the segments of some lines, (n, 2, 2); collinear ones are joined, and points dropped."""
    kept = [part for part in shapely.get_parts(lines) if shapely.length(part) > 0.0]
    merged = shapely.simplify(shapely.line_merge(shapely.union_all(kept)), 1e-9)
    sides = []
    for line in shapely.get_parts(merged):
        points = shapely.get_coordinates(line)
        sides += [np.stack([a, b]) for a, b in pairwise(points)]
    return np.array(sides).reshape(-1, 2, 2)


def cut(side: Array, width: float) -> Mend:
    """Cut a door of this width in the middle of a side (2, 2)."""
    middle = side.mean(axis=0)
    half = (side[1] - side[0]) / np.hypot(*(side[1] - side[0])) * width / 2.0
    (ax, ay), (bx, by) = (middle - half).tolist(), (middle + half).tolist()
    return Mend(MendKind.CUT, ((ax, ay), (bx, by)), "cut a door here?")
