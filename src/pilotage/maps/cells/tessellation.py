"""Cut free space along its narrowings: pieces, and the openings between them (Wolter 2001, section 4.1)."""

from dataclasses import dataclass, replace

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps.cells.narrowings import BEHIND, find_chords, find_jambs
from pilotage.maps.cells.voronoi import GRID_STEPS, find_voronoi

STEPS_A_NODE = 4.0
"""How much coarser than the grid of the Voronoi diagram that of the pieces is: its rounding goes away."""

NO_SEGMENTS: Array = np.empty((0, 4))
"""Of a drawing whose file tells no doors."""


@dataclass(frozen=True, eq=False)
class Tessellation:
    """Pieces between walls and chords, and the chords through which one goes from piece to piece."""

    pieces: NDArray[np.object_]  # (p,) polygons
    reaches: Array  # (p,) width of the widest disc between walls that is centered in the piece
    areas: Array  # (p,)
    chords: Array  # (n, 2, 2) each from wall to wall, or to where another chord ends on it
    widths: Array  # (n,)
    jambs: Array  # (n,) how much wider free space is just beside each chord, on its narrower side
    behind: Array  # (n,) the same where one is through the wall that it is in
    sides: NDArray[np.int64]  # (n, 2) the pieces left and right of each chord
    told: NDArray[np.bool_]  # (n,) which chords are doors that the file itself tells
    posts: NDArray[np.int64]  # (n, 2) number of the group of connected walls at either end of each chord
    post_sizes: Array  # diagonal of the box around each group of walls, indexed by its number

    @property
    def widening(self) -> Array:
        """How much wider free space is beside each chord, or behind the wall that it is in, (n,)."""
        return np.maximum(self.jambs, self.behind)

    def with_chords(self, kept: NDArray[np.bool_]) -> "Tessellation":
        """Leave the other chords out: what they opened is closed."""
        return replace(
            self,
            chords=self.chords[kept],
            widths=self.widths[kept],
            jambs=self.jambs[kept],
            behind=self.behind[kept],
            sides=self.sides[kept],
            told=self.told[kept],
            posts=self.posts[kept],
        )

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


def tessellate(walls: Array, doors: Array = NO_SEGMENTS) -> Tessellation:
    """Cut what walls (n, 4) enclose along its chords, and along doors (m, 4) from jamb to jamb.

    A door is a chord by construction: no other is found as long as it stands closed.
    """
    diagram = find_voronoi(np.vstack([walls, doors]))  # section 4.1: Voronoi diagram
    chords = find_chords(diagram)  # section 4.1: narrowings
    step = STEPS_A_NODE * float(np.ptp(walls.reshape(-1, 2), axis=0).max()) / GRID_STEPS
    lines = np.vstack([diagram.segments, chords.segments.reshape(-1, 4)]).reshape(-1, 2, 2)
    noded = shapely.union_all(shapely.linestrings(lines), grid_size=step)
    pieces = shapely.orient_polygons(shapely.get_parts(shapely.polygonize(shapely.get_parts(noded))))
    edges, sides = shared_edges(pieces)
    open_edges = ~on_walls(edges, diagram.segments, 2.0 * step)
    open_edges |= on_walls(edges, doors, 2.0 * step) & ~on_walls(edges, walls, 2.0 * step)
    cuts = np.concatenate([chords.segments, doors.reshape(-1, 2, 2)])
    openings, sides, cut = join_edges(edges[open_edges], sides[open_edges], cuts)
    widths = np.hypot(*(openings[:, 1] - openings[:, 0]).T)
    vertices, holders = shapely.STRtree(pieces).query(shapely.points(diagram.vertices), predicate="within")
    reaches = np.zeros(len(pieces))
    np.maximum.at(reaches, holders, 2.0 * diagram.clearances[vertices])
    np.maximum.at(reaches, sides.ravel(), np.repeat(widths, 2))
    jambs = find_jambs(openings, diagram.segments)
    behind = find_jambs(openings, diagram.segments, BEHIND)
    told = cut >= len(chords.segments)
    posts, post_sizes = find_posts(openings, diagram.segments)
    areas = shapely.area(pieces)
    return Tessellation(
        pieces, reaches, areas, openings, widths, jambs, behind, sides, told, posts, post_sizes
    )


