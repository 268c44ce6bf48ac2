"""Places on a drawing as people name them: a point, or a word."""

import unicodedata

import numpy as np
import rustworkx

from pilotage.maps.cells.graph import CellGraph
from pilotage.maps.routing.roadmap import Point, RouteError

SLACK = 0.005
"""How far beside a cell a point may lie, as a share of the diameter: a pencil's width off."""


def folded(words: str) -> str:
    r"""Write words as they are compared: without case, as single letters with their accents, single spaces.

    >>> folded("  Living   ROOM "), folded("Bu\N{COMBINING DIAERESIS}ro") == folded("B\xfcro")
    ('living room', True)
    """
    return unicodedata.normalize("NFC", " ".join(words.split()).casefold())


def find_labeled(graph: CellGraph, words: str) -> Point:
    """Find where to stand in the one cell that bears a label, or else has this id; case does not matter.

    Raises RouteError if it is no cell, or if several bear the label.
    """
    wanted = folded(words)
    if not wanted:
        raise RouteError("a place needs a name or two numbers X,Y, got nothing")
    # a label lists the names of its cell with commas between them, and a name may hold one itself
    found = [cell for cell in graph.cells if f", {wanted}, " in f", {folded(cell.label)}, "]
    found = found or [cell for cell in graph.cells if folded(cell.cell_id) == wanted]
    if len(found) == 1:
        return found[0].center
    if found:
        ids = ", ".join(cell.cell_id for cell in found)
        raise RouteError(f"the label {words!r} stands in {len(found)} cells ({ids}), name the place as X,Y")
    known = ", ".join(sorted({cell.label for cell in graph.cells if cell.label})) or "none"
    raise RouteError(f"the label {words!r} stands in no cell, labels in cells are: {known}")


def check_place(graph: CellGraph, point: Point, what: str) -> None:
    """Reject a point that lies in no cell; `what` names it in the message.

    Raises RouteError that says whether it lies outside the drawing or where nothing is free.
    """
    cell_id = graph.cell_at(point)
    if graph.distance_to(cell_id, point) <= SLACK * graph.diameter:
        return
    bounds = np.array([cell.polygon.bounds for cell in graph.cells])
    low, high = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
    is_inside = bool((low <= point).all() and (point <= high).all())
    where = "in a wall or in a place that is not free" if is_inside else "outside the drawing"
    raise RouteError(f"the {what} lies {where}, the nearest cell is {cell_id}")


def check_reachable(graph: CellGraph, goal: Point, start: Point | None = None) -> None:
    """Reject a goal to which no gateways lead from the start, or from the largest part of the drawing.

    Raises RouteError that names the cells.
    """
    parts = connected_cells(graph)
    goal_id = graph.cell_at(goal)
    around_goal = next(part for part in parts if goal_id in part)
    if start is not None:
        start_id = graph.cell_at(start)
        if start_id not in around_goal:
            raise RouteError(f"no way leads from cell {start_id} to cell {goal_id}: no gateways join them")
    elif around_goal != parts[0]:
        raise RouteError(
            f"no gateways lead from the largest part of the drawing to cell {goal_id}, where the goal lies;"
            " say where the robot starts if it is not there"
        )


def connected_cells(graph: CellGraph) -> list[set[str]]:
    """Group the cells that gateways connect, the group of the largest area first."""
    network = rustworkx.PyGraph()
    network.add_nodes_from([cell.cell_id for cell in graph.cells])
    index = graph.index_from_id
    for gateway in graph.gateways:
        first, second = gateway.cell_ids
        network.add_edge(index[first], index[second], None)
    found = [sorted(part) for part in rustworkx.connected_components(network)]
    areas = [sum(graph.cells[k].polygon.area for k in part) for part in found]
    order = sorted(range(len(found)), key=lambda number: (-areas[number], found[number]))
    return [{graph.cells[k].cell_id for k in found[number]} for number in order]
