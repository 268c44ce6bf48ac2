"""What the robot would understand of a drawing: cells, gateways, names, findings and a route; in a worker."""

import time
from collections import Counter
from itertools import pairwise

import numpy as np
import shapely

from pilotage.config import Settings
from pilotage.maps import (
    CellGraph,
    NotEnclosedError,
    RouteError,
    SchematicMap,
    check_place,
    decompose,
    find_labeled,
    find_route,
)
from pilotage.web.drawings import Json, Page, UnreadableError, describe_drawing, read_sent
from pilotage.web.order import Place, Sent


def understand(sent: Sent, ends: tuple[Place, Place] | None = None) -> Json:
    """Say what is understood of a drawing, and how one goes from place to place on it.

    A drawing that shows or encloses nothing has no cells, and a finding that says why.
    """
    began = time.perf_counter()
    try:
        sketch = read_sent(sent)
    except UnreadableError as error:
        return {
            "v": 1,
            "ms": elapsed(began),
            **NOTHING,
            "findings": [finding("unreadable", "error", str(error))],
        }
    page = Page(sketch)
    told = {"v": 1, **describe_drawing(sketch)}
    try:
        graph = decompose(sketch, Settings().localizer.atlas.decomposition)
    except NotEnclosedError as error:
        findings = [finding("nothing enclosed", "error", str(error))]
        return {**NOTHING, **told, "ms": elapsed(began), "findings": findings}
    findings = find_faults(sketch, graph)
    route = None
    if ends is not None:
        try:
            route = describe_route(page, graph, ends)
        except RouteError as error:
            findings.append(finding("no route", "warning", str(error)))
    told["labels"] = [
        {"text": label.text, **dict(zip("xy", page.point(label.position) or [], strict=True)), "cell": cell}
        for label, cell in zip(sketch.labels, cells_of_labels(sketch, graph), strict=True)
    ]
    return {**told, **describe_cells(page, graph), "findings": findings, "route": route, "ms": elapsed(began)}


NOTHING: Json = {
    "bounds": [0, 0, 0, 0],
    "strokes": [],
    "cells": [],
    "gateways": [],
    "labels": [],
    "start": None,
    "goal": None,
    "route": None,
}


def describe_cells(page: Page, graph: CellGraph) -> Json:
    """List cells and gateways."""
    return {
        "cells": [
            {
                "id": cell.cell_id,
                "name": cell.label,
                "size": cell.size.value,
                "outline": page.points(cell.outline),
                "holes": [page.points(hole) for hole in cell.holes],
                "center": page.point(cell.center),
                "neighbors": [
                    {"cell": one.cell_id, "gateway": one.gateway_id} for one in graph.neighbors(cell.cell_id)
                ],
            }
            for cell in graph.cells
        ],
        "gateways": [
            {"id": one.gateway_id, "cells": list(one.cell_ids), "segment": page.points(one.segment)}
            for one in graph.gateways
        ],
    }


def describe_route(page: Page, graph: CellGraph, ends: tuple[Place, Place]) -> Json:
    """Find a route between two places; RouteError if there is none."""
    points = []
    for what, place in zip(("start", "goal"), ends, strict=True):
        if isinstance(place, str):
            points.append(find_labeled(graph, place))
            continue
        x, y = page.sketch.sketch_from_file(np.array([page.file_point(*place)]))[0].tolist()
        check_place(graph, (x, y), what)
        points.append((x, y))
    route = find_route(graph, points[0], points[1], Settings().navigator.route)
    return {
        "cells": list(route.cell_ids),
        "gateways": list(route.gateway_ids),
        "way": page.points(route.way),
        "cost": round(route.cost, 4),
    }


def cells_of_labels(sketch: SchematicMap, graph: CellGraph) -> list[str]:
    """Name the cell in which each label stands; empty for one that stands in none."""
    found = []
    for label in sketch.labels:
        cell_id = graph.cell_at(label.position)
        found.append(cell_id if graph.distance_to(cell_id, label.position) == 0.0 else "")
    return found


def find_faults(sketch: SchematicMap, graph: CellGraph) -> list[Json]:
    """Find what a person probably did not mean."""
    page = Page(sketch)
    findings = []
    for cell in graph.cells:
        if len(graph.cells) > 1 and not graph.gateways_of(cell.cell_id):
            name = cell.label or cell.cell_id
            mend = door_into(page, graph, cell.cell_id)
            text = f"{name} has no door, nobody can go there"
            findings.append(finding("no door", "warning", text, page.point(cell.center), mend))
    names = Counter(cell.label.casefold() for cell in graph.cells if cell.label)
    for cell in graph.cells:
        if names[cell.label.casefold()] > 1:
            text = f"two rooms are called {cell.label}, so the name is no goal"
            findings.append(finding("same name", "note", text, page.point(cell.center)))
    for label, cell_id in zip(sketch.labels, cells_of_labels(sketch, graph), strict=True):
        if not cell_id:
            text = f'"{label.text}" stands in no room'
            findings.append(finding("label outside", "note", text, page.point(label.position)))
    for what, point in (("goal", sketch.goal), ("start", sketch.start)):
        if point is not None:
            try:
                check_place(graph, point, what)
            except RouteError as error:
                findings.append(finding(f"{what} outside", "error", str(error), page.point(point)))
    return findings


def door_into(page: Page, graph: CellGraph, cell_id: str) -> Json | None:
    """Propose where to cut a door into a cell: in the longest straight wall that it shares with another."""
    widths = [gateway.width for gateway in graph.gateways]
    polygon = graph.cell(cell_id).polygon
    width = float(np.median(widths)) if widths else 0.2 * float(np.sqrt(polygon.area))
    thickest = 0.5 * width
    others = shapely.union_all([cell.polygon for cell in graph.cells if cell.cell_id != cell_id])
    ring = shapely.get_coordinates(polygon.exterior)
    shared = [
        part
        for ends in pairwise(ring)
        for part in shapely.get_parts(shapely.LineString(ends).intersection(others.buffer(thickest)))
        if part.geom_type == "LineString"
    ]
    if not shared:
        return None
    wall = max(shared, key=lambda part: float(part.length))
    half = min(width, 0.8 * float(wall.length)) / 2.0
    middle = float(wall.length) / 2.0
    opening = [shapely.get_coordinates(wall.interpolate(middle + side))[0] for side in (-half, half)]
    return {"kind": "cut", "text": "cut a door here?", "segment": page.points(np.array(opening))}


def finding(
    kind: str, severity: str, text: str, where: list[float] | None = None, mend: Json | None = None
) -> Json:
    """Tell one finding."""
    return {"kind": kind, "severity": severity, "text": text, "where": where, "mend": mend}


def elapsed(began: float) -> float:
    """Return the milliseconds since then."""
    return round(1e3 * (time.perf_counter() - began), 1)
