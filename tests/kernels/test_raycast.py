"""Beams against segments."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiLineString, Point

from pilotage.kernels.raycast import cast

FAR = 1000.0

coordinates = st.integers(-8, 8).map(lambda value: value + 0.25)
segments = st.lists(st.tuples(coordinates, coordinates, coordinates, coordinates), min_size=1, max_size=8)


def cast_plainly(origin, direction, rows):
    """Intersect the beam with all walls by shapely, and measure to the nearest piece."""
    end = (origin[0] + FAR * math.cos(direction), origin[1] + FAR * math.sin(direction))
    met = LineString([origin, end]).intersection(MultiLineString([[row[:2], row[2:]] for row in rows]))
    return math.inf if met.is_empty else Point(origin).distance(met)


@given(rows=segments, origin=st.tuples(st.floats(-9, 9), st.floats(-9, 9)), direction=st.floats(-3.1, 3.1))
@settings(deadline=None)
def test_a_beam_goes_as_far_as_geometry_says(rows, origin, direction):
    expected = cast_plainly(origin, direction, rows)
    (distance,) = cast(np.array([origin]), np.array([direction]), np.array(rows))
    grazing = not math.isclose(expected, distance, rel_tol=1e-6, abs_tol=1e-6)

    assert not grazing or passes_an_end(origin, direction, rows)


def passes_an_end(origin, direction, rows):
    """Whether the beam runs so close by an end of a wall that rounding decides whether it hits."""
    ends = np.vstack([np.array(rows)[:, :2], np.array(rows)[:, 2:]]) - np.array(origin)
    across = ends[:, 1] * math.cos(direction) - ends[:, 0] * math.sin(direction)
    return bool(np.abs(across).min() < 1e-6)


def test_the_nearest_of_several_walls_is_met():
    walls = np.array([[4.0, -1.0, 4.0, 1.0], [2.0, -1.0, 2.0, 1.0], [-1.0, -1.0, -1.0, 1.0]])
    ranges = cast(np.zeros((3, 2)), np.array([0.0, math.pi, math.pi / 2]), walls)

    np.testing.assert_allclose(ranges, [2.0, 1.0, math.inf], atol=1e-12)


def test_the_ends_of_a_wall_belong_to_it():
    walls = np.array([[2.0, 0.0, 2.0, 1.0]])

    assert cast(np.zeros((1, 2)), np.zeros(1), walls).tolist() == [2.0]


def test_a_beam_along_a_wall_passes_it():
    walls = np.array([[1.0, 0.0, 2.0, 0.0], [3.0, -1.0, 3.0, 1.0]])

    assert cast(np.zeros((1, 2)), np.zeros(1), walls).tolist() == [3.0]


def test_without_walls_nothing_returns():
    assert cast(np.zeros((1, 2)), np.zeros(1), np.empty((0, 4))).tolist() == [math.inf]
