"""Where no door is drawn between the parts of a drawing, one is supposed in a wall between them."""

from itertools import product

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from pilotage.geometry import Polyline
from pilotage.maps import DecompositionSettings, RouteSettings, SchematicMap, decompose, find_route
from pilotage.maps.routing.forgotten_doors import join_parts
from pilotage.maps.routing.places import connected_cells

BOXES = (
    [(0, 0), (15, 0), (15, 5), (0, 5), (0, 0)],
    [(5, 0), (5, 5)],
    [(10, 0), (10, 5)],
)
"""Three rooms in a row, without a door."""


def decomposed(*strokes):
    return decompose(SchematicMap(tuple(map(Polyline.through, strokes))), DecompositionSettings())


def box(left, bottom, right, top):
    return [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)]


def is_left_of(cell, gateway):
    """Tell whether a cell lies on the left of a gateway."""
    along = gateway.segment[1] - gateway.segment[0]
    left = gateway.middle + 0.1 * np.array([-along[1], along[0]]) / gateway.width
    return cell.polygon.covers(shapely.Point(left))


def test_closed_boxes_are_joined_in_the_middle_of_their_walls():
    graph = decomposed(*BOXES)
    joined = join_parts(graph).graph

    assert () == graph.gateways
    middles = np.array(sorted(tuple(gateway.middle) for gateway in joined.gateways))
    assert middles == pytest.approx(np.array([(5.0, 2.5), (10.0, 2.5)]), abs=1e-3)
    assert not any(gateway.is_drawn for gateway in joined.gateways)
    assert 3 == len(find_route(joined, (1.0, 2.5), (14.0, 2.5), RouteSettings()).cell_ids)


def test_a_door_that_is_forgotten_leads_through_a_thick_wall():
    joined = join_parts(decomposed(box(0.2, 0.2, 4.9, 4.8), box(5.1, 0.2, 9.8, 4.8)))
    route = find_route(joined.graph, (1.0, 2.5), (9.0, 2.5), RouteSettings())

    assert 1 == len(joined.doors)
    assert joined.doors[0].opening.buffer(1e-9).covers(shapely.LineString([(4.9, 2.5), (5.1, 2.5)]))
    assert 1 == len(route.gateway_ids)


def test_a_graph_in_one_part_stays_as_it_is():
    graph = decomposed(BOXES[0], [(5, 0), (5, 2)], [(5, 3), (5, 5)])

    assert graph is join_parts(graph).graph


def test_buildings_that_stand_apart_are_not_joined():
    graph = decomposed(box(0, 0, 5, 5), box(15, 0, 20, 5))

    assert () == join_parts(graph).graph.gateways


def test_a_drawn_way_is_preferred_however_long_it_is():
    gap = [(5, 0), (5, 2)], [(5, 3), (5, 5)]
    graph = decomposed(BOXES[0], *gap, BOXES[2], [(10, 2.5), (15, 2.5)])
    joined = join_parts(graph).graph
    route = find_route(joined, (1.0, 2.5), (9.0, 2.5), RouteSettings())

    assert all(joined.gateway(gateway_id).is_drawn for gateway_id in route.gateway_ids)


@given(st.floats(0.0, 0.3))
@settings(max_examples=10)
def test_all_rooms_of_a_building_are_joined(thickness):
    half = thickness / 2.0
    strokes = [
        box(4 * i + half, 4 * j + half, 4 * i + 4 - half, 4 * j + 4 - half)
        for i, j in product(range(3), range(2))
    ]
    cells = [(4 * i + 2.0, 4 * j + 2.0) for i, j in product(range(3), range(2))]
    graph = decomposed(*strokes)
    joined = join_parts(graph).graph

    assert 1 == len(connected_cells(joined))
    assert [cell.cell_id for cell in graph.cells] == [cell.cell_id for cell in joined.cells]
    for gateway in joined.gateways:
        first, second = map(joined.cell, gateway.cell_ids)
        assert is_left_of(first, gateway)
        assert not is_left_of(second, gateway)
        assert first.polygon.distance(shapely.Point(gateway.middle)) < 1e-9
        assert second.polygon.distance(shapely.Point(gateway.middle)) < 1e-9
    for place in cells:
        assert find_route(joined, cells[0], place, RouteSettings()).cost >= 0.0
