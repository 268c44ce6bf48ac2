"""Suggest where a door could be cut into a room that has none."""

from itertools import pairwise

import numpy as np
import shapely

from pilotage.findings.finding import Mend, MendKind
from pilotage.geometry import Array
from pilotage.maps import CellGraph

WALLS = (0.004, 0.01, 0.02, 0.04)
"""Thicknesses of walls that are tried, as shares of the drawing's diameter."""

DOOR = 0.03
"""Width of a door as a share of the drawing's diameter, where there is none to compare with."""

MOST_OF_WALL = 0.6
"""A door takes at most this share of a straight wall."""


def door_width(graph: CellGraph) -> float:
    """Return the usual width of a door [drawing units]: the median of all gateways, if there are any."""
    widths = [gateway.width for gateway in graph.gateways]
    return float(np.median(widths)) if widths else DOOR * graph.diameter


def suggest_door(room: shapely.Polygon, others: list[shapely.Polygon], graph: CellGraph) -> Mend | None:
    """Cut a door in the middle of the longest straight wall between a room and another one.

    Returns None if no other room is near.
    """
    for thickness in np.array(WALLS) * graph.diameter:
        near = shapely.buffer(others, thickness, join_style="mitre")
        shared = shapely.intersection(room.exterior, near)  # each alone: a door leads to one room
        sides = np.concatenate([np.empty((0, 2, 2)), *map(straight_sides, shared)])
        if len(sides):
            lengths = np.hypot(*(sides[:, 1] - sides[:, 0]).T)
            side, length = sides[lengths.argmax()], float(lengths.max())
            return cut(side, min(door_width(graph), MOST_OF_WALL * length))
    return None


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