def shared_edges(pieces: NDArray[np.object_]) -> tuple[Array, NDArray[np.int64]]:
    """Find the edges between two pieces, (k, 2, 2), and the pieces left and right of each, (k, 2)."""
    rings, owners = shapely.get_rings(pieces, return_index=True)
    points, ring_of = shapely.get_coordinates(rings, return_index=True)
    following = ring_of[1:] == ring_of[:-1]
    edges = np.stack([points[:-1], points[1:]], axis=1)[following]
    owner = owners[ring_of[:-1][following]]
    forward = edges.reshape(-1, 4)
    there = {edge: int(piece) for edge, piece in zip(map(tuple, forward.tolist()), owner, strict=True)}
    back = [there.get((c, d, a, b), -1) for a, b, c, d in forward.tolist()]
    right = np.array(back, dtype=np.int64)
    once = (right >= 0) & (owner < right)
    return edges[once], np.column_stack([owner, right])[once]


def find_posts(openings: Array, walls: Array) -> tuple[NDArray[np.int64], Array]:
    """Group walls (k, 4) that share ends; they cross nowhere.

    Returns the group at either end of each opening (n, 2, 2), (n, 2), and the size of each group.
    """
    ends, numbers = np.unique(walls.reshape(-1, 2), axis=0, return_inverse=True)
    graph = rustworkx.PyGraph()
    graph.add_nodes_from(range(len(ends)))
    graph.add_edges_from_no_data([(int(a), int(b)) for a, b in numbers.reshape(-1, 2)])
    parts = sorted(sorted(part) for part in rustworkx.connected_components(graph))
    sizes = np.array([np.hypot(*np.ptp(ends[part], axis=0)) for part in parts])
    part_of = np.empty(len(ends), dtype=np.int64)
    for number, part in enumerate(parts):
        part_of[part] = number
    nearest = shapely.STRtree(shapely.linestrings(walls.reshape(-1, 2, 2))).nearest(
        shapely.points(openings.reshape(-1, 2))
    )
    return part_of[numbers.reshape(-1, 2)[nearest, 0]].reshape(-1, 2), sizes


def on_walls(edges: Array, walls: Array, tolerance: float) -> NDArray[np.bool_]:
    """Tell which edges (k, 2, 2) lie on a wall (n, 4)."""
    if len(edges) == 0 or len(walls) == 0:
        return np.zeros(len(edges), dtype=bool)
    tree = shapely.STRtree(shapely.linestrings(walls.reshape(-1, 2, 2)))
    near, _ = tree.query(shapely.points(edges.mean(axis=1)), predicate="dwithin", distance=tolerance)
    found = np.zeros(len(edges), dtype=bool)
    found[near] = True
    return found


def join_edges(
    edges: Array, sides: NDArray[np.int64], chords: Array
) -> tuple[Array, NDArray[np.int64], NDArray[np.int64]]:
    """Join the edges of one chord between the same two pieces.

    Returns openings (n, 2, 2), their sides (n, 2) and the chord of each (n,).
    """
    if len(edges) == 0:
        return np.empty((0, 2, 2)), np.empty((0, 2), dtype=np.int64), np.empty(0, dtype=np.int64)
    chord = shapely.STRtree(shapely.linestrings(chords)).nearest(shapely.points(edges.mean(axis=1)))
    start = np.einsum("ki,ki->k", edges[:, 0], edges[:, 1] - edges[:, 0])
    start /= np.hypot(*(edges[:, 1] - edges[:, 0]).T)  # how far along its own direction an edge begins
    order = np.lexsort((start, sides[:, 1], sides[:, 0], chord))
    keys = np.column_stack([chord, sides])[order]
    first = np.append(True, (keys[1:] != keys[:-1]).any(axis=1))
    last = np.append(first[1:], True)
    openings = np.stack([edges[order[first], 0], edges[order[last], 1]], axis=1)
    return openings, sides[order[first]], chord[order[first]]
