"""What looks wrong with rooms: no door, no way, and names that are missing, doubled or nowhere."""

from collections.abc import Iterator

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.findings.doors import NAMED, NOWHERE, suggest_door
from pilotage.findings.finding import Finding, Severity
from pilotage.geometry import Array
from pilotage.interpretation import GAP, Interpretation, Role
from pilotage.interpretation.names import MEANING, name_words
from pilotage.maps import Cell, CellGraph, Division, SchematicMap, Zones
from pilotage.maps.routing.forgotten_doors import door_width
from pilotage.maps.routing.places import connected_cells, folded

BUILDING = 0.2
"""A part that cannot be reached is a building of its own from this share of the largest part's area on."""

APART = 0.04
"""And if it is so far from it that no wall is between, as a share of the drawing's diameter."""

WHOLE, FEW = 0.6, 3
"""A drawing is in pieces if its largest part has less than this share of the floor, beside so many others."""

MISREAD = (
    "walls or doors are not understood as they are meant: the picture of --figure shows how;"
    " erase what is no wall, leave gaps for doors, or say what a layer or color is"
    " (--layer NAME=furniture); a photo is best traced at the drawing table"
)
"""What to do about a drawing in pieces; a map, which tells walls and doors, lacks doors."""

SOLID = 0.005
"""A closed area of less than this share of all cells is not worth a word."""

UNNAMED = 2.0
"""Rooms without a name are pieces of others if they are so many times as many as those that have one."""

KEPT_OUT = 0.8
"""A room is kept out if zones cover this share of it."""

LISTED = 3
"""So many words are listed before the rest is counted."""

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


def find_parts(graph: CellGraph, to_open: str) -> Iterator[Finding]:
    """Find cells that cannot be reached from the rest, drawings in pieces, and sheets of two buildings."""
    parts = connected_cells(graph)
    shapes = [shapely.union_all([graph.cell(name).polygon for name in part]) for part in parts]
    hulls, areas = shapely.convex_hull(shapes), shapely.area(shapes)
    stands_apart = (areas > BUILDING * areas[0]) & ~shapely.intersects(hulls, hulls[0])
    stands_apart &= ~in_one_building(shapes, APART * graph.diameter)
    beside = [number for number in range(1, len(parts)) if not stands_apart[number]]
    if len(beside) >= FEW and areas[0] < WHOLE * areas[[0, *beside]].sum():
        count = sum(len(parts[number]) for number in (0, *beside))
        yield Finding(
            "in-pieces",
            Severity.WARNING,
            f"doors join only {len(parts[0])} of {count} rooms",
            MISREAD if to_open == GAP else f"{to_open} in the wall wherever a door is",
        )
    for number in range(1, len(parts)):
        if len(parts[number]) < 2:
            continue  # a room without a door
        cells = [cell for cell in graph.cells if cell.cell_id in parts[number]]
        listed = ", ".join(named(cell) for cell in cells[:4]) + (", ..." if len(cells) > 4 else "")
        if stands_apart[number]:
            yield Finding(
                "two-buildings",
                Severity.WARNING,
                f"the sheet shows more than one building or floor ({listed} stand apart)",
                "draw each in a file of its own; until then the robot stays where it starts",
                cells[0].center,
                tuple(cell.cell_id for cell in cells),
            )
        else:
            yield Finding(
                "unreachable",
                Severity.WARNING,
                f"{listed} cannot be reached from the rest of the building",
                f"{to_open} where the door between them is",
                cells[0].center,
                tuple(cell.cell_id for cell in cells),
                suggest_door(
                    cells[0].polygon,
                    [cell.polygon for cell in graph.cells if cell.cell_id not in parts[number]],
                    graph,
                ),
            )


def in_one_building(shapes: list[shapely.Geometry], wall: float) -> NDArray[np.bool_]:
    """Tell which shapes (n,) hang with the first one, also by others, across no more than a wall."""
    network = rustworkx.PyGraph()
    network.add_nodes_from(range(len(shapes)))
    tree = shapely.STRtree(shapes)
    near = tree.query(shapes, predicate="dwithin", distance=wall).T
    network.add_edges_from_no_data(list(map(tuple, near.tolist())))
    found = np.zeros(len(shapes), dtype=bool)
    found[list(rustworkx.node_connected_component(network, 0))] = True
    return found


def find_stair_rooms(graph: CellGraph, zones: Zones) -> Iterator[Finding]:
    """Find rooms that are called stairs or lifts, and that a robot may drive into: by a door, in no zone."""
    for cell in graph.cells:
        roles = {MEANING.get(word) for word in name_words(cell.label)}
        if Role.STAIRS in roles and graph.gateways_of(cell.cell_id) and not is_kept_out(cell, zones):
            yield Finding(
                "stairs-room",
                Severity.NOTE,
                f"{named(cell)} counts as a room that a robot may drive in",
                "if it may not, outline it on a layer named 'keep-out'",
                cell.center,
                (cell.cell_id,),
            )


