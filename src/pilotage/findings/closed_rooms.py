"""Find rooms without a door, and closed areas that were not taken for rooms."""

from collections.abc import Iterator

import numpy as np
import shapely

from pilotage.findings.doors import NOWHERE, suggest_door
from pilotage.findings.finding import Finding, Severity
from pilotage.findings.words import named, quoted
from pilotage.geometry import Array
from pilotage.interpretation import Interpretation, Role
from pilotage.maps import CellGraph, Division, SchematicMap
from pilotage.maps.routing.forgotten_doors import door_width

SOLID = 0.005
"""A closed area of less than this share of all cells is not worth a word."""

ALONG = 0.003
"""An outline is open where it is farther than this from all strokes, as a share of the drawing's diameter."""

LEAST_DOOR = 0.4
"""A door to the outside has at least this share of the usual width."""

FURNITURE = 0.15
"""What has no name and is smaller than this share of the median room is probably furniture or a void."""


def find_rooms_without_door(
    sketch: SchematicMap, graph: CellGraph, drawn: Array, to_open: str, *, joined: bool
) -> Iterator[Finding]:
    """Find cells that no gateway leads to; `drawn` are places of drawn doors, (n, 2).

    Unless doors have `joined` any rooms, `find_no_door` tells of all, and only those that open outwards are
    told here.
    """
    rooms = [cell for cell in graph.cells if not graph.gateways_of(cell.cell_id)]
    if len(graph.cells) == 1 or not rooms:
        return
    strokes = shapely.STRtree([shapely.LineString(stroke.ring) for stroke in sketch.strokes])
    usual = float(np.median([cell.polygon.area for cell in graph.cells if cell not in rooms] or [0.0]))
    for cell in rooms:
        others = [other.polygon for other in graph.cells if other is not cell]
        mend = suggest_door(cell.polygon, others, graph, drawn)
        text, advice = f"no door leads into {named(cell)}", f"{to_open} in its wall where the door is"
        is_void = not cell.label and cell.polygon.area < FURNITURE * usual
        if is_void:
            advice = f"if it is furniture or a void, nothing is to be done; if it is a room, {advice}"
        elif is_open(cell.polygon.exterior, strokes, LEAST_DOOR * door_width(graph), ALONG * graph.diameter):
            text += ", except from outside of what is drawn"
            advice = f"draw the walls around the place where it leads, or {to_open} in another wall"
        elif not joined:
            continue
        severity = Severity.NOTE if is_void else Severity.WARNING
        yield Finding("room-without-door", severity, text, advice, cell.center, (cell.cell_id,), mend)


def find_closed_areas(sketch: SchematicMap, division: Division, to_open: str) -> Iterator[Finding]:
    """Find what is enclosed and still no cell: taken for solid, as no door leads into it, or for outdoors."""
    graph = division.graph
    strokes = shapely.STRtree([shapely.LineString(stroke.ring) for stroke in sketch.strokes])
    near, width = ALONG * graph.diameter, door_width(graph)
    rooms = [cell.polygon for cell in graph.cells]
    cells = shapely.union_all(rooms)
    beside = shapely.buffer(cells, near)
    seam = 1e-6 * graph.diameter
    left = shapely.difference(division.space.region, shapely.buffer(cells, seam))
    for area in shapely.get_parts(left):
        names = [label.text for label in sketch.labels if area.covers(shapely.Point(label.position))]
        if not names and area.area < SOLID * cells.area:
            continue
        inner = shapely.point_on_surface(area)
        what = f"{quoted(names)} stand{'s' * (len(names) == 1)} in an area" if names else "an area"
        if is_open(shapely.difference(area.exterior, beside), strokes, width, near):
            kind, why, mend = "open-area", "open to the outside and taken for outdoors", None
            advice = "if a robot may drive there, draw a line where it ends"
        else:
            kind, why = "closed-area", "closed on all sides and taken for solid"
            advice, mend = f"if it is a room, {to_open} where its door is", suggest_door(area, rooms, graph)
        severity = Severity.WARNING if names else Severity.NOTE
        where = float(inner.x), float(inner.y)
        yield Finding(kind, severity, f"{what} that is {why}", advice, where, (), mend)


def is_open(outline: shapely.Geometry, strokes: shapely.STRtree, width: float, near: float) -> bool:
    """Tell whether no stroke runs near an outline over this width in one piece."""
    beside = strokes.geometries[strokes.query(outline, predicate="dwithin", distance=near)]
    walls = shapely.union_all(shapely.buffer(beside, near))
    parts = shapely.get_parts(shapely.line_merge(shapely.difference(outline, walls)))
    return bool((shapely.length(parts) + 2.0 * near > width).any())


def drawn_doors(interpretation: Interpretation | None) -> Array:
    """List the ends of all marks that were taken for doors, (n, 2)."""
    if interpretation is None:
        return NOWHERE
    pairs = zip(interpretation.sheet.marks, interpretation.meanings, strict=True)
    doors = [line.vertices for mark, meaning in pairs if meaning.role is Role.DOOR for line in mark.outlines]
    return np.vstack([NOWHERE, *(vertices[[0, -1]] for vertices in doors)])
