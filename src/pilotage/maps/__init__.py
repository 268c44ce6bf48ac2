"""From the drawing to places (Wolter 2001, sections 2.2 and 4.1)."""

from pilotage.maps.atlas import Atlas, AtlasSettings, build_atlas
from pilotage.maps.cells.decomposition import Division, NoDoorsError, decompose, divide
from pilotage.maps.cells.free_space import DecompositionSettings, FreeSpace, NotEnclosedError, free_space
from pilotage.maps.cells.graph import Cell, CellGraph, CellSize, Gateway, Neighbor
from pilotage.maps.file_axes import FileAxes
from pilotage.maps.range_table import RangeTable, RangeTableSettings
from pilotage.maps.routing.places import check_place, check_reachable, find_labeled
from pilotage.maps.routing.roadmap import Roadmap, Route, RouteError, RouteSettings, find_route
from pilotage.maps.schematic import Label, SchematicMap
from pilotage.maps.zones import Zones

__all__ = [
    "Atlas",
    "AtlasSettings",
    "Cell",
    "CellGraph",
    "CellSize",
    "DecompositionSettings",
    "Division",
    "FileAxes",
    "FreeSpace",
    "Gateway",
    "Label",
    "Neighbor",
    "NoDoorsError",
    "NotEnclosedError",
    "RangeTable",
    "RangeTableSettings",
    "Roadmap",
    "Route",
    "RouteError",
    "RouteSettings",
    "SchematicMap",
    "Zones",
    "build_atlas",
    "check_place",
    "check_reachable",
    "decompose",
    "divide",
    "find_labeled",
    "find_route",
    "free_space",
]
