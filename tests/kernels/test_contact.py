"""How far a disc can move before it touches something."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiLineString, Point

from pilotage.kernels.contact import clearances, share_before_all, share_before_grid, share_before_segment
from pilotage.kernels.segment_grid import build_grid

NONE = np.empty((0, 4))
coordinates = st.floats(-5.0, 5.0).map(lambda value: round(value, 3))
rows = st.tuples(coordinates, coordinates, coordinates, coordinates)
points = st.tuples(coordinates, coordinates)


def share_plainly(start, move, reach, row):
    """Search along the way: the distance to a segment first falls and then rises, so halving finds both."""
    segment = LineString([row[:2], row[2:]]) if row[:2] != row[2:] else Point(row[:2])

    def distance(share):
        return segment.distance(Point(start[0] + share * move[0], start[1] + share * move[1]))

    low, high = 0.0, 1.0
    for _ in range(100):
        third = (high - low) / 3.0
        if distance(low + third) <= distance(high - third):
            high -= third
        else:
            low += third
    nearest = high
    if distance(nearest) >= reach:
        return 1.0
    low, high = 0.0, nearest
    for _ in range(60):
        middle = (low + high) / 2.0
        low, high = (middle, high) if distance(middle) > reach else (low, middle)
    return low


@given(row=rows, start=points, move=points, reach=st.floats(0.05, 1.0))
@settings(max_examples=100)
def test_a_disc_moves_as_far_as_geometry_says(row, start, move, reach):
    segment = MultiLineString([[row[:2], row[2:]]]) if row[:2] != row[2:] else Point(row[:2])
    outside = segment.distance(Point(start)) > reach + 1e-6
    lowest = segment.distance(LineString([start, (start[0] + move[0], start[1] + move[1])]))
    share = share_before_segment(*start, *move, reach, np.array(row))

    if outside and abs(lowest - reach) > 1e-6:
        assert share_plainly(start, move, reach, row) == pytest.approx(share, abs=1e-6)


@given(walls=st.lists(rows, max_size=30), start=points, move=points, reach=st.floats(0.01, 0.5))
@settings(max_examples=100)
def test_the_grid_leaves_no_segment_out(walls, start, move, reach):
    segments = np.array(walls).reshape(-1, 4)
    expected = min((share_before_segment(*start, *move, reach, row) for row in segments), default=1.0)

    assert expected == pytest.approx(share_before_grid(*start, *move, reach, build_grid(segments)), abs=1e-9)


def test_a_long_way_through_many_walls_ends_at_the_first():
    rng = np.random.default_rng(5)
    starts = rng.uniform(0, 40, (3000, 2))
    segments = np.hstack([starts, starts + rng.uniform(-0.3, 0.3, (3000, 2))])
    grid = build_grid(segments)
    for _ in range(200):
        way = (*rng.uniform(0, 40, 2), *rng.uniform(-40, 40, 2), 0.05)
        expected = min(share_before_segment(*way, row) for row in segments)

        assert expected == pytest.approx(share_before_grid(*way, grid), abs=1e-12)


@pytest.mark.parametrize(
    ("move", "share"),
    [((0.0, 0.1), 0.0), ((0.3, 0.0), 1.0), ((0.0, -0.1), 1.0), ((0.1, -0.1), 1.0), ((0.1, 0.1), 0.0)],
)
def test_what_touches_can_leave_and_go_along_but_not_on(move, share):
    wall = np.array([-1.0, 0.2, 1.0, 0.2])

    assert share == share_before_segment(0.0, 0.0, *move, 0.2, wall)


def test_doors_and_people_are_met_as_walls_are():
    nothing, doors, people = build_grid(NONE), np.array([[2.0, -1, 2, 1]]), np.array([[1.5, 0.0, 0.25]])

    assert 0.9 == pytest.approx(share_before_all(0.0, 0.0, 2.0, 0.0, 0.2, nothing, doors, np.empty((0, 3))))
    assert 0.525 == pytest.approx(share_before_all(0.0, 0.0, 2.0, 0.0, 0.2, nothing, doors, people))
    assert 1.0 == share_before_all(0.0, 0.0, 2.0, 0.0, 0.2, nothing, NONE, np.empty((0, 3)))


@given(walls=st.lists(rows, max_size=20), places=st.lists(points, min_size=1), farthest=st.floats(0.1, 20.0))
def test_clearance_is_what_geometry_says(walls, places, farthest):
    segments = np.array(walls).reshape(-1, 4)
    plain = [
        LineString([row[:2], row[2:]]) if row[:2] != row[2:] else Point(row[:2]) for row in map(tuple, walls)
    ]
    expected = [min([farthest, *(wall.distance(Point(place)) for wall in plain)]) for place in places]

    np.testing.assert_allclose(
        expected, clearances(np.array(places), build_grid(segments), farthest), atol=1e-9
    )
