import json

import pytest

from pilotage.geometry import Polyline
from pilotage.io.geojson import write_cells
from pilotage.maps import DecompositionSettings, RouteSettings, SchematicMap, decompose, find_route

STROKES = ([(0, 0), (10, 0), (10, -5), (0, -5), (0, 0)], [(5, 0), (5, -2)], [(5, -3), (5, -5)])


@pytest.fixture
def features(tmp_path):
    sketch = SchematicMap(tuple(Polyline.through(stroke) for stroke in STROKES), y_down=True)
    graph = decompose(sketch, DecompositionSettings())
    route = find_route(graph, (1.0, -1.0), (9.0, -1.0), RouteSettings())
    write_cells(tmp_path / "cells.geojson", sketch, graph, route)
    return json.loads((tmp_path / "cells.geojson").read_text())["features"]


def test_cells_gateways_and_the_route_are_written(features):
    assert ["cell", "cell", "gateway", "route"] == [feature["properties"]["kind"] for feature in features]


def test_coordinates_are_those_of_the_file(features):
    points = [point for feature in features[:2] for point in feature["geometry"]["coordinates"][0]]

    assert (0.0, 5.0) == pytest.approx((min(y for _, y in points), max(y for _, y in points)), abs=1e-4)


def test_rings_are_closed(features):
    ring = features[0]["geometry"]["coordinates"][0]

    assert ring[0] == ring[-1]


def test_neighbors_name_each_other(features):
    first, second = (feature["properties"] for feature in features[:2])

    assert [second["id"]] == [neighbor["cell"] for neighbor in first["neighbors"]]
    assert [first["id"]] == [neighbor["cell"] for neighbor in second["neighbors"]]
