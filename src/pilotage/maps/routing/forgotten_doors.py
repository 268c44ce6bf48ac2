"""Doors that a drawing forgets: where it falls into parts, one may lead through any wall between them.

Many plans and sketches show rooms as closed boxes. A robot that is to go from one part to another tries the
walls between them. Such a gateway costs so much that a route through drawn ones is always preferred.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely

from pilotage.geometry import Array
from pilotage.maps.cells.graph import Cell, CellGraph, Gateway
from pilotage.maps.routing.places import connected_cells

WALLS = (0.004, 0.01, 0.02, 0.04)
"""Thicknesses of walls that are tried, as shares of the drawing's diameter."""
DOOR = 0.03
"""Width of a door as a share of the drawing's diameter, where there is none to compare with."""
MOST_OF_WALL = 0.6
"""A door takes at most this share of a straight wall."""
LEAST_WALL = 0.8
"""A wall that is shorter has no door, as a share of the usual door's width."""
OVERLAP = 0.01
"""Share of its own area by which a door may reach into other cells: it is to join two."""


@dataclass(frozen=True, eq=False)
class ForgottenDoor:
    """A door that nobody drew: somewhere in a wall, and in the middle of it for want of anything better."""

    segment: Array  # (2, 2) in the outline of one room, which lies on its left [drawing units]
    opening: shapely.Polygon  # what it cuts out of the wall
    leeway: Array  # (2,) how far it may lie to either side [drawing units]


@dataclass(frozen=True, eq=False)
class JoinedGraph:
    """A cell graph whose parts are joined by doors that nobody drew."""

    graph: CellGraph
    doors: tuple[ForgottenDoor, ...] = ()


def join_parts(graph: CellGraph) -> JoinedGraph:
    """Add a gateway between any two neighbors of different parts, in the middle of their longest wall.

    A cell reaches through the wall up to such a gateway. A graph in one part stays as it is.
    """
    rooms = {cell.cell_id: cell.polygon for cell in graph.cells}
    gateways: list[Gateway] = []
    doors: list[ForgottenDoor] = []
    for first, second in neighbors_apart(graph):
        door = find_door(first.polygon, second.polygon, graph)
        if door is None or reaches_others(door, (first, second), graph):
            continue
        widened = shapely.union(rooms[second.cell_id], shapely.difference(door.opening, first.polygon))
        if widened.geom_type == "Polygon":
            rooms[second.cell_id] = widened
            name = f"forgotten{len(gateways) + 1}"
            gateways.append(Gateway(name, door.segment, (first.cell_id, second.cell_id), is_drawn=False))
            doors.append(door)
    if not gateways:
        return JoinedGraph(graph)
    cells = tuple(reshaped(cell, rooms[cell.cell_id]) for cell in graph.cells)
    return JoinedGraph(CellGraph(cells, (*graph.gateways, *gateways), graph.diameter), tuple(doors))


def neighbors_apart(graph: CellGraph) -> Iterator[tuple[Cell, Cell]]:
    """Go through neighbors that no drawn way joins, the smaller cell of two first."""
    parts = connected_cells(graph)
    part_of = {cell_id: number for number, part in enumerate(parts) for cell_id in part}
    near = graph.tree.query(graph.tree.geometries, predicate="dwithin", distance=WALLS[-1] * graph.diameter)
    for pair in near.T.tolist():
        first, second = sorted((graph.cells[k] for k in pair), key=lambda cell: cell.polygon.area)
        if pair[0] < pair[1] and part_of[first.cell_id] != part_of[second.cell_id]:
            yield first, second


def reaches_others(door: ForgottenDoor, cells: tuple[Cell, Cell], graph: CellGraph) -> bool:
    """Tell whether a door between two cells reaches into others: then these lie between."""
    met = [graph.cells[k] for k in graph.tree.query(door.opening).tolist()]
    others = [cell.polygon for cell in met if cell not in cells]
    return bool(shapely.area(shapely.intersection(others, door.opening)).sum() > OVERLAP * door.opening.area)


def find_door(room: shapely.Polygon, other: shapely.Polygon, graph: CellGraph) -> ForgottenDoor | None:
    """Find where a door from a room to another would be: in the middle of their longest common wall.

    Returns None if they have no wall in common.
    """
    usual = door_width(graph)
    for thickness in np.array(WALLS) * graph.diameter:
        sides = common_sides(room, [other], thickness)
        lengths = np.hypot(*(sides[:, 1] - sides[:, 0]).T)
        if len(sides) == 0 or lengths.max() < LEAST_WALL * usual:
            continue
        side, length = sides[lengths.argmax()], float(lengths.max())
        width = min(usual, MOST_OF_WALL * length)
        segment, along = middle_of(side, width), (side[1] - side[0]) / length
        right = np.array([along[1], -along[0]])
        seam = 0.5 * WALLS[0] * graph.diameter
        if room.covers(shapely.Point(segment.mean(axis=0) + seam * right)):
            segment, right = segment[::-1], -right
        near, far = segment - seam * right, segment + (thickness + seam) * right
        opening = shapely.Polygon([near[0], near[1], far[1], far[0]])
        return ForgottenDoor(segment, opening, 0.5 * (length - width) * along)
    return None


def common_sides(room: shapely.Polygon, others: list[shapely.Polygon], thickness: float) -> Array:
    """List the straight walls of this thickness that a room has in common with others, (n, 2, 2)."""
    near = shapely.buffer(others, thickness, join_style="mitre")
    shared = shapely.intersection(room.exterior, near)  # each alone: a door leads to one room
    return np.concatenate([np.empty((0, 2, 2)), *map(straight_sides, shared)])


def straight_sides(lines: shapely.Geometry) -> Array:
    """List the segments of some lines, (n, 2, 2); collinear ones are joined, and points dropped."""
    kept = [part for part in shapely.get_parts(lines) if shapely.length(part) > 0.0]
    merged = shapely.simplify(shapely.line_merge(shapely.union_all(kept)), 1e-9)
    sides = []
    for line in shapely.get_parts(merged):
        points = shapely.get_coordinates(line)
        sides += [np.stack([a, b]) for a, b in pairwise(points)]
    return np.array(sides).reshape(-1, 2, 2)


def middle_of(side: Array, width: float) -> Array:
    """Return the middle of a side (2, 2), this wide, (2, 2)."""
    middle = side.mean(axis=0)
    half = (side[1] - side[0]) / np.hypot(*(side[1] - side[0])) * width / 2.0
    return np.array([middle - half, middle + half])


def door_width(graph: CellGraph) -> float:
    """Return the usual width of a door [drawing units]: the median of all gateways, if there are any."""
    widths = [gateway.width for gateway in graph.gateways]
    return float(np.median(widths)) if widths else DOOR * graph.diameter


def reshaped(cell: Cell, polygon: shapely.Polygon) -> Cell:
    """Give a cell another outline."""
    if polygon is cell.polygon:
        return cell
    oriented = shapely.orient_polygons(polygon)
    rings = [shapely.get_coordinates(ring)[:-1] for ring in (oriented.exterior, *oriented.interiors)]
    return replace(cell, outline=rings[0], holes=tuple(rings[1:]))
