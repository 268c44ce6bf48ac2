"""Find free space in a drawing: what its walls enclose, small gaps closed (Wolter 2001, section 4.1)."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.errors import PilotageError
from pilotage.geometry import Array, Polyline, segments_of, signed_area
from pilotage.maps.cells.drawn_doors import at_doors
from pilotage.maps.cells.tessellation import NO_SEGMENTS, Tessellation, tessellate
from pilotage.maps.schematic import SchematicMap, diameter_of
from pilotage.shape.simplify import Simplification, simplify_all

FRAME = 0.5
"""Margin of outside around the drawing, as a share of its diameter: wider than any pocket is deep."""

AT_FRAME = 1e-5
"""A piece reaches the frame if it comes this near to it, as a share of the frame's longer side: rounding."""

BLOB = 0.01
"""Smaller free-standing groups of strokes are dropped, as a share of the diameter: chairs, letters, blots."""

NOTHING = "a drawing must enclose free space, this one encloses none: no closed room"


class NotEnclosedError(PilotageError, ValueError):
    """A drawing holds no free space: no stroke closes a room."""


@dataclass(frozen=True, slots=True)
class DecompositionSettings:
    """What is too small to matter in a drawing; lengths are shares of its diameter."""

    detail: float = 0.0015  # minimum relevance of a corner [rad]: a step of 10 cm in a 50 m building
    gap: float = 0.01  # narrower openings are closed: 50 cm in a 50 m building
    outer_opening: float = 0.2  # narrower openings to the outside are closed: open ends of corridors
    min_cell_area: float = 0.001  # a smaller cell is merged with a neighbor; share of all free space

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in self.__slots__:
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")
        if not self.outer_opening > self.gap:
            raise ValueError(f"outer_opening must be > gap, got {self.outer_opening} and {self.gap}")


@dataclass(frozen=True, eq=False)
class FreeSpace:
    """The pieces of the plane that are free, and those of the outside."""

    tessellation: Tessellation  # no chord is narrower than a gap
    inside: NDArray[np.bool_]  # (p,)
    outside: NDArray[np.bool_]  # (p,) what is neither is solid
    drawn: NDArray[np.bool_]  # (n,) which chords are doors that are drawn
    gaps: Array = field(default_factory=lambda: np.empty((0, 2, 2)))  # (n, 2, 2) too narrow, closed

    @property
    def region(self) -> shapely.Geometry:
        """All free space as one polygon or several."""
        return shapely.union_all(self.tessellation.pieces[self.inside])


def free_space(sketch: SchematicMap, settings: DecompositionSettings) -> FreeSpace:
    """Find the free space of a drawing (section 4.1).

    Of a filled plan it is what the contours enclose. Of strokes it is what cannot be reached from outside
    without passing a drawn door or an opening narrower than `outer_opening`. Yards and solid blocks are still
    among it: what tells them from rooms is how they hang together (`enclosure`).

    Raises NotEnclosedError if nothing is enclosed.
    """
    diameter = diameter_of(np.vstack([stroke.vertices for stroke in sketch.strokes]))
    if diameter == 0.0:
        raise NotEnclosedError(NOTHING)
    strokes = significant(sketch.strokes, BLOB * diameter)
    walls = simplify_all(strokes, Simplification(settings.detail * diameter))
    found = (
        within_contours(walls)
        if sketch.contours
        else within_strokes(
            walls,
            diameter,
            replace(settings, gap=min(settings.gap, thickness_of(sketch.solids) / diameter)),
            sketch.doors,
            segments_of(sketch.openings),
        )
    )
    if sketch.solids:
        found = replace(found, inside=found.inside & ~within_solids(found.tessellation, sketch.solids))
    if not found.inside.any():
        raise NotEnclosedError(NOTHING)
    return found


def significant(strokes: Sequence[Polyline], blob: float) -> Sequence[Polyline]:
    """Leave out groups of touching strokes that are smaller than a blob; keep all if all are."""
    drawn = np.array([shapely.LineString(stroke.ring) for stroke in strokes])
    touching = rustworkx.PyGraph()
    touching.add_nodes_from(range(len(drawn)))
    pairs = shapely.STRtree(drawn).query(drawn, predicate="intersects").T
    touching.add_edges_from_no_data([(int(a), int(b)) for a, b in pairs if a < b])
    kept: set[int] = set()
    for group in rustworkx.connected_components(touching):
        if diameter_of(np.vstack([strokes[index].vertices for index in sorted(group)])) >= blob:
            kept |= group
    return [strokes[index] for index in sorted(kept)] or strokes


