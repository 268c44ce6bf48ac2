"""The cells of a draw.io page: shapes, edges, groups and layers, each with style and place."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from xml.etree.ElementTree import Element

import numpy as np

from pilotage.geometry import Array

DEEPEST = 64
"""Groups within groups."""


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell as the file tells it."""

    cell_id: str
    parent: str
    value: str  # a label, plain or HTML
    style: Mapping[str, str]
    kind: str  # "vertex", "edge", or "" for layers and the root
    shown: bool
    geometry: Element | None
    ends: tuple[str, str] = ("", "")  # cells that an edge joins
    named: str = ""  # the property `class` that a person gave it


@dataclass(frozen=True, slots=True)
class Box:
    """A place on the page: corner, size, and a turn about the middle, y down."""

    x: float = 0.0
    y: float = 0.0
    width: float = 0.0
    height: float = 0.0

    @property
    def middle(self) -> Array:
        """The middle of the box, (2,)."""
        return np.array([self.x + self.width / 2.0, self.y + self.height / 2.0])


@dataclass(frozen=True)
class Cells:
    """All cells of a page, in paint order."""

    cells: Mapping[str, Cell]
    boxes: dict[str, Box] = field(default_factory=dict)

    def ancestors(self, cell: Cell) -> list[Cell]:
        """Return the groups and the layer that hold a cell, the outermost first."""
        found: list[Cell] = []
        parent = self.cells.get(cell.parent)
        while parent is not None and len(found) < DEEPEST:
            found.append(parent)
            parent = self.cells.get(parent.parent)
        return found[::-1]

    def box(self, cell: Cell, depth: int = 0) -> Box:
        """Return the place of a cell on the page."""
        known = self.boxes.get(cell.cell_id)
        if known is not None:
            return known
        parent = self.cells.get(cell.parent)
        outer = self.box(parent, depth + 1) if parent is not None and depth < DEEPEST else Box()
        box = outer if cell.geometry is None else placed(cell.geometry, outer)
        self.boxes[cell.cell_id] = box
        return box


def placed(geometry: Element, outer: Box) -> Box:
    """Place a geometry in the box of its parent."""
    x, y = value_of(geometry, "x"), value_of(geometry, "y")
    if geometry.get("relative") == "1":
        offset = geometry.find("mxPoint[@as='offset']")
        x, y = x * outer.width, y * outer.height
        if offset is not None:
            x, y = x + value_of(offset, "x"), y + value_of(offset, "y")
    return Box(outer.x + x, outer.y + y, value_of(geometry, "width"), value_of(geometry, "height"))


def read_cells(model: Element) -> Cells:
    """Read all cells of a page; those that a wrapper names bear its id, label and class."""
    root = model.find("root")
    found = {} if root is None else {cell.cell_id: cell for cell in cells_of(root)}
    return Cells(found)


def cells_of(root: Element) -> Iterator[Cell]:
    """Read the cells of a page in paint order."""
    for k, element in enumerate(root):
        wrapped = element.find("mxCell")
        cell = element if element.tag == "mxCell" else wrapped
        if cell is None:
            continue
        kind = "vertex" if cell.get("vertex") == "1" else "edge" if cell.get("edge") == "1" else ""
        yield Cell(
            element.get("id") or f"#{k}",
            cell.get("parent", ""),
            cell.get("value") or element.get("label") or "",
            read_style(cell.get("style", "")),
            kind,
            cell.get("visible") != "0",
            cell.find("mxGeometry"),
            (cell.get("source", ""), cell.get("target", "")),
            element.get("class", ""),
        )


def read_style(text: str) -> dict[str, str]:
    """Read `name;key=value;...`; a bare name is a shape.

    >>> read_style("ellipse;html=1;fillColor=#fff")
    {'shape': 'ellipse', 'html': '1', 'fillColor': '#fff'}
    """
    style: dict[str, str] = {}
    for part in text.split(";"):
        key, equals, value = part.partition("=")
        if equals:
            style[key.strip()] = value.strip()
        elif key.strip():
            style.setdefault("shape", key.strip())
    return style


def value_of(element: Element, name: str) -> float:
    """Return a number of an element; 0 if it has none."""
    return number(element.get(name, ""), 0.0)


def number(text: str, otherwise: float) -> float:
    """Return a finite number, another one if a text is none."""
    try:
        value = float(text)
    except ValueError:
        return otherwise
    return value if math.isfinite(value) else otherwise
