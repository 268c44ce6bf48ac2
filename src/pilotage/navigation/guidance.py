"""Which way the drawing says: the next gateway, or the goal, as the robot would see it (Wolter 2001, 4.2)."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.geometry import Affine2, Array
from pilotage.maps import CellGraph, Gateway, Roads, Route
from pilotage.maps.route import Point

PASSED = 0.4
"""A bend of the way is passed once the robot is so near [m]."""

BEYOND = (1.0, 0.7, 0.4, 0.2)
"""How far behind a gateway, or around a bend, the robot heads [m]: as far as the drawing has room for."""


@dataclass(frozen=True, eq=False)
class Leg:
    """The route from here, and the next point of it to head for."""

    route: Route
    way: Array  # (k >= 2, 2) in the robot's frame, from the robot to the goal [m]
    point: Array  # (2,) in the robot's frame [m]: behind the next gateway or bend, or the goal
    gateway_id: str  # of the gateway that the point lies behind; empty for a bend or the goal
    middle: Array  # (2,) in the robot's frame [m]: the gateway's middle, the bend, or the goal

    @property
    def distance(self) -> float:
        """The length of the way [m]."""
        return float(np.hypot(*np.diff(self.way, axis=0).T).sum())

    @property
    def next_cell_id(self) -> str:
        """The cell to be entered next; empty in the goal's cell."""
        return self.route.cell_ids[1] if len(self.route.cell_ids) > 1 else ""


def lead(sketch_from_base: Affine2, roads: Roads, goal: Point, closed: Collection[str] = ()) -> Leg:
    """Find the next point to head for from where the robot is believed to be.

    Raises RouteError if no way leads to the goal through gateways that are not `closed`.
    """
    graph = roads.graph
    base_from_sketch = sketch_from_base.inverse()
    x, y = sketch_from_base.translation.tolist()
    route = roads.find(inside(graph, (x, y)), inside(graph, goal), closed)
    way = base_from_sketch @ route.way
    way = np.array(way)
    way[0] = 0.0
    away = np.hypot(way[:, 0], way[:, 1])
    ahead = np.flatnonzero(away[1:-1] > PASSED) + 1
    index = int(ahead[0]) if len(ahead) else len(way) - 1
    gateway = gateway_at(route, graph, index)
    if gateway is None:
        leg = way[min(index + 1, len(way) - 1)] - way[index]
        length = float(np.hypot(*leg))
        point = way[index] + leg * (min(BEYOND[0], length) / length if length > 0.0 else 0.0)
        return Leg(route, way, point, "", way[index])
    cell_id = cell_behind(route, gateway)
    behind = point_behind(gateway, graph, cell_id, sketch_from_base.scale)
    return Leg(
        route,
        way,
        (base_from_sketch @ behind[np.newaxis])[0],
        gateway.gateway_id,
        (base_from_sketch @ gateway.middle[np.newaxis])[0],
    )


def inside(graph: CellGraph, point: Point) -> Point:
    """Return the point itself if it lies in a cell, else the nearest that does."""
    cell = graph.cell(graph.cell_at(point))
    place = shapely.Point(point)
    if cell.polygon.covers(place):
        return point
    core = cell.polygon.buffer(-1e-3 * np.sqrt(cell.polygon.area))
    nearest = shapely.shortest_line(core if not core.is_empty else cell.polygon, place)
    x, y = shapely.get_coordinates(nearest)[0]
    return float(x), float(y)


def gateway_at(route: Route, graph: CellGraph, index: int) -> Gateway | None:
    """Return the gateway that a vertex of the way is the middle of, or None for a bend or the goal."""
    for gateway_id in route.gateway_ids:
        gateway = graph.gateway(gateway_id)
        if np.allclose(gateway.middle, route.way[index]):
            return gateway
    return None


def cell_behind(route: Route, gateway: Gateway) -> str:
    """Name the cell that the route enters through a gateway."""
    return route.cell_ids[route.gateway_ids.index(gateway.gateway_id) + 1]


def point_behind(gateway: Gateway, graph: CellGraph, cell_id: str, scale: float) -> Array:
    """Find a point straight behind a gateway, in the cell that it leads to, (2,) [drawing units]."""
    along = gateway.segment[1] - gateway.segment[0]
    left = np.array([-along[1], along[0]]) / gateway.width  # where the first cell lies
    normal = left if cell_id == gateway.cell_ids[0] else -left
    polygon = graph.cell(cell_id).polygon
    for depth in BEYOND:
        point = gateway.middle + depth * scale * normal
        if polygon.covers(shapely.LineString([gateway.middle + 0.1 * depth * scale * normal, point])):
            return np.asarray(point)
    return np.asarray(gateway.middle + BEYOND[-1] * scale * normal)
