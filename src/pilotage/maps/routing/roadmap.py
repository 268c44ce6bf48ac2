"""The roadmap of a drawing and the cheapest routes on it (Wolter 2001, section 4.2).

The roadmap is a visibility graph. Its nodes are both faces of each gateway and the reflex vertices of the
cells, around which the shortest paths bend; its edges join nodes of a cell that see each other. Zones that a
person drew are kept: no edge enters a keep-out zone, and a one-way gateway has one edge.
"""

from collections.abc import Collection
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.errors import PilotageError
from pilotage.geometry import Array, frozen_points
from pilotage.maps.cells.graph import Cell, CellGraph, CellSize, Gateway
from pilotage.maps.zones import Zones

Point = tuple[float, float]

GRAZE = 2e-3
"""Share of its size by which a cell is widened for visibility tests: paths may touch corners and gateways."""

UNDRAWN = 0.5
"""Added cost of a gateway that is not drawn, a share of the diameter: for where no drawn ones lead."""

NO_ZONES = Zones()


class RouteError(PilotageError):
    """A place cannot be reached, or no path leads there."""


@dataclass(frozen=True, slots=True)
class RouteSettings:
    """What a route costs beside its length; all costs are shares of the drawing's diameter."""

    gateway: float = 0.03  # for passing one, as it may be closed: 1.5 m of path in a 50 m building
    narrowness: float = 0.0002  # divided by a gateway's width, a share too: 1 % for 1 m in a 50 m building
    small: float = 1.2  # factor for length in small cells, where there is less room to turn

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in self.__slots__:
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")

    def walking(self, size: CellSize) -> float:
        """Return the factor for length in a cell of this size."""
        return self.small if size is CellSize.SMALL else 1.0

    def passing(self, relative_width: float) -> float:
        """Return the cost of passing a gateway of this width, a share of the diameter."""
        return self.gateway + self.narrowness / relative_width


@dataclass(frozen=True, eq=False)
class Route:
    """Cell by cell from the start to the goal; one gateway fewer than cells."""

    cell_ids: tuple[str, ...]
    gateway_ids: tuple[str, ...]
    cost: float  # weighted length and gateways, as a share of the diameter
    way: Array  # (k >= 2, 2) from the start through the middles of the gateways to the goal [drawing units]

    def __post_init__(self) -> None:
        """Freeze the way, and reject a route that skips a cell or a gateway."""
        object.__setattr__(self, "way", frozen_points(self.way, name="way", at_least=2))
        cells, gateways = len(self.cell_ids), len(self.gateway_ids)
        if cells != gateways + 1:
            raise ValueError(f"a route needs one gateway fewer than cells, got {gateways} and {cells}")


def find_route(
    graph: CellGraph,
    start: Point,
    goal: Point,
    settings: RouteSettings,
    closed: Collection[str] = (),
    *,
    zones: Zones = NO_ZONES,
) -> Route:
    """Find the cheapest route between two points [drawing units], not through `closed` gateways.

    Inside a cell the path is the shortest one. Raises RouteError if none leads from start to goal. For many
    routes keep the `Roadmap`.
    """
    return Roadmap(graph, settings, zones).find(start, goal, closed)


@dataclass(frozen=True, slots=True)
class Edge:
    """From node to node: straight through a cell, or the step through a gateway."""

    cost: float
    gateway_id: str = ""


