"""A route through the cell graph, and what it costs (Wolter 2001, section 4.2)."""

from dataclasses import dataclass

from pilotage.errors import PilotageError
from pilotage.geometry import Array, frozen_points
from pilotage.maps.cells.graph import CellSize

Point = tuple[float, float]


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
