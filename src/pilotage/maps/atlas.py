"""All that is derived once from a drawing: what can be seen from where, its cells, its likely scale."""

import math
from collections.abc import Collection
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Polyline
from pilotage.maps.cells.decomposition import decompose
from pilotage.maps.cells.free_space import NOTHING, DecompositionSettings, NotEnclosedError
from pilotage.maps.cells.graph import CellGraph
from pilotage.maps.range_table import RangeTable, RangeTableSettings, build_range_table
from pilotage.maps.routing.forgotten_doors import JoinedGraph, join_parts
from pilotage.maps.schematic import SchematicMap
from pilotage.shape.corners import Corners, find_corners
from pilotage.shape.simplify import Simplification, simplify, simplify_all


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
    detail: float = 0.0025  # least relevance of a corner [rad], as a share of the drawing's diagonal
    scale_guess: ScaleGuess = field(default_factory=ScaleGuess)


@dataclass(frozen=True, eq=False)
class Atlas:
    """A drawing, ready to be found in."""

    sketch: SchematicMap
    range_table: RangeTable
    cell_graph: CellGraph | None  # None if the drawing encloses nothing
    corners: Corners  # as seen from free space
    log_scale: float  # [log drawing units per metre] a first guess, good to a factor of about 1.5

    @cached_property
    def joined(self) -> JoinedGraph | None:
        """The cells as a robot drives in them: also through doors that the drawing may have forgotten."""
        return None if self.cell_graph is None else join_parts(self.cell_graph)

    @cached_property
    def cell_indices(self) -> NDArray[np.int64]:
        """Which cell of the graph each place of the range table's grid lies in, or is nearest to, (k,)."""
        table = self.range_table
        if self.cell_graph is None:
            return np.zeros(table.columns * table.rows, dtype=np.int64)
        return self.cell_graph.cell_indices_at(table.middles)

    def cell_at(self, point: tuple[float, float]) -> str:
        """Name the cell that a point lies in, else the nearest; empty if the drawing has none."""
        return self.cell_graph.cell_at(point) if self.cell_graph else ""

    def place_name(self, cell_id: str) -> str:
        """Return the label of a cell if it has one, else its id."""
        if self.cell_graph is None or not cell_id:
            return cell_id
        return self.cell_graph.cell(cell_id).label or cell_id

    def are_in(self, cell_ids: Collection[str], points: Array) -> NDArray[np.bool_]:
        """Tell which points (n, 2) lie in one of these cells, or nearest to one, as the grid tells, (n,)."""
        if self.cell_graph is None:
            return np.zeros(len(points), dtype=bool)
        numbers = [self.cell_graph.index_from_id[cell_id] for cell_id in cell_ids]
        return np.isin(self.cell_indices[self.range_table.lines_at(points)], numbers)


def build_atlas(sketch: SchematicMap, settings: AtlasSettings) -> Atlas:
    """Derive from a drawing all that localization needs.

    Raises NotEnclosedError if all of it is one point.
    """
    if sketch.diagonal == 0.0:
        raise NotEnclosedError(NOTHING)
    range_table = build_range_table(sketch, settings.range_table)
    try:
        cell_graph = decompose(sketch, settings.decomposition)
    except NotEnclosedError:  # it encloses no free space: there is still something to see
        cell_graph = None
    corners = find_drawn_corners(sketch, cell_graph, settings.detail)
    return Atlas(
        sketch, range_table, cell_graph, corners, guess_log_scale(sketch, range_table, settings.scale_guess)
    )


def find_drawn_corners(sketch: SchematicMap, cell_graph: CellGraph | None, detail: float) -> Corners:
    """Find corners of the strongly simplified strokes, from both sides, and of the cells, from within.

    Strokes that only touch make a corner too: it is the outline of a cell that shows it.
    """
    least = Simplification(detail * sketch.diagonal)
    of_strokes = find_corners(simplify_all(sketch.strokes, least))
    outlines = [Polyline(cell.outline, closed=True) for cell in cell_graph.cells] if cell_graph else []
    of_cells = find_corners(simplify(outline, least) for outline in outlines)
    return of_strokes.joined(of_strokes.reversed()).joined(of_cells)


def guess_log_scale(sketch: SchematicMap, range_table: RangeTable, guess: ScaleGuess) -> float:
    """Guess log drawing units per metre: the mean of what the drawing's size and its clearance say.

    Neither is exact, but they err apart: a large building has wide halls and narrow corridors both.
    """
    by_size = math.log(sketch.diagonal / guess.diagonal)
    by_clearance = math.log(float(np.median(range_table.clearances)) / guess.clearance)
    return (by_size + by_clearance) / 2
