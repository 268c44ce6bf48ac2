"""Find routes through the cell graph (Wolter 2001, section 4.2)."""

from collections.abc import Collection
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import rustworkx
import shapely

from pilotage.geometry import Array
from pilotage.maps.cells.graph import CellGraph, Gateway
from pilotage.maps.routing.route import Point, Route, RouteError, RouteSettings
from pilotage.maps.routing.walking import find_sights, jutting_corners, room_of


def find_route(
    graph: CellGraph, start: Point, goal: Point, settings: RouteSettings, closed: Collection[str] = ()
) -> Route:
    """Find the cheapest route between two points [drawing units], not through `closed` gateways.

    Inside a cell the way is the shortest one. Raises RouteError if none leads from start to goal. Who asks
    again and again keeps the `Roads`.
    """
    return Roads(graph, settings).find(start, goal, closed)


@dataclass(frozen=True, slots=True)
class Leg:
    """From stop to stop: a walk in a cell, or the step through a gateway."""

    cost: float
    gateway_id: str = ""


class Roads:
    """Corners and both faces of every gateway, joined where one sees the other: all that no start changes."""

    def __init__(self, graph: CellGraph, settings: RouteSettings) -> None:
        self.graph, self.settings = graph, settings
        self._legs = rustworkx.PyGraph()
        self._points: list[Array] = []
        self._faces: dict[str, tuple[int, int]] = {}
        self._stops: dict[str, list[int]] = {cell.cell_id: [] for cell in graph.cells}
        self._rooms: dict[str, shapely.Polygon] = {cell.cell_id: room_of(cell) for cell in graph.cells}
        for gateway in graph.gateways:
            self._add_gateway(gateway)
        for cell in graph.cells:
            self._stops[cell.cell_id] += [self._add_stop(corner) for corner in jutting_corners(cell)]
            self._add_walks(cell.cell_id)

    def find(self, start: Point, goal: Point, closed: Collection[str] = ()) -> Route:
        """Find the cheapest route between two points [drawing units]; raises RouteError if there is none."""
        legs = self._open_legs(closed)
        ends = [np.array(end, dtype=np.float64) for end in (start, goal)]
        points = [*self._points, *ends]
        cell_ids = [self.graph.cell_at(start), self.graph.cell_at(goal)]
        first, last = (int(stop) for stop in legs.add_nodes_from([None, None]))
        legs.add_edges_from(self._walks_from(first, ends[0], cell_ids[0], points, self._stops[cell_ids[0]]))
        beside = [*self._stops[cell_ids[1]], *([first] if cell_ids[0] == cell_ids[1] else [])]
        legs.add_edges_from(self._walks_from(last, ends[1], cell_ids[1], points, beside))
        found = rustworkx.dijkstra_shortest_paths(legs, first, target=last, weight_fn=lambda leg: leg.cost)
        if last not in found:
            raise RouteError(
                f"no way leads from cell {cell_ids[0]} to cell {cell_ids[1]}: no gateways join them"
            )
        stops = list(found[last])
        return self._route(
            cell_ids[0],
            [legs.get_edge_data(a, b) for a, b in pairwise(stops)],
            np.array([points[stop] for stop in stops]),
        )

    def exits_to(self, goal: Point, closed: Collection[str] = ()) -> dict[str, list[tuple[Array, float]]]:
        """List, by cell, the stops on ways to the goal, and what is left from each; the goal is one itself.

        A stop is a point (2,), and what is left a cost as in `Route`. A cell without a way there has none.
        """
        legs, goal_id = self._open_legs(closed), self.graph.cell_at(goal)
        end = np.array(goal, dtype=np.float64)
        last = int(legs.add_node(None))
        legs.add_edges_from(self._walks_from(last, end, goal_id, [*self._points, end], self._stops[goal_id]))
        left = rustworkx.dijkstra_shortest_path_lengths(legs, last, edge_cost_fn=lambda leg: leg.cost)
        exits = {
            cell_id: [(self._points[stop], left[stop]) for stop in stops if stop in left]
            for cell_id, stops in self._stops.items()
        }
        exits[goal_id].append((end, 0.0))
        return exits

    def _open_legs(self, closed: Collection[str]) -> rustworkx.PyGraph:
        """Copy the legs, without the steps through `closed` gateways."""
        legs = self._legs.copy()
        legs.remove_edges_from([self._faces[gateway_id] for gateway_id in closed])
        return legs

    def _route(self, cell_id: str, legs: list[Leg], way: Array) -> Route:
        """Sum up legs from a cell on, and the stops between them (n, 2)."""
        gateway_ids = tuple(leg.gateway_id for leg in legs if leg.gateway_id)
        cell_ids = [cell_id]
        for gateway_id in gateway_ids:
            first, second = self.graph.gateway(gateway_id).cell_ids
            cell_ids.append(second if cell_ids[-1] == first else first)
        moved = np.append(True, (way[1:] != way[:-1]).any(axis=1))
        moved[-1] = True
        way = way[moved] if moved.sum() > 1 else np.stack([way[0], way[-1]])
        return Route(tuple(cell_ids), gateway_ids, sum(leg.cost for leg in legs), way)

    def _add_stop(self, point: Array) -> int:
        """Add a place where a way may bend."""
        self._points.append(point)
        return int(self._legs.add_node(None))

    def _add_gateway(self, gateway: Gateway) -> None:
        """Add both faces of a gateway, and the step from one to the other."""
        faces = self._add_stop(gateway.middle), self._add_stop(gateway.middle)
        cost = self.settings.passing(gateway.width / self.graph.diameter)
        self._legs.add_edge(*faces, Leg(cost, gateway.gateway_id))
        self._faces[gateway.gateway_id] = faces
        for cell_id, stop in zip(gateway.cell_ids, faces, strict=True):
            self._stops[cell_id].append(stop)

    def _add_walks(self, cell_id: str) -> None:
        """Join the stops of a cell where one sees the other."""
        stops = self._stops[cell_id]
        for k in range(1, len(stops)):
            here = self._points[stops[k]]
            self._legs.add_edges_from(self._walks_from(stops[k], here, cell_id, self._points, stops[:k]))

    def _walks_from(
        self, stop: int, here: Array, cell_id: str, points: list[Array], others: list[int]
    ) -> list[tuple[int, int, Leg]]:
        """List the walks inside a cell from a stop to those of the others that it sees."""
        if not others:
            return []
        there = np.array([points[other] for other in others])
        price = self.settings.walking(self.graph.cell(cell_id).size) / self.graph.diameter
        costs = price * np.hypot(*(there - here).T)
        sees = find_sights(self._rooms[cell_id], here, there)
        return [(stop, others[k], Leg(float(costs[k]))) for k in np.flatnonzero(sees).tolist()]
