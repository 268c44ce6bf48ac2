"""All that is derived once from a drawing: what can be seen from where, its cells, its likely scale."""

import math
from dataclasses import dataclass, field

import numpy as np

from pilotage.maps.cells import CellGraph
from pilotage.maps.decomposition import DecompositionSettings, decompose
from pilotage.maps.range_table import RangeTable, RangeTableSettings, build_range_table
from pilotage.maps.schematic import SchematicMap


@dataclass(frozen=True, slots=True)
class ScaleGuess:
    """What buildings have in common: how large they are, and how wide their free space is."""

    diagonal: float = 65.0  # [m] of a building's floor: a school's wing, an office's
    clearance: float = 1.25  # [m] from a place inside to the nearest wall, median over all places


@dataclass(frozen=True, slots=True)
class AtlasSettings:
    """How a drawing is looked at."""

    range_table: RangeTableSettings = field(default_factory=RangeTableSettings)
    decomposition: DecompositionSettings = field(default_factory=DecompositionSettings)
    scale_guess: ScaleGuess = field(default_factory=ScaleGuess)


@dataclass(frozen=True, eq=False)
class Atlas:
    """A drawing, ready to be found in."""

    sketch: SchematicMap
    range_table: RangeTable
    cell_graph: CellGraph | None  # None if the drawing encloses nothing
    log_scale: float  # [log drawing units per metre] a first guess, good to a factor of about 1.5

    def cell_at(self, point: tuple[float, float]) -> str:
        """Name the cell that a point lies in, else the nearest; empty if the drawing has none."""
        return self.cell_graph.cell_at(point) if self.cell_graph else ""


def build_atlas(sketch: SchematicMap, settings: AtlasSettings) -> Atlas:
    """Derive from a drawing all that localization needs."""
    range_table = build_range_table(sketch, settings.range_table)
    try:
        cell_graph = decompose(sketch, settings.decomposition)
    except ValueError:  # it encloses no free space: there is still something to see
        cell_graph = None
    return Atlas(sketch, range_table, cell_graph, guess_log_scale(sketch, range_table, settings.scale_guess))


def guess_log_scale(sketch: SchematicMap, range_table: RangeTable, guess: ScaleGuess) -> float:
    """Guess log drawing units per metre: the mean of what the drawing's size and its clearance say.

    Neither is exact, but they err apart: a large building has wide halls and narrow corridors both.
    """
    by_size = math.log(sketch.diagonal / guess.diagonal)
    by_clearance = math.log(float(np.median(range_table.clearances)) / guess.clearance)
    return (by_size + by_clearance) / 2
