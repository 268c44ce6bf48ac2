"""The way of a draw.io edge: from one cell to another, through its waypoints."""

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np

from pilotage.geometry import Array
from pilotage.io.drawio.cells import Box, Cell, Cells, number, value_of

Point = tuple[float, float]


def edge_way(cell: Cell, cells: Cells) -> Array:
    """Return the points (n, 2) of an edge on the page, y down; it is not routed around corners."""
    if cell.geometry is None:
        return np.empty((0, 2))
    parent = cells.cells.get(cell.parent)
    outer = cells.box(parent) if parent is not None else Box()
    way = [(x + outer.x, y + outer.y) for x, y in waypoints(cell.geometry)]
    ends = [free_end(cell.geometry, outer, name) for name in ("sourcePoint", "targetPoint")]
    joined = [cells.cells.get(name) for name in cell.ends]
    rough = [middle_of(cells.box(other)) if other else end for other, end in zip(joined, ends, strict=True)]
    toward = (way[0] if way else rough[1], way[-1] if way else rough[0])
    for k, prefix in enumerate(("exit", "entry")):
        other = joined[k]
        if other is not None:
            ends[k] = joined_end(cells.box(other), cell, prefix, toward[k])
    points = [point for point in (ends[0], *way, ends[1]) if point is not None]
    return np.array(points, dtype=np.float64).reshape(-1, 2)


def middle_of(box: Box) -> Point:
    """Return the middle of a box."""
    x, y = box.middle
    return float(x), float(y)


def waypoints(geometry: Element) -> Iterator[Point]:
    """Return the points between the ends, in the coordinates of the parent."""
    for point in geometry.findall("Array[@as='points']/mxPoint"):
        yield value_of(point, "x"), value_of(point, "y")


def free_end(geometry: Element, outer: Box, name: str) -> Point | None:
    """Return an end of an edge that joins no cell; None if the file does not tell."""
    point = geometry.find(f"mxPoint[@as='{name}']")
    return None if point is None else (outer.x + value_of(point, "x"), outer.y + value_of(point, "y"))


def joined_end(box: Box, cell: Cell, prefix: str, toward: Point | None) -> Point:
    """Return an end of an edge on a cell: where the style says, or on the border toward a point."""
    if f"{prefix}X" in cell.style:
        shares = [number(cell.style.get(f"{prefix}{axis}", ""), 0.5) for axis in "XY"]
        shifts = [number(cell.style.get(f"{prefix}D{axis}", ""), 0.0) for axis in "xy"]
        return box.x + shares[0] * box.width + shifts[0], box.y + shares[1] * box.height + shifts[1]
    return middle_of(box) if toward is None else border_point(box, toward)


def border_point(box: Box, toward: Point) -> Point:
    """Return where the line from the middle of a box to a point leaves the box."""
    x, y = box.middle
    dx, dy = toward[0] - x, toward[1] - y
    shares = [half / abs(step) for half, step in ((box.width / 2, dx), (box.height / 2, dy)) if step]
    share = min([1.0, *shares])
    return float(x + share * dx), float(y + share * dy)
