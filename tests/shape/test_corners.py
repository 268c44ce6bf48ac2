import math

import numpy as np
from hypothesis import given

from pilotage.geometry import Polyline
from pilotage.shape.corners import MIN_TURN, find_corners
from strategies import polylines, poses


def turns_of(polyline):
    """Turn at each vertex between two segments, one by one."""
    points = [complex(*point) for point in polyline.vertices]
    count = len(points)
    at = range(count) if polyline.closed else range(1, count - 1)
    for k in at:
        before, after = points[k] - points[k - 1], points[(k + 1) % count] - points[k]
        yield k, math.atan2((after * before.conjugate()).imag, (after * before.conjugate()).real)


@given(polylines(min_size=3))
def test_every_sharp_vertex_is_a_corner_and_no_other(polyline):
    sharp = {k: turn for k, turn in turns_of(polyline) if abs(abs(turn) - MIN_TURN) > 1e-6}
    expected = sorted(tuple(polyline.vertices[k]) for k, turn in sharp.items() if abs(turn) > MIN_TURN)
    unclear = len(list(turns_of(polyline))) - len(sharp)

    found = sorted(map(tuple, find_corners([polyline]).vertices))

    assert unclear or expected == found


@given(polylines(min_size=3), poses)
def test_corners_move_with_their_polyline(polyline, pose):
    before, after = find_corners([polyline]), find_corners([polyline.moved(pose)])

    if len(before) == len(after):  # a turn may fall to either side of the least one
        np.testing.assert_allclose(pose @ before.vertices, after.vertices, atol=1e-9)


def test_polylines_do_not_make_corners_with_each_other():
    first, second = Polyline.through([(0, 0), (1, 0)]), Polyline.through([(1, 0), (1, 1)])

    assert 0 == len(find_corners([first, second]))


def test_the_other_side_bends_the_other_way():
    corner = find_corners([Polyline.through([(0, 0), (2, 0), (2, 1)])])
    reversed_line = find_corners([Polyline.through([(2, 1), (2, 0), (0, 0)])])

    assert corner.reversed().turns.tolist() == reversed_line.turns.tolist()
    difference = corner.reversed().directions - reversed_line.directions
    np.testing.assert_allclose(np.cos(difference), 1.0)
