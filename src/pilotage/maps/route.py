"""Find a route through the cell graph (Wolter 2001, section 4.2)."""

from collections.abc import Collection
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import rustworkx

from pilotage.errors import PilotageError
from pilotage.geometry import Array, frozen_points
from pilotage.maps.cells import Cell, CellGraph, CellSize, Gateway
from pilotage.maps.walking import find_sights, jutting_corners

Point = tuple[float, float]

START, GOAL = 0, 1
"""Their numbers among the stops of the network."""


class RouteError(PilotageError):
    """A place cannot be gone to, or no way leads there."""


@dataclass(frozen=True, slots=True)
class RouteSettings:
    """What a way costs beside its length; all costs are shares of the drawing's diameter."""

    gateway: float = 0.03  # for passing one: it may be closed; as much as walking 1.5 m in a 50 m building
    narrowness: float = (
        0.0002  # for passing one as wide as the drawing, and more for narrow ones: 1 % at 1 in 50
    )
    small: float = (
        1.2  # how many times dearer it is to walk in a small cell, where there is less room to turn
    )
    medium: float = 1.0
    large: float = 1.0

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in self.__slots__:
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")

    def walking(self, size: CellSize) -> float:
        """Return how many times dearer it is to walk in a cell of this size."""
        return {CellSize.SMALL: self.small, CellSize.MEDIUM: self.medium, CellSize.LARGE: self.large}[size]

    def passing(self, relative_width: float) -> float:
        """Return what it costs to pass a gateway of this width, a share of the diameter."""
        return self.gateway + self.narrowness / relative_width


@dataclass(frozen=True, eq=False)
class Route:
    """Cell by cell from the start to the goal; one gateway fewer than cells."""

    cell_ids: tuple[str, ...]
    gateway_ids: tuple[str, ...]
    cost: float  # length as a share of the diameter, dearer in small cells and through narrow gateways
    way: Array  # (k >= 2, 2) from the start through the middles of the gateways to the goal [drawing units]

    def __post_init__(self) -> None:
        """Freeze the way, and refuse a route that skips a cell or a gateway."""
        object.__setattr__(self, "way", frozen_points(self.way, name="way", at_least=2))
        cells, gateways = len(self.cell_ids), len(self.gateway_ids)
        if cells != gateways + 1:
            raise ValueError(f"a route needs one gateway fewer than cells, got {gateways} and {cells}")


def find_route(
    graph: CellGraph, start: Point, goal: Point, settings: RouteSettings, closed: Collection[str] = ()
) -> Route:
    """Find the cheapest route between two points [drawing units], not through `closed` gateways.

    Inside a cell the way is the shortest one. Raises RouteError if none leads from start to goal.
    """
    network = Network(graph, start, goal, settings, closed)
    stops = network.cheapest()
    if not stops:
        first, last = graph.cell_at(start), graph.cell_at(goal)
        raise RouteError(f"no way leads from cell {first} to cell {last}: no gateways join them")
    legs = [network.legs.get_edge_data(a, b) for a, b in pairwise(stops)]
    gateways = tuple(leg.gateway_id for leg in legs if leg.gateway_id)
    cells = [graph.cell_at(start)]
    for gateway_id in gateways:
        first, second = graph.gateway(gateway_id).cell_ids
        cells.append(second if cells[-1] == first else first)
    way = np.array([network.points[stop] for stop in stops])
    moved = np.append(True, (way[1:] != way[:-1]).any(axis=1))
    moved[-1] = True
    way = way[moved] if moved.sum() > 1 else np.stack([way[0], way[-1]])
    return Route(tuple(cells), gateways, sum(leg.cost for leg in legs), way)


@dataclass(frozen=True, slots=True)
class Leg:
    """From stop to stop: a walk in a cell, or the step through a gateway."""

    cost: float
    gateway_id: str = ""


class Network:
    """Start, goal, corners and both faces of every open gateway, joined where one sees the other."""

    def __init__(
        self, graph: CellGraph, start: Point, goal: Point, settings: RouteSettings, closed: Collection[str]
    ) -> None:
        self.points = [np.array(start, dtype=np.float64), np.array(goal, dtype=np.float64)]
        self.legs = rustworkx.PyGraph()
        self.legs.add_nodes_from([START, GOAL])
        self.settings, self.diameter = settings, graph.diameter
        stops_in: dict[str, list[int]] = {cell.cell_id: [] for cell in graph.cells}
        stops_in[graph.cell_at(start)].append(START)
        stops_in[graph.cell_at(goal)].append(GOAL)
        for gateway in graph.gateways:
            if gateway.gateway_id not in closed:
                for cell_id, stop in zip(gateway.cell_ids, self.add_gateway(gateway), strict=True):
                    stops_in[cell_id].append(stop)
        for cell in graph.cells:
            if len(stops_in[cell.cell_id]) > 1:
                self.add_walks(cell, stops_in[cell.cell_id])

    def add_stop(self, point: Array) -> int:
        """Add a place where a way may bend."""
        self.points.append(point)
        return int(self.legs.add_node(len(self.points) - 1))

    def add_gateway(self, gateway: Gateway) -> tuple[int, int]:
        """Add both faces of a gateway, and the step from one to the other."""
        faces = self.add_stop(gateway.middle), self.add_stop(gateway.middle)
        cost = self.settings.passing(gateway.width / self.diameter)
        self.legs.add_edge(*faces, Leg(cost, gateway.gateway_id))
        return faces

    def add_walks(self, cell: Cell, stops: list[int]) -> None:
        """Join stops of a cell, and the corners that jut into it, where one sees the other."""
        stops = stops + [self.add_stop(corner) for corner in jutting_corners(cell)]
        points = np.array([self.points[stop] for stop in stops])
        price = self.settings.walking(cell.size) / self.diameter
        for first, second in find_sights(cell, points).tolist():
            length = float(np.hypot(*(points[second] - points[first])))
            self.legs.add_edge(stops[first], stops[second], Leg(price * length))

    def cheapest(self) -> list[int]:
        """Return the stops of the cheapest way; none if there is no way."""
        found = rustworkx.dijkstra_shortest_paths(
            self.legs, START, target=GOAL, weight_fn=lambda leg: leg.cost
        )
        return list(found[GOAL]) if GOAL in found else []