class Roadmap:
    """The visibility graph of all cells; start and goal of a route are joined to a copy of it."""

    def __init__(self, graph: CellGraph, settings: RouteSettings, zones: Zones = NO_ZONES) -> None:
        self.graph, self.settings, self.zones = graph, settings, zones
        self._net = rustworkx.PyDiGraph()
        self._points: list[Array] = []
        self._faces: dict[str, tuple[int, int]] = {}
        self._nodes: dict[str, list[int]] = {cell.cell_id: [] for cell in graph.cells}
        walkable = {cell.cell_id: self._walkable(cell) for cell in graph.cells}
        self._widened = {cell.cell_id: widened(cell, walkable[cell.cell_id]) for cell in graph.cells}
        for gateway in graph.gateways:
            self._add_gateway(gateway)
        for cell in graph.cells:
            corners = reflex_vertices(walkable[cell.cell_id])
            self._nodes[cell.cell_id] += [self._add_node(corner) for corner in corners]
            self._add_paths(cell.cell_id)

    def find(self, start: Point, goal: Point, closed: Collection[str] = ()) -> Route:
        """Find the cheapest route between two points [drawing units], not through `closed` gateways.

        Raises RouteError if there is none, and KeyError if a gateway is none of the graph.
        """
        check_allowed(self.zones, goal)
        net = self._open_net(closed)
        ends = [np.array(end, dtype=np.float64) for end in (start, goal)]
        points = [*self._points, *ends]
        cell_ids = [self.graph.cell_at(start), self.graph.cell_at(goal)]
        first, last = (int(node) for node in net.add_nodes_from([None, None]))
        begin = self._paths_from(first, ends[0], cell_ids[0], points, self._nodes[cell_ids[0]], leaves=True)
        net.add_edges_from(begin)
        beside = [*self._nodes[cell_ids[1]], *([first] if cell_ids[0] == cell_ids[1] else [])]
        net.add_edges_from(backwards(self._paths_from(last, ends[1], cell_ids[1], points, beside)))
        found = rustworkx.dijkstra_shortest_paths(net, first, target=last, weight_fn=lambda edge: edge.cost)
        if last not in found:
            is_barred = closed or self.zones.keep_out or self.zones.one_way
            why = "blocked gateways or zones are in the way" if is_barred else "no gateways join them"
            raise RouteError(f"no way leads from cell {cell_ids[0]} to cell {cell_ids[1]}: {why}")
        nodes = list(found[last])
        return self._route(
            cell_ids[0],
            [net.get_edge_data(a, b) for a, b in pairwise(nodes)],
            np.array([points[node] for node in nodes]),
        )

    def exits_to(self, goal: Point, closed: Collection[str] = ()) -> dict[str, list[tuple[Array, float]]]:
        """List, by cell, the nodes from which a path leads to the goal, each with the cost of that path.

        A node is a point (2,), and the goal is one; costs are shares of the diameter, as in `Route`. A cell
        without a path to the goal has no nodes.
        """
        net, goal_id = self._open_net(closed), self.graph.cell_at(goal)
        end = np.array(goal, dtype=np.float64)
        last = int(net.add_node(None))
        net.add_edges_from(
            backwards(self._paths_from(last, end, goal_id, [*self._points, end], self._nodes[goal_id]))
        )
        net.reverse()
        left = rustworkx.dijkstra_shortest_path_lengths(net, last, edge_cost_fn=lambda edge: edge.cost)
        exits = {
            cell_id: [(self._points[node], left[node]) for node in nodes if node in left]
            for cell_id, nodes in self._nodes.items()
        }
        exits[goal_id].append((end, 0.0))
        return exits

    def _open_net(self, closed: Collection[str]) -> rustworkx.PyDiGraph:
        """Copy the net without the steps through `closed` gateways."""
        net = self._net.copy()
        for gateway_id in closed:
            first, second = self._faces[gateway_id]
            net.remove_edges_from(
                [(a, b) for a, b in ((first, second), (second, first)) if net.has_edge(a, b)]
            )
        return net

    def _walkable(self, cell: Cell) -> shapely.Geometry:
        """Subtract keep-out zones from a cell."""
        area = self.zones.keep_out_area
        return shapely.difference(cell.polygon, area) if area.intersects(cell.polygon) else cell.polygon

    def _route(self, cell_id: str, edges: list[Edge], way: Array) -> Route:
        """Sum up edges from a cell on, with the nodes between them (n, 2)."""
        gateway_ids = tuple(edge.gateway_id for edge in edges if edge.gateway_id)
        cell_ids = [cell_id]
        for gateway_id in gateway_ids:
            first, second = self.graph.gateway(gateway_id).cell_ids
            cell_ids.append(second if cell_ids[-1] == first else first)
        moved = np.append(True, (way[1:] != way[:-1]).any(axis=1))
        moved[-1] = True
        way = way[moved] if moved.sum() > 1 else np.stack([way[0], way[-1]])
        return Route(tuple(cell_ids), gateway_ids, sum(edge.cost for edge in edges), way)

    def _add_node(self, point: Array) -> int:
        """Add a point where a path may bend."""
        self._points.append(point)
        return int(self._net.add_node(None))

    def _add_gateway(self, gateway: Gateway) -> None:
        """Add both faces of a gateway, and the step from one to the other."""
        faces = self._add_node(gateway.middle), self._add_node(gateway.middle)
        cost = self.settings.passing(gateway.width / self.graph.diameter) + UNDRAWN * (not gateway.is_drawn)
        entered = self.zones.entered_through(gateway)
        for (here, there), cell_id in zip((faces, faces[::-1]), gateway.cell_ids[::-1], strict=True):
            if entered in {"", cell_id}:
                self._net.add_edge(here, there, Edge(cost, gateway.gateway_id))
        self._faces[gateway.gateway_id] = faces
        for cell_id, node in zip(gateway.cell_ids, faces, strict=True):
            self._nodes[cell_id].append(node)

    def _add_paths(self, cell_id: str) -> None:
        """Join the nodes of a cell that see each other."""
        nodes = self._nodes[cell_id]
        for k in range(1, len(nodes)):
            here = self._points[nodes[k]]
            paths = self._paths_from(nodes[k], here, cell_id, self._points, nodes[:k])
            self._net.add_edges_from([*paths, *backwards(paths)])

    def _paths_from(
        self,
        node: int,
        here: Array,
        cell_id: str,
        points: list[Array],
        others: list[int],
        *,
        leaves: bool = False,
    ) -> list[tuple[int, int, Edge]]:
        """List the edges inside a cell from a node to those of the others that it sees.

        A robot that stands in a keep-out zone `leaves` it straight.
        """
        if not others:
            return []
        there = np.array([points[other] for other in others])
        price = self.settings.walking(self.graph.cell(cell_id).size) / self.graph.diameter
        costs = price * np.hypot(*(there - here).T)
        room = self._widened[cell_id]
        if leaves and self.zones.are_kept_out(here[np.newaxis])[0]:
            cell = self.graph.cell(cell_id)
            room = widened(cell, cell.polygon)
        sees = are_visible(room, here, there)
        return [(node, others[k], Edge(float(costs[k]))) for k in np.flatnonzero(sees).tolist()]


