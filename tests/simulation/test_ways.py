"""The shortest way in the true building."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiLineString

from pilotage.geometry import Polyline
from pilotage.maps import SchematicMap
from pilotage.simulation import Door, World

HALL = np.array([[0, 0, 12, 0], [12, 0, 12, 8], [12, 8, 0, 8], [0, 8, 0, 0]], dtype=float)
WALL = np.array([[0.0, 4.0, 7.0, 4.0]])
RADIUS = 0.3


def test_the_way_is_straight_where_nothing_stands():
    way = World(HALL).shortest_way((1, 1), (11, 6), RADIUS)

    assert [[1.0, 1.0], [11.0, 6.0]] == way.points.tolist()
    assert math.hypot(10, 5) == pytest.approx(way.length)


def test_the_way_round_the_end_of_a_wall_is_as_long_as_geometry_says():
    # two tangents to the circle about the wall's end, and the arc between them
    reach = math.hypot(4.0, 2.0)
    arc = RADIUS * (math.tau - 2.0 * math.atan2(2.0, 4.0) - 2.0 * math.acos(RADIUS / reach))
    expected = 2.0 * math.sqrt(reach**2 - RADIUS**2) + arc
    way = World(np.vstack([HALL, WALL])).shortest_way((3, 2), (3, 6), RADIUS)

    assert expected == pytest.approx(way.length, rel=0.01)
    assert expected <= way.length


@given(ends=st.tuples(*[st.floats(0.4, 7.6)] * 4), seed=st.integers(0, 5))
@settings(max_examples=30)
def test_the_robot_touches_nothing_on_the_way_and_it_is_no_shorter_back(ends, seed):
    rng = np.random.default_rng(seed)
    corners = rng.uniform(1, 10, (6, 2))
    things = np.hstack([corners, corners + rng.uniform(-2, 2, (6, 2))])
    world = World(np.vstack([HALL, things]))
    way = world.shortest_way(ends[:2], ends[2:], RADIUS)
    back = world.shortest_way(ends[2:], ends[:2], RADIUS)

    assert way.length == pytest.approx(back.length, rel=0.01)
    if way.length < math.inf:
        solid = MultiLineString([[row[:2], row[2:]] for row in world.segments])
        assert RADIUS - 1e-9 <= solid.distance(LineString(way.points))
        assert math.dist(ends[:2], ends[2:]) - 1e-9 <= way.length


def test_there_is_no_way_through_a_gap_too_narrow():
    divided = np.vstack([HALL, [[0, 4, 7, 4], [7.7, 4, 12, 4]]])

    assert 5.0 < World(divided).shortest_way((3, 2), (3, 6), 0.3).length < math.inf
    assert math.inf == World(divided).shortest_way((3, 2), (3, 6), 0.4).length
    assert math.inf == World(divided).shortest_way((3, 2), (3, 3.9), 0.3).length


def test_doors_stand_open_but_for_those_that_never_open():
    divided = np.vstack([HALL, [[0, 4, 7, 4], [9, 4, 12, 4]]])
    leaf = np.array([7.0, 4, 9, 4])
    lengths = [
        World(divided, doors=(Door(leaf, closed),)).shortest_way((8, 2), (8, 6), RADIUS).length
        for closed in ((), ((1.0, 50.0),), ((0.0, math.inf),))
    ]

    assert [4.0, 4.0, math.inf] == lengths


def test_the_inside_of_a_thick_wall_is_not_free_where_contours_part_the_two():
    outer = Polyline.through([(0, 0), (9, 0), (9, 9), (0, 9)], closed=True)
    pillar = Polyline.through([(3, 3), (6, 3), (6, 6), (3, 6)], closed=True)
    segments = SchematicMap((outer, pillar)).segments
    places = [(1, 1), (4.5, 4.5), (2.9, 4), (-5, 4.5), (4.5, 10.0)]

    assert [True, False, False, False, False] == World(segments, contours=True).is_free(places, 0.2).tolist()
    assert [True, True, False, True, True] == World(segments).is_free(places, 0.2).tolist()
