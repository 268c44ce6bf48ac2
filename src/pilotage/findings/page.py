"""What looks wrong with a sheet as a whole: far strokes, absurd scales, no rooms, marks left out."""

from collections.abc import Iterator

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from pilotage.findings.doors import suggest_door
from pilotage.findings.finding import Finding, Mend, MendKind, Severity
from pilotage.geometry import Array
from pilotage.interpretation import Interpretation
from pilotage.maps import CellGraph, SchematicMap
from pilotage.maps.routing.forgotten_doors import door_width
from pilotage.maps.schematic import diameter_of

FAR = 0.1
"""A stroke is far outside if it keeps this distance from all rooms, as a share of their diameter."""

INFLATED = 1.25
"""Strokes outside matter if they make the drawing so many times as large as its rooms."""

DOORS_M, BUILDINGS_M = (0.4, 5.0), (2.0, 2000.0)
"""Widths of doors and diameters of buildings [m] that there are."""

OPEN_ENDS = 0.25
"""Open ends of strokes are joined over at most this share of the drawing's diagonal."""

TOUCH = 1e-3
"""An end that comes this near to another stroke touches it, as a share of the drawing's diagonal."""

AROUND = 2.0
"""The two ends of one stroke are joined if it is so many times as long as the way from one to the other."""

NEIGHBORS = 3
"""The nearest end to an end is the end itself, the next may be the other one of its stroke."""


def find_far_strokes(sketch: SchematicMap, graph: CellGraph) -> Iterator[Finding]:
    """Find strokes that stand far from all rooms: all thresholds are shares of the drawing's size."""
    rooms = shapely.convex_hull(shapely.union_all([cell.polygon for cell in graph.cells]))
    size = diameter_of(shapely.get_coordinates(rooms))
    strokes = np.array([shapely.LineString(stroke.ring) for stroke in sketch.strokes])
    far = shapely.distance(strokes, rooms) > FAR * size
    if not far.any():
        return
    point = shapely.get_coordinates(strokes[far][0])[0]
    matters = graph.diameter > INFLATED * size
    count = int(far.sum())
    what = f"{count} strokes lie" if count > 1 else "a stroke lies"
    yield Finding(
        "far-strokes",
        Severity.WARNING if matters else Severity.NOTE,
        f"{what} far outside of the rooms" + (": the building looks small beside them" if matters else ""),
        "delete what is no wall, or put it on a layer named 'ignore'",
        (float(point[0]), float(point[1])),
    )


def find_scale(sketch: SchematicMap, graph: CellGraph) -> Iterator[Finding]:
    """Find a scale that no building has. It is only a prior, so that nothing breaks."""
    if sketch.metres_per_unit is None:
        return
    size, door = (length * sketch.metres_per_unit for length in (graph.diameter, door_width(graph)))
    for words, length, (low, high), is_known in (
        (f"the building is {size:.3g} m long", size, BUILDINGS_M, True),
        (f"a door is {door:.3g} m wide", door, DOORS_M, bool(graph.gateways)),
    ):
        if is_known and not low <= length <= high:
            yield Finding(
                "absurd-scale",
                Severity.NOTE,
                f"by the units of the file {words}",
                "the scale is found from the laser anyway; --scale tells it if you know it",
            )
            return


def find_marks_left_out(interpretation: Interpretation) -> Iterator[Finding]:
    """Tell what the reader could not read."""
    if interpretation.sheet.left_out:
        yield Finding(
            "left-out",
            Severity.NOTE,
            f"left out: {', '.join(interpretation.sheet.left_out)}",
            "it matters only if walls of this floor are among it",
        )


def find_no_door(graph: CellGraph, drawn: Array, to_open: str) -> Iterator[Finding]:
    """Find that all rooms of several are closed boxes; `drawn` are places of drawn doors, (n, 2)."""
    first = min(graph.cells, key=lambda cell: len(graph.gateways_of(cell.cell_id)))
    others = [cell.polygon for cell in graph.cells if cell is not first]
    mend = suggest_door(first.polygon, others, graph, drawn)
    count = sum(bool(cell.label) for cell in graph.cells)
    rooms = f"{count} rooms with a name" if graph.gateways else f"{len(graph.cells)} rooms"
    yield no_doors(f"none of the {rooms} has a door to another", to_open, mend)


def no_doors(reason: str, to_open: str, mend: Mend | None = None) -> Finding:
    """Say that all rooms are closed boxes."""
    advice = f"{to_open} in the wall wherever a door is"
    return Finding("no-doors", Severity.ERROR, reason, advice, mend=mend)


def nothing_enclosed(sketch: SchematicMap, reason: str) -> Finding:
    """Say that no room is closed, and which two ends of strokes would close best."""
    mend = join_open_ends(sketch)
    where = None if mend is None else mend.segment[0]
    advice = "close the outer walls; doors to the outside may be gaps"
    return Finding("nothing-enclosed", Severity.ERROR, reason, advice, where, (), mend)


def join_open_ends(sketch: SchematicMap) -> Mend | None:
    """Join the two nearest ends of strokes that touch nothing; None if there are none near each other."""
    ends, owners = open_ends(sketch)
    if len(ends) < 2:
        return None
    count = min(NEIGHBORS, len(ends))
    distances, others = cKDTree(ends).query(ends, count, distance_upper_bound=OPEN_ENDS * sketch.diagonal)
    lengths = np.array([stroke.length for stroke in sketch.strokes])
    is_found = np.isfinite(distances)
    itself = np.arange(len(ends))[:, None]
    partners = np.where(is_found, others, itself)
    runs_along = (owners[partners] == owners[:, None]) & (lengths[owners][:, None] < AROUND * distances)
    distances[~is_found | (partners == itself) | runs_along] = np.inf
    first, place = np.unravel_index(distances.argmin(), distances.shape)
    if not np.isfinite(distances[first, place]):
        return None
    (ax, ay), (bx, by) = ends[first].tolist(), ends[partners[first, place]].tolist()
    return Mend(MendKind.CLOSE, ((ax, ay), (bx, by)), "close this gap?")


def open_ends(sketch: SchematicMap) -> tuple[Array, NDArray[np.intp]]:
    """List the ends (n, 2) of strokes that touch no other end or stroke, and whose they are, (n,)."""
    owners = np.array([k for k, stroke in enumerate(sketch.strokes) if not stroke.closed], dtype=np.intp)
    owners = owners.repeat(2)
    pairs = [stroke.vertices[[0, -1]] for stroke in sketch.strokes if not stroke.closed]
    ends = np.array(pairs).reshape(-1, 2)
    points = shapely.points(ends)
    near = {"predicate": "dwithin", "distance": TOUCH * sketch.diagonal}
    end, other = shapely.STRtree(points).query(points, **near)
    point, stroke = shapely.STRtree([shapely.LineString(stroke.ring) for stroke in sketch.strokes]).query(
        points, **near
    )
    is_open = np.ones(len(ends), dtype=bool)
    is_open[end[end != other]] = False
    is_open[point[stroke != owners[point]]] = False
    return ends[is_open], owners[is_open]
