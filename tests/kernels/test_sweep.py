import numpy as np
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from pilotage.kernels.raycast import cast
from pilotage.kernels.sweep import sweep
from strategies import coordinates

points = st.tuples(coordinates, coordinates)
segments = st.lists(st.tuples(points, points).filter(lambda ends: ends[0] != ends[1]), min_size=1, max_size=8)


@settings(max_examples=50)
@given(place=points, ends=segments, directions=st.integers(1, 90))
def test_ranges_are_those_of_single_beams(place, ends, directions):
    walls = np.array(ends, dtype=np.float64).reshape(-1, 4)
    walls_now = shapely.multilinestrings(walls.reshape(-1, 2, 2))
    assume(walls_now.distance(shapely.Point(place)) > 1e-3)
    angles = np.arange(directions) * 2 * np.pi / directions
    # beams that graze the very end of a segment may go either way: look just beside them
    grazed = np.zeros(directions, bool)
    for x, y in walls.reshape(-1, 2) - np.array(place):
        away = np.abs((np.arctan2(y, x) - angles + np.pi) % (2 * np.pi) - np.pi)
        grazed |= (away < 1e-6) | (np.abs(away - np.pi) < 1e-6)
    single = np.minimum(cast(np.tile(place, (directions, 1)).astype(float), angles, walls), 100.0)

    swept = sweep(np.array([place], dtype=np.float64), walls, directions, 100.0)[0]

    near = np.isclose(single, swept, rtol=1e-4, atol=1e-5)
    assert near[~grazed].all()


def test_a_square_room_is_seen_from_its_middle():
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=np.float64)
    walls = np.hstack([corners, np.roll(corners, -1, axis=0)])

    ranges = sweep(np.zeros((1, 2)), walls, 8, 10.0)[0]

    np.testing.assert_allclose([1, np.sqrt(2)] * 4, ranges, rtol=1e-6)


def test_where_nothing_is_the_range_is_the_farthest():
    ranges = sweep(np.zeros((1, 2)), np.array([[1.0, -0.5, 1.0, 0.5]]), 4, 7.0)[0]

    assert [1.0, 7.0, 7.0, 7.0] == ranges.tolist()
