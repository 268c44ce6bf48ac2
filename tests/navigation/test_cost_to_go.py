"""The cost to go from everywhere, and the progress of a move averaged over particles."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from buildings import coarse, flat
from pilotage.geometry import Polyline
from pilotage.maps import Roadmap, RouteSettings, SchematicMap, build_atlas
from pilotage.navigation.cost_to_go import cost_to_go

COARSE = coarse(100, 120)
RING = SchematicMap(
    tuple(
        Polyline.through(corners, closed=True)
        for corners in ([(0, 0), (20, 0), (20, 10), (0, 10)], [(3, 3), (17, 3), (17, 7), (3, 7)])
    )
)
CORRIDOR = SchematicMap((Polyline.through([(0, 0), (30, 0), (30, 2), (0, 2)], closed=True),))


def costs_in(sketch, goal, closed=()):
    atlas = build_atlas(sketch, COARSE)
    roadmap = Roadmap(atlas.cell_graph, RouteSettings())
    return atlas, roadmap, cost_to_go(atlas, roadmap, goal, closed)


FLAT = costs_in(flat(), (8.0, 5.0))


def particles(*poses, scale=1.0):
    return np.array([(x, y, heading, math.log(scale), 0.0, 0.0) for x, y, heading in poses]).T


@pytest.mark.parametrize(
    ("sketch", "goal"), [(flat(), (8.0, 5.0)), (flat(30.0), (45.0, 30.0)), (RING, (18.5, 5.0))]
)
def test_the_cost_to_go_is_the_cost_of_the_route(sketch, goal):
    atlas, roadmap, costs = costs_in(sketch, goal)
    places = atlas.range_table.places
    free = shapely.union_all([cell.polygon for cell in roadmap.graph.cells])
    places = places[shapely.contains_xy(free, places)]  # not inside the ring's block
    places = places[np.random.default_rng(0).choice(len(places), 60)]

    routes = [roadmap.find(tuple(place), goal).cost * roadmap.graph.diameter for place in places]
    cell = atlas.range_table.cell_size
    np.testing.assert_allclose(costs.at(places), routes, rtol=0.02, atol=2.0 * cell)


def test_behind_blocked_gateways_the_cost_to_go_is_infinite():
    atlas, roadmap, costs = FLAT
    shut = cost_to_go(atlas, roadmap, (8.0, 5.0), [gateway.gateway_id for gateway in roadmap.graph.gateways])
    here, there = np.array([[1.5, 1.5]]), np.array([[9.0, 6.0]])

    assert np.isfinite(costs.at(here)).all()
    assert np.isinf(shut.at(here)).all()
    assert np.isfinite(shut.at(there)).all()


def test_a_move_progresses_by_what_it_comes_nearer_in_metres():
    for scale in (1.0, 20.0):
        corners = scale * CORRIDOR.strokes[0].ring[:-1]
        _, _, costs = costs_in(SchematicMap((Polyline(corners, closed=True),)), (25.0 * scale, scale))
        states = particles((10.0 * scale, scale, 0.0), scale=scale)

        progress = costs.expected_progress(np.array([(3.0, 0.0), (-4.0, 0.0), (0.0, 0.0)]), states)

        np.testing.assert_allclose(progress, [3.0, -4.0, 0.0], atol=0.4)


def test_particles_that_look_opposite_ways_progress_by_nothing_on_average():
    _, _, costs = costs_in(CORRIDOR, (25.0, 1.0))
    opposite = particles((10.0, 1.0, 0.0), (10.0, 1.0, math.pi))

    np.testing.assert_allclose(
        costs.expected_progress(np.array([(3.0, 0.0), (-3.0, 0.0)]), opposite), 0.0, atol=0.4
    )


def test_where_no_route_leads_to_the_goal_there_is_no_progress():
    atlas, roadmap, _ = FLAT
    shut = cost_to_go(atlas, roadmap, (8.0, 5.0), [gateway.gateway_id for gateway in roadmap.graph.gateways])

    np.testing.assert_array_equal(
        shut.expected_progress(np.array([(1.0, 0.5)]), particles((1.5, 1.5, 0.0))), 0.0
    )


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_no_move_progresses_by_more_than_its_length(seed):
    rng = np.random.default_rng(seed)
    *_, costs = FLAT
    points = rng.uniform(-6.0, 6.0, (8, 2))
    states = particles(*rng.uniform((0.0, 0.0, -3.1), (10.0, 7.0, 3.1), (20, 3)))

    assert (np.abs(costs.expected_progress(points, states)) <= np.hypot(*points.T) + 1e-9).all()
