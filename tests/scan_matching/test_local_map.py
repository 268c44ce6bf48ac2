"""The local map enters what is new, keeps what is known and forgets what is old."""

import numpy as np
from hypothesis import given

from pilotage.geometry import Polyline
from pilotage.scan_matching import LocalMap
from pilotage.scan_matching.local_map import owners_of_segments
from pilotage.shape import PartialShape
from strategies import polylines

WALL = PartialShape(Polyline.through([(1.0, -1.0), (1.0, 1.0)]))


def test_what_is_old_is_forgotten():
    local_map = LocalMap()
    for k in range(8):
        local_map = local_map.extended((WALL,), float(k), window=3.0)

    assert (4.0, 5.0, 6.0, 7.0) == local_map.entered_at
    assert (4, 4) == local_map.segments.shape


def test_the_map_given_stays_as_it_was():
    first = LocalMap().extended((WALL,), 0.0, window=10.0)
    first.extended((WALL,), 1.0, window=10.0)

    assert len(first.shapes) == 1


@given(polylines(), polylines(), polylines())
def test_every_segment_knows_its_shape(a, b, c):
    local_map = LocalMap().extended(tuple(PartialShape(line) for line in (a, b, c)), 0.0, window=1.0)
    expected = [np.hstack([line.ring[:-1], line.ring[1:]]) for line in (a, b, c)]

    np.testing.assert_array_equal(np.vstack(expected), local_map.segments)
    assert [len(part) for part in expected] == np.bincount(
        owners_of_segments(local_map.shapes), minlength=3
    ).tolist()


def test_an_empty_map_has_no_segments():
    assert (0, 4) == LocalMap().segments.shape
