"""Cells, the gateways between them, and the graph that they make (Wolter 2001, section 4.1)."""

import math
from dataclasses import dataclass
from enum import Enum
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array, frozen_array, frozen_points


class CellSize(Enum):
    """How long a cell's outline is beside the others of the drawing (section 4.2)."""

    SMALL = "small"
    MEDIUM = "medium"
    LARGE = "large"


@dataclass(frozen=True, eq=False)
class Cell:
    """A place that a person would name: a room, a hall, a corridor. It need not be convex."""

    cell_id: str
    outline: Array  # (n >= 3, 2) counter-clockwise, not repeated [drawing units]
    size: CellSize
    label: str = ""  # the words that stand in it, joined by commas
    holes: tuple[Array, ...] = ()  # each (n >= 3, 2), clockwise: the block that a corridor runs around

    def __post_init__(self) -> None:
        """Copy and freeze the outline and holes."""
        object.__setattr__(self, "outline", frozen_points(self.outline, name="outline", at_least=3))
        holes = tuple(frozen_points(hole, name="hole", at_least=3) for hole in self.holes)
        object.__setattr__(self, "holes", holes)

    @cached_property
    def polygon(self) -> shapely.Polygon:
        """The cell as a polygon."""
        return shapely.Polygon(self.outline, self.holes)

    @cached_property
    def center(self) -> tuple[float, float]:
        """Return the point that is deepest inside, a little rounded: where the robot would stand in it."""
        tolerance = math.sqrt(self.polygon.area) / 50.0
        point = shapely.get_point(shapely.maximum_inscribed_circle(self.polygon, tolerance), 0)
        return float(point.x), float(point.y)


@dataclass(frozen=True, eq=False)
class Gateway:
    """Where one goes from one cell to another: a door, a narrowing, the mouth of a corridor."""

    gateway_id: str
    segment: Array  # (2, 2) from wall to wall, the first cell of `cell_ids` on its left [drawing units]
    cell_ids: tuple[str, str]
    is_drawn: bool = True  # else the drawing may have forgotten it

    def __post_init__(self) -> None:
        """Copy and freeze the segment."""
        segment = frozen_array(self.segment)
        if segment.shape != (2, 2):
            raise ValueError(f"segment must have shape (2, 2), got {segment.shape}")
        object.__setattr__(self, "segment", segment)

    @property
    def middle(self) -> Array:
        """The middle of the opening, (2,)."""
        return np.asarray(self.segment.mean(axis=0))

    @property
    def width(self) -> float:
        """From wall to wall [drawing units]."""
        return float(np.hypot(*(self.segment[1] - self.segment[0])))


@dataclass(frozen=True, slots=True)
class Neighbor:
    """A cell beyond a gateway, and its relative position (section 4.1)."""

    cell_id: str
    gateway_id: str
    direction: (
        float  # from the center of the cell to the middle of the gateway [rad, counter-clockwise on the page]
    )
    distance: float  # the same, as a share of the drawing's diameter


@dataclass(frozen=True, eq=False)
class CellGraph:
    """The cells of a drawing and how they hang together."""

    cells: tuple[Cell, ...]
    gateways: tuple[Gateway, ...]
    diameter: float  # of the drawing: between its farthest points [drawing units]

    def __post_init__(self) -> None:
        """Reject a graph without cells, and gateways to nowhere."""
        if not self.cells:
            raise ValueError("cells must hold at least one cell, got none")
        known = {cell.cell_id for cell in self.cells}
        for gateway in self.gateways:
            if not known.issuperset(gateway.cell_ids):
                raise ValueError(f"gateways must join known cells, got {gateway.cell_ids}")

    @cached_property
    def index_from_id(self) -> dict[str, int]:
        """Where each cell stands in `cells`."""
        return {cell.cell_id: index for index, cell in enumerate(self.cells)}

    @cached_property
    def gateway_ids(self) -> frozenset[str]:
        """The ids of all gateways."""
        return frozenset(gateway.gateway_id for gateway in self.gateways)

    @cached_property
    def tree(self) -> shapely.STRtree:
        """The polygons of the cells, indexed."""
        return shapely.STRtree([cell.polygon for cell in self.cells])

    def cell(self, cell_id: str) -> Cell:
        """Return the cell of this id; raises KeyError if there is none."""
        return self.cells[self.index_from_id[cell_id]]

    def gateway(self, gateway_id: str) -> Gateway:
        """Return the gateway of this id; raises KeyError if there is none."""
        for gateway in self.gateways:
            if gateway.gateway_id == gateway_id:
                return gateway
        raise KeyError(gateway_id)

    def cell_indices_at(self, points: Array) -> NDArray[np.int64]:
        """Find which of `cells` each point (n, 2) lies in, else which is nearest, (n,)."""
        places = shapely.points(points)
        indices = np.full(len(points), len(self.cells), dtype=np.int64)
        inside, cells = self.tree.query(places, predicate="intersects")
        np.minimum.at(indices, inside, cells)
        outside = np.flatnonzero(indices == len(self.cells))
        nearest, cells = self.tree.query_nearest(places[outside])
        np.minimum.at(indices, outside[nearest], cells)
        return indices

    def cell_at(self, point: tuple[float, float]) -> str:
        """Name the cell that a point lies in, else the nearest; on a border the first in order."""
        return self.cells[int(self.cell_indices_at(np.array([point], dtype=np.float64))[0])].cell_id

    def distance_to(self, cell_id: str, point: tuple[float, float]) -> float:
        """Measure from a point to a cell; 0 inside it [drawing units]."""
        return float(self.cell(cell_id).polygon.distance(shapely.Point(point)))

    def gateways_of(self, cell_id: str) -> tuple[Gateway, ...]:
        """Return the gateways of a cell, in order."""
        return tuple(gateway for gateway in self.gateways if cell_id in gateway.cell_ids)

    def neighbors(self, cell_id: str) -> tuple[Neighbor, ...]:
        """Return the neighbors of a cell, one for each gateway, in order of gateways."""
        center = np.array(self.cell(cell_id).center)
        found = []
        for gateway in self.gateways_of(cell_id):
            first, second = gateway.cell_ids
            x, y = gateway.middle - center
            found.append(
                Neighbor(
                    second if cell_id == first else first,
                    gateway.gateway_id,
                    direction=math.atan2(y, x),
                    distance=math.hypot(x, y) / self.diameter,
                )
            )
        return tuple(found)
