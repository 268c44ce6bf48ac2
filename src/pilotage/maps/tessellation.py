"""Cut the plane along its narrowings: pieces, and the openings between them."""

from dataclasses import dataclass, replace

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps.narrowings import find_chords
from pilotage.maps.voronoi import GRID_STEPS, find_voronoi

NUDGE = 0.01
"""How far beside a chord its two pieces are looked for, as a share of its width."""

STEPS_A_NODE = 4.0
"""How much coarser than the grid of the Voronoi diagram that of the pieces is: its rounding goes away."""


@dataclass(frozen=True, eq=False)
class Tessellation:
    """Pieces between walls and chords, and the chords through which one goes from piece to piece."""

    pieces: NDArray[np.object_]  # (p,) polygons
    reaches: Array  # (p,) width of the widest disc between walls that is centered in the piece
    areas: Array  # (p,)
    chords: Array  # (n, 2, 2) each from wall to wall
    widths: Array  # (n,)
    sides: NDArray[np.int64]  # (n, 2) the pieces left and right of each chord

    def with_chords(self, kept: NDArray[np.bool_]) -> "Tessellation":
        """Leave the other chords out: what they opened is closed."""
        return replace(self, chords=self.chords[kept], widths=self.widths[kept], sides=self.sides[kept])

    def connected(self, among: NDArray[np.bool_]) -> NDArray[np.int64]:
        """Find connected parts among some pieces and number them, (p,); all other pieces get -1."""
        graph = rustworkx.PyGraph()
        graph.add_nodes_from(range(len(self.pieces)))
        inner = among[self.sides].all(axis=1)
        graph.add_edges_from_no_data([(int(a), int(b)) for a, b in self.sides[inner]])
        parts = np.full(len(self.pieces), -1, dtype=np.int64)
        members = [sorted(part) for part in rustworkx.connected_components(graph)]
        for number, part in enumerate(sorted(members)):
            parts[part] = number
        parts[~among] = -1
        return parts


def tessellate(walls: Array) -> Tessellation:
    """Cut what walls (n, 4) enclose along its chords."""
    diagram = find_voronoi(walls)
    chords = find_chords(diagram)
    step = STEPS_A_NODE * float(np.ptp(walls.reshape(-1, 2), axis=0).max()) / GRID_STEPS
    lines = np.vstack([diagram.segments, chords.segments.reshape(-1, 4)]).reshape(-1, 2, 2)
    noded = shapely.union_all(shapely.linestrings(lines), grid_size=step)
    pieces = np.array(shapely.get_parts(shapely.polygonize(shapely.get_parts(noded))))
    tree = shapely.STRtree(pieces)
    sides = find_sides(tree, chords.segments)
    useful = (sides[:, 0] != sides[:, 1]) & (sides >= 0).all(axis=1)
    reaches = np.zeros(len(pieces))
    vertices, holders = tree.query(shapely.points(diagram.vertices), predicate="within")
    np.maximum.at(reaches, holders, 2.0 * diagram.clearances[vertices])
    np.maximum.at(reaches, sides[useful].ravel(), np.repeat(chords.widths[useful], 2))
    tessellation = Tessellation(pieces, reaches, shapely.area(pieces), chords.segments, chords.widths, sides)
    return tessellation.with_chords(useful)


def find_sides(tree: shapely.STRtree, chords: Array) -> NDArray[np.int64]:
    """Find the pieces left and right of each chord's middle, (n, 2); -1 where there is none."""
    across = chords[:, 1] - chords[:, 0]
    nudge = NUDGE * np.column_stack([-across[:, 1], across[:, 0]])
    middle = chords.mean(axis=1)
    sides = np.full((len(chords), 2), -1, dtype=np.int64)
    for side, points in enumerate((middle + nudge, middle - nudge)):
        found, pieces = tree.query(shapely.points(points), predicate="within")
        sides[found, side] = pieces
    return sides