def is_kept_out(cell: Cell, zones: Zones) -> bool:
    """Tell whether keep-out zones cover a room; they may be drawn a little unevenly."""
    covered = shapely.intersection(cell.polygon, zones.keep_out_area).area
    return bool(covered >= KEPT_OUT * cell.polygon.area)


def find_names(sketch: SchematicMap, division: Division) -> Iterator[Finding]:
    """Find labels outside of rooms, names that several rooms have, and rooms that have several names."""
    graph = division.graph
    if not any(cell.label for cell in graph.cells):
        yield Finding(
            "no-names",
            Severity.NOTE,
            "no room has a name",
            "write names into the rooms, or give them by --label NAME=X,Y",
        )
    yield from find_stray_labels(sketch, division)
    yield from find_cut_rooms(graph)
    by_name: dict[str, list[Cell]] = {}
    for cell in graph.cells:
        if cell.label:
            by_name.setdefault(folded(cell.label), []).append(cell)
    for cells in by_name.values():
        if len(cells) > 1:
            yield Finding(
                "same-name",
                Severity.NOTE,
                f"{len(cells)} rooms are called {cells[0].label!r}",
                "number them (--label NAME=X,Y names one anew), or say which by X,Y",
                cells[1].center,
                tuple(cell.cell_id for cell in cells),
            )
    written = {label.text for label in sketch.labels}
    for cell in graph.cells:
        if cell.label in written:  # one name, though it may have a comma
            continue
        names = dict.fromkeys(cell.label.split(", "))  # one that is written twice is one
        words = [word for word in names if not word.isdecimal()]  # a room has a number, too
        if len(words) > 1:
            yield Finding(
                "several-names",
                Severity.NOTE,
                f"{quoted(words)} stand in one room",
                "this is right for an open space; else draw the wall between them",
                cell.center,
                (cell.cell_id,),
            )


def find_cut_rooms(graph: CellGraph) -> Iterator[Finding]:
    """Find drawings that name their rooms and fall into many more cells without a name."""
    unnamed = [cell for cell in graph.cells if not cell.label]
    named_count = len(graph.cells) - len(unnamed)
    if named_count < NAMED or len(unnamed) < UNNAMED * named_count:
        return
    yield Finding(
        "cut-rooms",
        Severity.NOTE,
        f"{len(unnamed)} of {len(graph.cells)} rooms have no name: furniture may cut rooms in pieces",
        "look at the picture of --figure; if it does, erase it, or say what it is by its layer or color:"
        " --layer NAME=furniture",
        unnamed[0].center,
        tuple(cell.cell_id for cell in unnamed),
    )


def find_stray_labels(sketch: SchematicMap, division: Division) -> Iterator[Finding]:
    """Find labels that stand in no room; those in closed areas are told by `find_closed_areas`."""
    if not sketch.labels:
        return
    points = shapely.points([label.position for label in sketch.labels])
    cells = np.array([cell.polygon for cell in division.graph.cells])
    in_cell = shapely.STRtree(cells).query(points, predicate="intersects")[0]
    in_closed = shapely.covers(division.space.region, points)
    outdoors = shapely.union_all(division.space.tessellation.pieces[division.space.outside])
    homeless = [number for number in range(len(points)) if number not in in_cell and not in_closed[number]]
    is_out = {number: outdoors.is_empty or outdoors.covers(points[number]) for number in homeless}
    for where, numbers in (
        ("outside of all rooms", [number for number in homeless if is_out[number]]),
        ("on a wall", [number for number in homeless if not is_out[number]]),
    ):
        if numbers:
            texts = [sketch.labels[number].text for number in numbers]
            yield Finding(
                "label-outside",
                Severity.NOTE,
                f"{quoted(texts)} stand{'s' if len(texts) == 1 else ''} {where}",
                "move what names a room into the room; a title may stay where it is",
                sketch.labels[numbers[0]].position,
            )


def named(cell: Cell) -> str:
    """Name a cell as a person would."""
    return repr(cell.label) if cell.label else cell.cell_id


def quoted(words: list[str]) -> str:
    """List words in quotation marks, a few of them if they are many.

    >>> quoted(["Kitchen", "Hall"]), quoted(["a", "b", "c", "d", "e"])
    ("'Kitchen' and 'Hall'", "'a', 'b', 'c' and 2 more")
    """
    shown = [repr(word) for word in (words if len(words) <= LISTED + 1 else words[:LISTED])]
    shown += [f"{len(words) - LISTED} more"] if len(words) > len(shown) else []
    return " and ".join([", ".join(shown[:-1]), shown[-1]]) if len(shown) > 1 else shown[0]
