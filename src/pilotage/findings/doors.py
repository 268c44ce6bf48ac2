"""Tell whether doors join rooms, and where one could be cut into a room that has none."""

import numpy as np
import shapely

from pilotage.findings.finding import Mend, MendKind
from pilotage.geometry import Array
from pilotage.maps import CellGraph
from pilotage.maps.routing.forgotten_doors import (
    MOST_OF_WALL,
    WALLS,
    common_sides,
    door_width,
    middle_of,
)
from pilotage.maps.routing.places import connected_cells

NEAR = 1.5
"""A door that is drawn this near to a wall may lead through it, as a share of the usual door's width."""

NAMED = 3
"""Where so many rooms have a name, doors lead to these."""

NOWHERE = np.empty((0, 2))


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
        sides = common_sides(room, others, thickness)
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


def cut(side: Array, width: float) -> Mend:
    """Cut a door of this width in the middle of a side (2, 2)."""
    (ax, ay), (bx, by) = middle_of(side, width).tolist()
    return Mend(MendKind.CUT, ((ax, ay), (bx, by)), "cut a door here?")
