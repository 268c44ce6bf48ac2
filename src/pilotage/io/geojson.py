"""Write cells, gateways and a route as GeoJSON, in the units and axes of the drawing's own file."""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from pilotage.geometry import Array
from pilotage.io.files import write_text
from pilotage.maps import Cell, CellGraph, Gateway, Route, SchematicMap

Feature = dict[str, object]


def write_cells(path: Path | str, sketch: SchematicMap, graph: CellGraph, route: Route | None = None) -> None:
    """Write a collection of features: polygons of cells, lines of gateways, and the line of a route.

    GeoJSON is used only as a container: the coordinates are the drawing's, no longitude and latitude.
    """
    features = [cell_feature(cell, sketch, graph) for cell in graph.cells]
    features += [gateway_feature(gateway, sketch) for gateway in graph.gateways]
    if route is not None:
        features.append(route_feature(route, sketch))
    write_text(path, json.dumps({"type": "FeatureCollection", "features": features}, indent=1) + "\n")


def cell_feature(cell: Cell, sketch: SchematicMap, graph: CellGraph) -> Feature:
    """Write a cell with its size, label and neighbors."""
    neighbors = [
        {
            "cell": neighbor.cell_id,
            "gateway": neighbor.gateway_id,
            "direction": neighbor.direction,
            "distance": neighbor.distance,
        }
        for neighbor in graph.neighbors(cell.cell_id)
    ]
    properties = {
        "kind": "cell",
        "id": cell.cell_id,
        "size": cell.size.value,
        "label": cell.label,
        "neighbors": neighbors,
    }
    rings = [coordinates(np.vstack([ring, ring[:1]]), sketch) for ring in (cell.outline, *cell.holes)]
    return feature("Polygon", rings, properties)


def gateway_feature(gateway: Gateway, sketch: SchematicMap) -> Feature:
    """Write a gateway with the two cells it joins."""
    properties = {"kind": "gateway", "id": gateway.gateway_id, "cells": list(gateway.cell_ids)}
    return feature("LineString", coordinates(gateway.segment, sketch), properties)


def route_feature(route: Route, sketch: SchematicMap) -> Feature:
    """Write a route with its cells, gateways and cost."""
    properties = {
        "kind": "route",
        "cells": list(route.cell_ids),
        "gateways": list(route.gateway_ids),
        "cost": route.cost,
    }
    return feature("LineString", coordinates(route.way, sketch), properties)


def feature(kind: str, where: object, properties: Mapping[str, object]) -> Feature:
    """Write one feature."""
    return {
        "type": "Feature",
        "geometry": {"type": kind, "coordinates": where},
        "properties": dict(properties),
    }


def coordinates(points: Array, sketch: SchematicMap) -> list[list[float]]:
    """List points (n, 2) in the axes of the drawing's file."""
    rows: list[list[float]] = sketch.file_from_sketch(points).tolist()
    return rows
