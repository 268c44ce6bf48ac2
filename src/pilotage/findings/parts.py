"""Find rooms that cannot be reached from the rest, drawings in pieces, and sheets of two buildings."""

from collections.abc import Iterator

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.findings.doors import suggest_door
from pilotage.findings.finding import Finding, Severity
from pilotage.findings.words import named
from pilotage.interpretation import GAP
from pilotage.maps import CellGraph
from pilotage.maps.routing.places import connected_cells

BUILDING = 0.2
"""A part that cannot be reached is a building of its own from this share of the largest part's area on."""

APART = 0.04
"""And if it is so far from it that no wall is between, as a share of the drawing's diameter."""

WHOLE, FEW = 0.6, 3
"""A drawing is in pieces if its largest part has less than this share of the floor, beside so many others."""

MISREAD = (
    "walls or doors are not understood as they are meant: the picture of --figure shows how;"
    " erase what is no wall, leave gaps for doors, or say what a layer or color is"
    " (--layer NAME=furniture); a photo is best traced at the drawing table"
)
"""What to do about a drawing in pieces; a map, which tells walls and doors, lacks doors."""


def find_parts(graph: CellGraph, to_open: str) -> Iterator[Finding]:
    """Find cells that cannot be reached from the rest, drawings in pieces, and sheets of two buildings."""
    parts = connected_cells(graph)
    shapes = [shapely.union_all([graph.cell(name).polygon for name in part]) for part in parts]
    hulls, areas = shapely.convex_hull(shapes), shapely.area(shapes)
    stands_apart = (areas > BUILDING * areas[0]) & ~shapely.intersects(hulls, hulls[0])
    stands_apart &= ~in_one_building(shapes, APART * graph.diameter)
    beside = [number for number in range(1, len(parts)) if not stands_apart[number]]
    if len(beside) >= FEW and areas[0] < WHOLE * areas[[0, *beside]].sum():
        count = sum(len(parts[number]) for number in (0, *beside))
        yield Finding(
            "in-pieces",
            Severity.WARNING,
            f"doors join only {len(parts[0])} of {count} rooms",
            MISREAD if to_open == GAP else f"{to_open} in the wall wherever a door is",
        )
    for number in range(1, len(parts)):
        if len(parts[number]) < 2:
            continue  # a room without a door
        cells = [cell for cell in graph.cells if cell.cell_id in parts[number]]
        listed = ", ".join(named(cell) for cell in cells[:4]) + (", ..." if len(cells) > 4 else "")
        if stands_apart[number]:
            yield Finding(
                "two-buildings",
                Severity.WARNING,
                f"the sheet shows more than one building or floor ({listed} stand apart)",
                "draw each in a file of its own; until then the robot stays where it starts",
                cells[0].center,
                tuple(cell.cell_id for cell in cells),
            )
        else:
            yield Finding(
                "unreachable",
                Severity.WARNING,
                f"{listed} cannot be reached from the rest of the building",
                f"{to_open} where the door between them is",
                cells[0].center,
                tuple(cell.cell_id for cell in cells),
                suggest_door(
                    cells[0].polygon,
                    [cell.polygon for cell in graph.cells if cell.cell_id not in parts[number]],
                    graph,
                ),
            )


def in_one_building(shapes: list[shapely.Geometry], wall: float) -> NDArray[np.bool_]:
    """Tell which shapes (n,) hang with the first one, also by others, across no more than a wall."""
    network = rustworkx.PyGraph()
    network.add_nodes_from(range(len(shapes)))
    tree = shapely.STRtree(shapes)
    near = tree.query(shapes, predicate="dwithin", distance=wall).T
    network.add_edges_from_no_data(list(map(tuple, near.tolist())))
    found = np.zeros(len(shapes), dtype=bool)
    found[list(rustworkx.node_connected_component(network, 0))] = True
    return found
