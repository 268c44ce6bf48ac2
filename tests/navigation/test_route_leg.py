"""The route and its next waypoint, in the frame of the robot."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from buildings import flat
from pilotage.geometry import Affine2, Polyline
from pilotage.maps import DecompositionSettings, Roadmap, RouteError, RouteSettings, SchematicMap, decompose
from pilotage.navigation.route_leg import inside, next_waypoint
from strategies import angles, scales

SUITE = (
    [(0, 0), (15, 0), (15, 5), (0, 5), (0, 0)],
    [(5, 0), (5, 2)],
    [(5, 3), (5, 5)],
    [(10, 0), (10, 2)],
    [(10, 3), (10, 5)],
)
"""Three rooms in a row [m]."""
QUARTERS = (
    [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)],
    [(5, 0), (5, 2)],
    [(5, 3), (5, 7)],
    [(5, 8), (5, 10)],
    [(0, 5), (2, 5)],
    [(3, 5), (7, 5)],
    [(8, 5), (10, 5)],
)
"""Four rooms, each with a door to two others [m]."""
GOAL = (13.0, 2.5)


def decomposed(strokes, scale=1.0):
    drawn = (Polyline.through(scale * np.array(stroke, dtype=float)) for stroke in strokes)
    return decompose(SchematicMap(tuple(drawn)), DecompositionSettings())


def led(sketch_from_base, graph, goal, closed=()):
    return next_waypoint(sketch_from_base, Roadmap(graph, RouteSettings()), goal, closed)


ROOMS, RING, FLAT = decomposed(SUITE), decomposed(QUARTERS), decompose(flat(), DecompositionSettings())


def placed(x, y, heading=0.0, *, scale=1.0, stretch=(0.0, 0.0)):
    """Stand somewhere on a drawing, so many units a metre."""
    return Affine2.from_state(x, y, heading, math.log(scale), *stretch)


def on_paper(sketch_from_base, point):
    """Carry a point that the robot heads for back to the drawing, (2,)."""
    return (sketch_from_base @ np.asarray(point)[np.newaxis])[0]


small = st.floats(-0.5, 0.5)


@given(st.floats(0.5, 4.5), st.floats(0.5, 4.5), angles)
def test_the_robot_heads_for_a_point_behind_the_gateway_in_the_next_cell(x, y, heading):
    sketch_from_base = placed(x, y, heading)
    leg = led(sketch_from_base, ROOMS, GOAL)

    assert ROOMS.cell_at((7.5, 2.5)) == leg.next_cell_id
    gateway = ROOMS.gateway(leg.gateway_id)
    assert {ROOMS.cell_at((x, y)), leg.next_cell_id} == set(gateway.cell_ids)
    np.testing.assert_allclose(gateway.middle, on_paper(sketch_from_base, leg.middle))
    behind = on_paper(sketch_from_base, leg.waypoint)
    assert leg.next_cell_id == ROOMS.cell_at(behind)
    assert ROOMS.cell(leg.next_cell_id).polygon.covers(shapely.Point(behind))
    assert 0.5 < math.dist(behind, gateway.middle) <= 1.0 + 1e-9


def test_the_path_leads_from_the_robot_to_the_goal():
    sketch_from_base = placed(1.0, 2.5, 0.7)
    leg = led(sketch_from_base, ROOMS, GOAL)

    assert [0.0, 0.0] == leg.path[0].tolist()
    np.testing.assert_allclose(GOAL, on_paper(sketch_from_base, leg.path[-1]))
    assert 12.0 == pytest.approx(leg.distance, abs=0.1)


def test_in_its_own_cell_the_robot_heads_for_the_goal_itself():
    sketch_from_base = placed(11.0, 1.0, 2.0)
    leg = led(sketch_from_base, ROOMS, GOAL)

    assert ("", "") == (leg.gateway_id, leg.next_cell_id)
    np.testing.assert_allclose(GOAL, on_paper(sketch_from_base, leg.waypoint))
    np.testing.assert_allclose(leg.waypoint, leg.middle)
    assert math.dist((11.0, 1.0), GOAL) == pytest.approx(leg.distance)


def test_a_robot_that_stands_at_the_goal_has_nowhere_to_go():
    leg = led(placed(*GOAL), ROOMS, GOAL)

    assert 0.0 == pytest.approx(leg.distance)
    np.testing.assert_allclose([0.0, 0.0], leg.waypoint, atol=1e-9)


@given(st.floats(-0.3, 0.3), st.floats(-0.2, 0.2), angles)
def test_a_robot_in_a_gateway_goes_through_it_and_then_on(along, aside, heading):
    sketch_from_base = placed(5.0 + along, 2.5 + aside, heading)
    leg = led(sketch_from_base, ROOMS, GOAL)
    is_before = ROOMS.cell_at((5.0 + along, 2.5)) == ROOMS.cell_at((1.0, 2.5))
    cell_behind = ROOMS.cell_at((7.5 if is_before else 12.0, 2.5))

    assert ROOMS.cell_at(on_paper(sketch_from_base, leg.waypoint)) == cell_behind
    assert leg.gateway_id


@given(st.floats(0.5, 4.5), st.floats(0.5, 4.5), angles, small, small)
def test_a_stretched_place_means_the_same_points_of_the_drawing(x, y, heading, p, q):
    straight, stretched = placed(x, y), placed(x, y, heading, stretch=(p, q))
    first, second = (led(one, ROOMS, GOAL) for one in (straight, stretched))

    assert first.gateway_id == second.gateway_id
    np.testing.assert_allclose(on_paper(straight, first.waypoint), on_paper(stretched, second.waypoint))
    np.testing.assert_allclose(on_paper(straight, first.middle), on_paper(stretched, second.middle))
    np.testing.assert_allclose(GOAL, on_paper(stretched, second.path[-1]))


@pytest.mark.parametrize("scale", [0.01, 40.0])
def test_the_robot_sees_the_same_whatever_the_scale_of_the_drawing(scale):
    graph = decomposed(SUITE, scale)
    first = led(placed(1.0, 1.0, 0.5), ROOMS, GOAL)
    second = led(placed(scale, scale, 0.5, scale=scale), graph, (scale * GOAL[0], scale * GOAL[1]))

    np.testing.assert_allclose(first.waypoint, second.waypoint, atol=0.02)
    assert first.distance == pytest.approx(second.distance, abs=0.02)


@pytest.mark.parametrize("corner", [(0.0, 0.0), (5e5, 5.4e6)])
def test_a_bend_before_a_gateway_is_a_bend_in_coordinates_of_a_survey_too(corner):
    around_a_corner = [(0, 0), (12, 0), (12, 10), (10, 10), (10, 2), (0, 2), (0, 0)]
    strokes = (around_a_corner, [(10, 6), (10.5, 6)], [(11.5, 6), (12, 6)])
    there = np.array(corner)
    graph = decomposed([there + np.array(stroke) for stroke in strokes])
    start, goal = there + np.array([(1.0, 1.0), (11.0, 9.0)])
    leg = led(placed(*start), graph, tuple(goal))

    assert ("", 2) == (leg.gateway_id, len(leg.route.cell_ids))
    np.testing.assert_allclose([9.0, 1.0], leg.middle, atol=1e-3)


@given(angles, scales)
def test_a_turn_of_the_robot_turns_what_it_heads_for(turn, scale):
    first = led(placed(2.0, 1.0, 0.0, scale=scale), ROOMS, GOAL)
    second = led(placed(2.0, 1.0, turn, scale=scale), ROOMS, GOAL)

    cosine, sine = math.cos(turn), math.sin(turn)
    turned = second.waypoint @ np.array([[cosine, sine], [-sine, cosine]])
    np.testing.assert_allclose(first.waypoint, turned, atol=1e-9)


def test_a_closed_gateway_leads_elsewhere():
    sketch_from_base, goal = placed(2.0, 2.0), (8.0, 2.0)
    first = led(sketch_from_base, RING, goal)
    second = led(sketch_from_base, RING, goal, (first.gateway_id,))

    assert RING.cell_at(goal) == first.next_cell_id
    assert RING.cell_at((2.0, 8.0)) == second.next_cell_id
    assert first.gateway_id not in second.route.gateway_ids
    assert second.distance > first.distance + 5.0


def test_where_all_gateways_are_blocked_there_is_no_route():
    sketch_from_base = placed(2.0, 2.0)
    closed = [gateway.gateway_id for gateway in RING.gateways_of(RING.cell_at((2.0, 2.0)))]

    with pytest.raises(RouteError, match="no way leads"):
        led(sketch_from_base, RING, (8.0, 8.0), closed)


@pytest.mark.parametrize("place", [(-3.0, 2.0), (5.0, 1.0), (17.0, -2.0), (2.0, 5.0)])
def test_a_robot_that_is_believed_to_be_in_a_wall_is_led_all_the_same(place):
    leg = led(placed(*place), ROOMS, (7.5, 1.0))

    assert ROOMS.cell_at((7.5, 1.0)) == leg.route.cell_ids[-1]
    assert np.isfinite(leg.waypoint).all()
    assert [0.0, 0.0] == leg.path[0].tolist()


@given(st.floats(-5.0, 15.0), st.floats(-5.0, 12.0))
def test_a_point_is_taken_inside_to_the_nearest_cell_and_stays_if_it_is(x, y):
    found = inside(FLAT, (x, y))

    polygons = [cell.polygon for cell in FLAT.cells]
    floor, place = shapely.union_all(polygons), shapely.Point(x, y)
    assert any(polygon.covers(shapely.Point(found)) for polygon in polygons)
    assert found == inside(FLAT, found)
    if floor.covers(place):
        assert (x, y) == found
    else:
        # a little deeper than the border, so that no rounding puts it outside
        assert math.dist(found, (x, y)) < floor.distance(place) + 0.05


def test_around_a_bend_the_robot_heads_for_where_the_path_goes_on():
    block = ([(0, 0), (20, 0), (20, 10), (0, 10), (0, 0)], [(3, 3), (17, 3), (17, 7), (3, 7), (3, 3)])
    sketch_from_base = placed(10.0, 1.0, 1.0)
    leg = led(sketch_from_base, decomposed(block), (18.5, 8.5))

    bend = on_paper(sketch_from_base, leg.middle)
    assert "" == leg.gateway_id
    assert math.dist(bend, (17.0, 3.0)) < 1.5
    assert on_paper(sketch_from_base, leg.waypoint)[1] > bend[1]
