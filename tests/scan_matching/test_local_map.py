"""The local map enters what is new, keeps what is known and forgets what is old."""

import math

import numpy as np
import pytest
from hypothesis import given

from pilotage.geometry import Polyline, Pose2
from pilotage.perception import Odometry
from pilotage.scan_matching import (
    Correspondence,
    OdometryNoise,
    PerceptionMap,
    PerceptionMapSettings,
    Registration,
)
from pilotage.scan_matching.local_map import segment_owners, segments_of
from pilotage.shape import PartialShape
from strategies import polylines

WALL = PartialShape(Polyline.through([(1.0, -1.0), (1.0, 1.0)]))


def registered(x, *, last=0.0, stamp=0.0, unmatched=(0,), known=()):
    odom_from_base = Pose2(x, 0.0, 0.0)
    return Registration(
        Odometry(stamp, odom_from_base),
        odom_from_base,
        Pose2(x - last, 0.0, 0.0),
        (WALL,),
        tuple(Correspondence(0, index, 2.0, 0.0) for index in known),
        unmatched=unmatched,
        support=1.0,
        residual=0.0,
        covariance=np.eye(3),
        noise=OdometryNoise(),
    )


def test_the_first_scan_is_entered_where_it_was_taken():
    perception_map = PerceptionMap().merged(registered(2.0))

    assert [[[3.0, -1.0], [3.0, 1.0]]] == [s.polyline.vertices.tolist() for s in perception_map.shapes]


def test_what_is_known_is_not_entered_again_but_seen_again():
    first = PerceptionMap().merged(registered(0.0, stamp=1.0))
    second = first.merged(registered(0.5, stamp=2.0, unmatched=(), known=(0,)))

    assert len(second.shapes) == 1
    assert (2.0,) == second.last_seen


def test_what_is_old_is_forgotten():
    settings = PerceptionMapSettings(window=3.0)
    perception_map = PerceptionMap(settings)
    for k in range(8):
        perception_map = perception_map.merged(registered(float(k), last=max(k - 1.0, 0.0)))

    assert [4.0, 5.0, 6.0, 7.0] == list(perception_map.entered_at)


def test_a_robot_that_stands_still_enters_nothing():
    first = PerceptionMap().merged(registered(0.0))
    second = first.merged(registered(0.1))

    assert first.shapes == second.shapes
    assert second.odom_from_base.x == 0.1
    assert second.segments is first.segments


def test_the_map_given_stays_as_it_was():
    first = PerceptionMap().merged(registered(0.0))
    first.merged(registered(1.0))

    assert len(first.shapes) == 1


def test_segments_carried_along_are_those_of_the_shapes():
    perception_map = PerceptionMap(PerceptionMapSettings(window=2.0))
    for k in range(6):
        perception_map = perception_map.merged(registered(float(k), last=max(k - 1.0, 0.0)))

    np.testing.assert_array_equal(segments_of(perception_map.shapes), perception_map.segments)


@given(polylines(), polylines(), polylines())
def test_segments_of_shapes_are_the_segments_of_each(a, b, c):
    shapes = tuple(PartialShape(line) for line in (a, b, c))
    expected = [np.hstack([line.ring[:-1], line.ring[1:]]) for line in (a, b, c)]

    np.testing.assert_array_equal(np.vstack(expected), segments_of(shapes))
    assert [len(part) for part in expected] == np.bincount(segment_owners(shapes), minlength=3).tolist()


def test_an_empty_map_has_no_segments():
    assert PerceptionMap().segments.shape == (0, 4)


@pytest.mark.parametrize("wrong", [{"window": 0.0}, {"reach": math.nan}, {"cell": -1.0}, {"key_turn": -0.1}])
def test_settings_that_cannot_be_meant_are_refused(wrong):
    with pytest.raises(ValueError, match="must be"):
        PerceptionMapSettings(**wrong)
