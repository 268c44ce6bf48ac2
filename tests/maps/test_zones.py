"""Zones that a person drew are kept by every route."""

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from four_rooms import GRAPH
from pilotage.geometry import Polyline
from pilotage.maps import Roadmap, RouteError, RouteSettings, Zones, find_route

ROOMS = {
    "south west": (2.5, 2.5),
    "south east": (8.0, 2.5),
    "north west": (2.5, 7.0),
    "north east": (8.0, 7.0),
}


def box(left, bottom, right, top):
    return Polyline(np.array([(left, bottom), (right, bottom), (right, top), (left, top)]), closed=True)


def rooms_on(route):
    return [name for cell in route.cell_ids for name, at in ROOMS.items() if GRAPH.cell_at(at) == cell]


def test_a_room_that_is_kept_out_is_driven_around():
    free = find_route(GRAPH, ROOMS["south west"], ROOMS["south east"], RouteSettings())
    kept = Zones(keep_out=(box(4.0, 1.5, 6.0, 3.5),))
    around = find_route(GRAPH, ROOMS["south west"], ROOMS["south east"], RouteSettings(), zones=kept)

    assert ["south west", "south east"] == rooms_on(free)
    assert ["south west", "north west", "north east", "south east"] == rooms_on(around)


@given(
    st.tuples(st.floats(0.2, 10.0), st.floats(0.2, 7.5)),
    st.tuples(st.floats(0.3, 4.0), st.floats(0.3, 4.0)),
    st.sampled_from(sorted(ROOMS)),
    st.sampled_from(sorted(ROOMS)),
)
def test_no_route_enters_a_keep_out_zone(corner, size, start, goal):
    zone = box(*corner, *np.add(corner, size))
    zones = Zones(keep_out=(zone,))
    assume(not zones.are_kept_out(np.array([ROOMS[start], ROOMS[goal]])).any())
    try:
        route = find_route(GRAPH, ROOMS[start], ROOMS[goal], RouteSettings(), zones=zones)
    except RouteError:
        cells = shapely.union_all([cell.polygon for cell in GRAPH.cells])
        ways = shapely.difference(cells, shapely.polygons(zone.vertices))
        parts = shapely.get_parts(shapely.buffer(ways, 1e-3))
        homes = [[part.covers(shapely.Point(ROOMS[end])) for part in parts] for end in (start, goal)]
        middles = [gateway.middle for gateway in GRAPH.gateways]
        assert homes[0] != homes[1] or zones.are_kept_out(np.array(middles)).any()
    else:
        inner = shapely.buffer(shapely.polygons(zone.vertices), -0.05)
        assert not shapely.intersects(shapely.linestrings(route.way), inner)


def test_a_one_way_gateway_is_passed_along_its_arrow_only():
    eastwards = Zones(one_way=(Polyline(np.array([(4.0, 2.5), (6.0, 2.5)])),))
    there = find_route(GRAPH, ROOMS["south west"], ROOMS["south east"], RouteSettings(), zones=eastwards)
    back = find_route(GRAPH, ROOMS["south east"], ROOMS["south west"], RouteSettings(), zones=eastwards)

    assert ["south west", "south east"] == rooms_on(there)
    assert ["south east", "north east", "north west", "south west"] == rooms_on(back)
    left = Roadmap(GRAPH, RouteSettings(), eastwards).exits_to(ROOMS["south west"])
    door = [cost for point, cost in left[GRAPH.cell_at(ROOMS["south east"])] if abs(point[1] - 2.5) < 0.2]
    assert min(door) > back.cost - there.cost


def test_a_robot_that_stands_in_a_keep_out_zone_leaves_it():
    zones = Zones(keep_out=(box(1.5, 1.5, 3.5, 3.5),))
    route = find_route(GRAPH, ROOMS["south west"], ROOMS["south east"], RouteSettings(), zones=zones)

    assert ["south west", "south east"] == rooms_on(route)


def test_a_goal_in_a_keep_out_zone_is_refused():
    zones = Zones(keep_out=(box(1.5, 1.5, 3.5, 3.5),))
    with pytest.raises(RouteError, match="the goal lies in a keep-out zone"):
        find_route(GRAPH, ROOMS["south east"], ROOMS["south west"], RouteSettings(), zones=zones)