def within_contours(strokes: tuple[Polyline, ...]) -> FreeSpace:
    """Take what closed contours enclose by the even-odd rule; all else is solid, nothing outside."""
    walls = segments_of(strokes)
    tessellation = tessellate(walls)
    loops = [shapely.Polygon(stroke.vertices) for stroke in strokes if len(stroke) > 2]
    rings = shapely.make_valid(np.array(loops, dtype=object))
    points = shapely.point_on_surface(tessellation.pieces)
    held, _ = shapely.STRtree(rings).query(points, predicate="within")
    inside = np.bincount(held, minlength=len(points)) % 2 == 1
    return FreeSpace(
        tessellation,
        inside,
        np.zeros(len(inside), dtype=bool),
        np.zeros(len(tessellation.chords), dtype=bool),
    )


def within_solids(tessellation: Tessellation, solids: Sequence[Polyline]) -> NDArray[np.bool_]:
    """Tell which pieces lie in walls that have a thickness, (p,): in an odd number of rings."""
    rings = shapely.make_valid(np.array([shapely.Polygon(ring.vertices) for ring in solids if len(ring) > 2]))
    points = shapely.point_on_surface(tessellation.pieces)
    held, _ = shapely.STRtree(rings).query(points, predicate="within")
    return np.asarray(np.bincount(held, minlength=len(points)) % 2 == 1)


def thickness_of(solids: Sequence[Polyline]) -> float:
    """Measure the mean thickness of walls by their rings; infinite if there is none.

    A door is wider, and a slip of the pen between thick walls narrower, however large the building is.
    """
    length = sum(ring.length for ring in solids) / 2.0
    return abs(sum(signed_area(ring.vertices) for ring in solids)) / length if length > 0.0 else np.inf


def within_strokes(
    strokes: tuple[Polyline, ...],
    diameter: float,
    settings: DecompositionSettings,
    doors: Sequence[Polyline] = (),
    told: Array = NO_SEGMENTS,
) -> FreeSpace:
    """Take what strokes enclose, with openings to the outside, drawn doors and gaps closed.

    Doors that are `told` (m, 4) are as narrow as they are, and so are the rooms behind them.
    """
    walls = segments_of(strokes)
    framed = tessellate(np.vstack([walls, frame_around(walls, FRAME * diameter)]), told)
    is_open = (framed.widths >= settings.gap * diameter) | framed.told
    closed = framed.with_chords(is_open)
    drawn = at_doors(closed, doors) | closed.told
    is_wide = (closed.widths >= settings.outer_opening * diameter) & ~drawn
    outside = find_outside(closed, is_wide)
    slits = closed.reaches < settings.gap * diameter
    slits[closed.sides[closed.told].ravel()] = False
    return FreeSpace(closed, ~outside & ~slits, outside, drawn, framed.chords[~is_open])


def frame_around(walls: Array, margin: float) -> Array:
    """Draw a box around walls (n, 4), (4, 4)."""
    points = walls.reshape(-1, 2)
    (left, bottom), (right, top) = points.min(axis=0) - margin, points.max(axis=0) + margin
    corners = np.array([[left, bottom], [right, bottom], [right, top], [left, top]])
    return np.hstack([corners, np.roll(corners, -1, axis=0)])


def find_outside(tessellation: Tessellation, is_wide: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Flood from the frame through wide chords (n,), (p,)."""
    bounds = shapely.bounds(tessellation.pieces)
    box = shapely.total_bounds(tessellation.pieces)
    extent = float(max(box[2] - box[0], box[3] - box[1]))
    at_frame = (np.abs(bounds - box) <= AT_FRAME * extent).any(axis=1)
    passable = tessellation.with_chords(is_wide)
    parts = passable.connected(np.ones(len(bounds), dtype=bool))
    return np.isin(parts, parts[at_frame])
