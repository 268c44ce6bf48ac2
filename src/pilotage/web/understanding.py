"""What the robot would understand of a drawing: cells, gateways, names, findings and a route; in a worker."""

import time

import numpy as np

from pilotage.config import Settings
from pilotage.findings import Finding, Severity, report
from pilotage.maps import CellGraph, RouteError, SchematicMap, check_place, find_labeled, find_route
from pilotage.web.drawings import ZONES, Json, Page, UnreadableError, describe_drawing, labels_of, read_sent
from pilotage.web.order import Place, Sent


def understand(sent: Sent, ends: tuple[Place, Place] | None = None, settings: Settings | None = None) -> Json:
    """Say what is understood of a drawing, and how one goes from place to place on it.

    A drawing that shows or encloses nothing has no cells, and a finding that says why. `settings` are the
    defaults if they are None.
    """
    began = time.perf_counter()
    try:
        drawing = read_sent(sent)
    except UnreadableError as error:
        findings = [failure("unreadable", Severity.ERROR, str(error))]
        return {"v": 1, "ms": elapsed(began), **NOTHING, "findings": findings}
    sketch, page = drawing.sketch, Page(drawing.sketch)
    found = report(
        sketch, drawing.interpretation, settings=(settings or Settings()).localizer.atlas.decomposition
    )
    findings = [describe_finding(page, one) for one in found.findings]
    told = {**NOTHING, "v": 1, **describe_drawing(sketch), "assumed": list(drawing.remarks)}
    if found.graph is not None:
        told |= describe_cells(page, found.graph)
        cells = cells_of_labels(sketch, found.graph)
        told["labels"] = [
            {**label, "cell": cell} for label, cell in zip(labels_of(sketch), cells, strict=True)
        ]
    if found.graph is not None and ends is not None:
        try:
            told["route"] = describe_route(page, found.graph, ends)
        except RouteError as error:
            findings.append(failure("no-route", Severity.WARNING, str(error)))
    return {**told, "findings": findings, "ms": elapsed(began)}


NOTHING: Json = {
    "bounds": [0, 0, 0, 0],
    "strokes": [],
    "cells": [],
    "gateways": [],
    "labels": [],
    "zones": {name: [] for name in ZONES},
    "assumed": [],
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
    route = find_route(graph, points[0], points[1], Settings().navigator.route, zones=page.sketch.zones)
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


def describe_finding(page: Page, one: Finding) -> Json:
    """Tell one finding, and what a pen would do about it."""
    mend = None
    if one.mend is not None:
        segment = [page.from_file(point) for point in one.mend.segment]
        mend = {"kind": one.mend.kind.value, "text": one.mend.words, "segment": segment}
    return {
        "kind": one.kind,
        "severity": one.severity.value,
        "text": one.text,
        "advice": one.advice,
        "where": None if one.where is None else page.from_file(one.where),
        "mend": mend,
    }


def failure(kind: str, severity: Severity, text: str) -> Json:
    """Tell as a finding why something could not be done."""
    told = {"text": text, "advice": "", "where": None, "mend": None}
    return {"kind": kind, "severity": severity.value, **told}


def elapsed(began: float) -> float:
    """Return the milliseconds since then."""
    return round(1e3 * (time.perf_counter() - began), 1)
