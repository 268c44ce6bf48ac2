"""Beams against segments."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiLineString, Point

from pilotage.kernels.raycast import cast, cast_on_discs, cast_on_panes, cast_through, first_met
from pilotage.kernels.segment_grid import build_grid

FAR = 1000.0

coordinates = st.integers(-8, 8).map(lambda value: value + 0.25)
segments = st.lists(st.tuples(coordinates, coordinates, coordinates, coordinates), min_size=1, max_size=8)


def cast_plainly(origin, direction, rows):
    """Intersect the beam with all walls by shapely, and measure to the nearest piece."""
    end = (origin[0] + FAR * math.cos(direction), origin[1] + FAR * math.sin(direction))
    met = LineString([origin, end]).intersection(MultiLineString([[row[:2], row[2:]] for row in rows]))
    return math.inf if met.is_empty else Point(origin).distance(met)


@given(rows=segments, origin=st.tuples(st.floats(-9, 9), st.floats(-9, 9)), direction=st.floats(-3.1, 3.1))
def test_a_beam_goes_as_far_as_geometry_says(rows, origin, direction):
    expected = cast_plainly(origin, direction, rows)
    (distance,) = cast(np.array([origin]), np.array([direction]), np.array(rows))

    is_equal = math.isclose(expected, distance, rel_tol=1e-6, abs_tol=1e-6)
    assert is_equal or passes_an_end(origin, direction, rows)


def passes_an_end(origin, direction, rows):
    """Tell whether the beam runs so close by an end of a wall that rounding decides whether it hits."""
    ends = np.vstack([np.array(rows)[:, :2], np.array(rows)[:, 2:]]) - np.array(origin)
    across = ends[:, 1] * math.cos(direction) - ends[:, 0] * math.sin(direction)
    return bool(np.abs(across).min() < 1e-6)


def test_the_nearest_of_several_walls_is_met():
    walls = np.array([[4.0, -1.0, 4.0, 1.0], [2.0, -1.0, 2.0, 1.0], [-1.0, -1.0, -1.0, 1.0]])
    ranges, numbers = first_met(np.zeros((3, 2)), np.array([0.0, math.pi, math.pi / 2]), walls)

    np.testing.assert_allclose(ranges, [2.0, 1.0, math.inf], atol=1e-12)
    assert numbers.tolist() == [1, 2, -1]


def test_the_ends_of_a_wall_belong_to_it():
    walls = np.array([[2.0, 0.0, 2.0, 1.0]])

    assert cast(np.zeros((1, 2)), np.zeros(1), walls).tolist() == [2.0]


def test_a_beam_along_a_wall_passes_it():
    walls = np.array([[1.0, 0.0, 2.0, 0.0], [3.0, -1.0, 3.0, 1.0]])

    assert cast(np.zeros((1, 2)), np.zeros(1), walls).tolist() == [3.0]


def test_without_walls_nothing_returns():
    assert cast(np.zeros((1, 2)), np.zeros(1), np.empty((0, 4))).tolist() == [math.inf]


@given(
    rows=segments,
    origin=st.tuples(st.floats(-12, 12), st.floats(-12, 12)),
    direction=st.floats(-3.1, 3.1) | st.integers(-4, 4).map(lambda k: k * math.pi / 4),
)
@settings(max_examples=100)
def test_looking_only_where_the_beam_goes_changes_nothing(rows, origin, direction):
    where, way, walls = np.array([origin]), np.array([direction]), np.array(rows)

    assert cast(where, way, walls).tolist() == cast_through(where, way, build_grid(walls)).tolist()


def test_a_beam_through_thousands_of_walls_stops_at_the_first():
    rng = np.random.default_rng(2)
    steps = rng.choice([-0.05, 0.0, 0.05, 0.4], (5000, 2))
    corners = (
        rng.integers(0, 800, (5000, 2)) * 0.05
    )  # walls along the grid of a map meet the borders of cells
    walls = np.hstack([corners, corners + steps])
    origins = np.vstack([corners[:2000], rng.uniform(-5, 45, (2000, 2))])
    directions = np.concatenate([rng.uniform(-3, 3, 2000), rng.choice(4, 2000) * math.pi / 2])

    np.testing.assert_array_equal(
        cast(origins, directions, walls), cast_through(origins, directions, build_grid(walls))
    )


def test_glass_is_seen_by_beams_that_meet_it_squarely():
    panes = np.array([[2.0, -9.0, 2.0, 9.0]])
    directions = np.radians([0.0, 7.0, 9.0, 60.0, 60.0])
    steepest = np.radians([8.0, 8.0, 8.0, 8.0, 90.0])
    ranges = cast_on_panes(np.zeros((5, 2)), directions, panes, steepest)

    np.testing.assert_allclose(ranges, [2.0, 2.0 / math.cos(directions[1]), math.inf, math.inf, 4.0])


@given(
    origin=st.tuples(st.floats(-3, 3), st.floats(-3, 3)),
    direction=st.floats(-3.1, 3.1),
    disc=st.tuples(st.floats(-3, 3), st.floats(-3, 3), st.floats(0.1, 1)),
)
def test_a_person_is_met_at_the_near_side(origin, direction, disc):
    (distance,) = cast_on_discs(np.array([origin]), np.array([direction]), np.array([disc]))
    beam = LineString([origin, (origin[0] + 9 * math.cos(direction), origin[1] + 9 * math.sin(direction))])
    center = Point(disc[:2])
    touching = min(abs(center.distance(one) - disc[2]) for one in (beam, Point(origin))) < 1e-6

    if touching:
        return
    if center.distance(beam) > disc[2] or center.distance(Point(origin)) < disc[2]:
        assert math.inf == distance
    else:
        met = (origin[0] + distance * math.cos(direction), origin[1] + distance * math.sin(direction))
        assert math.isclose(disc[2], center.distance(Point(met)), abs_tol=1e-6)
        assert distance <= center.distance(Point(origin))
