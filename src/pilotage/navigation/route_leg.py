"""The next waypoint of the route: behind a gateway, around a bend, or the goal (Wolter 2001, 4.2)."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.geometry import Affine2, Array
from pilotage.maps import CellGraph, Gateway, Roadmap, Route
from pilotage.maps.routing.roadmap import Point

PASSED = 0.4
"""Distance [m] at which a bend of the route counts as passed."""

BEYOND = (1.0, 0.7, 0.4, 0.2)
"""Distances [m] of a waypoint behind a gateway or around a bend: the first for which the cell has room."""


@dataclass(frozen=True, eq=False)
class RouteLeg:
    """The route from here, and its next waypoint."""

    route: Route
    path: Array  # (k >= 2, 2) in the robot's frame, from the robot to the goal [m]
    waypoint: Array  # (2,) in the robot's frame [m]: behind the next gateway or bend, or the goal
    gateway_id: str  # of the gateway that the point lies behind; empty for a bend or the goal
    middle: Array  # (2,) in the robot's frame [m]: the gateway's middle, the bend, or the goal

    @property
    def distance(self) -> float:
        """The length of the path to the goal [m]."""
        return float(np.hypot(*np.diff(self.path, axis=0).T).sum())

    @property
    def next_cell_id(self) -> str:
        """The cell to be entered next; empty in the goal's cell."""
        return self.route.cell_ids[1] if len(self.route.cell_ids) > 1 else ""


def next_waypoint(
    sketch_from_base: Affine2, roadmap: Roadmap, goal: Point, blocked: Collection[str] = ()
) -> RouteLeg:
    """Find the next waypoint from where the robot believes to be.

    Raises RouteError if no route to the goal avoids the `blocked` gateways.
    """
    graph = roadmap.graph
    base_from_sketch = sketch_from_base.inverse()
    x, y = sketch_from_base.translation.tolist()
    route = roadmap.find(inside(graph, (x, y)), inside(graph, goal), blocked)
    path = base_from_sketch @ route.way
    path[0] = 0.0
    index = next_stop(route, graph, path)
    gateway = gateway_at(route, graph, index)
    if gateway is None:
        onward = path[min(index + 1, len(path) - 1)] - path[index]
        length = float(np.hypot(*onward))
        point = path[index] + onward * (min(BEYOND[0], length) / length if length > 0.0 else 0.0)
        return RouteLeg(route, path, point, "", path[index])
    cell_id = cell_behind(route, gateway)
    behind = point_behind(gateway, graph, cell_id, sketch_from_base.scale)
    return RouteLeg(
        route,
        path,
        (base_from_sketch @ behind[np.newaxis])[0],
        gateway.gateway_id,
        (base_from_sketch @ gateway.middle[np.newaxis])[0],
    )


def next_stop(route: Route, graph: CellGraph, path: Array) -> int:
    """Return the first vertex of the path that is not passed: a gateway, a bend farther off, else the goal.

    A gateway is passed once the robot is in the cell behind it, and then the route does not hold it.
    """
    for index in range(1, len(path) - 1):
        is_near = float(np.hypot(*path[index])) <= PASSED
        if not is_near or gateway_at(route, graph, index) is not None:
            return index
    return len(path) - 1


def inside(graph: CellGraph, point: Point) -> Point:
    """Return the point itself if it lies in a cell, else the nearest point that does."""
    cell = graph.cell(graph.cell_at(point))
    place = shapely.Point(point)
    if cell.polygon.covers(place):
        return point
    core = cell.polygon.buffer(-1e-3 * np.sqrt(cell.polygon.area))
    nearest = shapely.shortest_line(core if not core.is_empty else cell.polygon, place)
    x, y = shapely.get_coordinates(nearest)[0]
    return float(x), float(y)


def gateway_at(route: Route, graph: CellGraph, index: int) -> Gateway | None:
    """Return the gateway at a vertex of the route, or None for a bend or the goal."""
    for gateway_id in route.gateway_ids:
        gateway = graph.gateway(gateway_id)
        if np.array_equal(gateway.middle, route.way[index]):
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