def check_allowed(zones: Zones, goal: Point) -> None:
    """Raise RouteError if a goal lies where no robot may drive."""
    if zones.are_kept_out(np.array([goal]))[0]:
        raise RouteError("the goal lies in a keep-out zone")


def backwards(edges: list[tuple[int, int, Edge]]) -> list[tuple[int, int, Edge]]:
    """Turn edges round."""
    return [(there, here, edge) for here, there, edge in edges]


def reflex_vertices(room: shapely.Geometry) -> Array:
    """List the vertices that jut into free space, (k, 2): shortest paths bend there."""
    vertices = [np.empty((0, 2))]
    for part in shapely.get_parts(room):
        if part.geom_type == "Polygon":
            oriented = shapely.orient_polygons(part)
            for line in (oriented.exterior, *oriented.interiors):
                ring = shapely.get_coordinates(line)[:-1]
                before, after = ring - np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0) - ring
                turns = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
                vertices.append(ring[turns < 0.0])
    return np.concatenate(vertices)


def widened(cell: Cell, walkable: shapely.Geometry) -> shapely.Geometry:
    """Widen the walkable part of a cell by a trace, and prepare it for many visibility tests."""
    room = walkable.buffer(GRAZE * np.sqrt(cell.polygon.area), join_style="mitre")
    shapely.prepare(room)
    return room


def are_visible(room: shapely.Geometry, here: Array, there: Array) -> NDArray[np.bool_]:
    """Tell which of the points `there` (n, 2) are visible from `here` (2,) inside a cell, (n,)."""
    lines = shapely.linestrings(np.stack([np.broadcast_to(here, there.shape), there], axis=1))
    return np.asarray(shapely.covers(room, lines))
