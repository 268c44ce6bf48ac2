"""From the drawing to places (Wolter 2001, sections 2.2 and 4.1)."""

from pilotage.maps.cells import Cell, CellGraph, CellSize, Gateway, Neighbor
from pilotage.maps.decomposition import DecompositionSettings, decompose
from pilotage.maps.free_space import FreeSpace, FreeSpaceSettings, free_space
from pilotage.maps.merging import MergeSettings
from pilotage.maps.schematic import Label, SchematicMap

__all__ = [
    "Cell",
    "CellGraph",
    "CellSize",
    "DecompositionSettings",
    "FreeSpace",
    "FreeSpaceSettings",
    "Gateway",
    "Label",
    "MergeSettings",
    "Neighbor",
    "SchematicMap",
    "decompose",
    "free_space",
]
