"""Find names that are missing, doubled or nowhere, and rooms whose name forbids to drive there."""

from collections.abc import Iterator

import numpy as np
import shapely

from pilotage.findings.doors import NAMED
from pilotage.findings.finding import Finding, Severity
from pilotage.findings.words import named, quoted
from pilotage.interpretation import Role
from pilotage.interpretation.names import MEANING, name_words
from pilotage.maps import Cell, CellGraph, Division, SchematicMap, Zones
from pilotage.maps.routing.places import folded

UNNAMED = 2.0
"""Rooms without a name are pieces of others if they are so many times as many as those that have one."""

KEPT_OUT = 0.8
"""A room is kept out if zones cover this share of it."""


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
    yield from find_same_names(graph)
    yield from find_several_names(sketch, graph)


def find_same_names(graph: CellGraph) -> Iterator[Finding]:
    """Find names that several rooms have."""
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


def find_several_names(sketch: SchematicMap, graph: CellGraph) -> Iterator[Finding]:
    """Find rooms that have several names."""
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
