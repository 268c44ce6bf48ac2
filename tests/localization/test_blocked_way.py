"""Ways that a robot found blocked: which places they speak against."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from buildings import coarse, flat, readings_of, walk
from pilotage.geometry import Polyline, Pose2
from pilotage.localization import BlockedWay, Localizer, LocalizerSettings, TrackSettings
from pilotage.localization.blocked_way import FREE_PENALTY, log_ratio_of_ways
from pilotage.localization.keyframes import append_blocked_way, append_keyframe, ways_in_base
from pilotage.localization.observation import observe
from pilotage.maps import SchematicMap, build_atlas

SMALL = LocalizerSettings(
    tracks=TrackSettings(first_count=20_000, max_count=6_000, min_count=2_000), proposals=3_000
)
AHEAD = BlockedWay((0.0, 0.0), (3.0, 0.0))

coordinates = st.floats(-5.0, 5.0)
poses = st.builds(Pose2, coordinates, coordinates, st.floats(-math.pi, math.pi))
points = st.tuples(coordinates, coordinates)
ways = st.builds(BlockedWay, points, points)


@pytest.fixture(scope="module")
def room():
    """A room of 8 by 6 m, drawn at 10 units a metre."""
    strokes = (Polyline(10.0 * np.array([(0.0, 0.0), (8.0, 0.0), (8.0, 6.0), (0.0, 6.0)]), closed=True),)
    return build_atlas(SchematicMap(strokes), coarse(60, 120))


def state(x, y, heading):
    return np.array([[x], [y], [heading], [math.log(10.0)], [0.0], [0.0]])


@pytest.mark.parametrize(
    ("x", "heading", "expected"),
    [
        (20.0, 0.0, -FREE_PENALTY),  # 6 m to the wall ahead: the way is drawn free
        (70.0, 0.0, 0.0),  # 1 m to the wall ahead
        (70.0, math.pi, -FREE_PENALTY),  # 7 m the other way
    ],
)
def test_a_blocked_way_speaks_against_places_where_it_is_drawn_free(room, x, heading, expected):
    assert log_ratio_of_ways(state(x, 30.0, heading), [AHEAD], room) == pytest.approx([expected])


def test_each_way_counts_and_none_says_nothing(room):
    behind = BlockedWay((0.0, 0.0), (-1.0, 0.0))

    assert [-2.0 * FREE_PENALTY] == log_ratio_of_ways(state(30.0, 30.0, 0.0), [AHEAD, behind], room).tolist()
    assert [0.0] == log_ratio_of_ways(state(30.0, 30.0, 0.0), [], room).tolist()


@given(ways, poses)
def test_a_way_that_is_moved_there_and_back_is_the_same(way, pose):
    back = way.moved(pose).moved(pose.inverse())

    assert back.start == pytest.approx(way.start, abs=1e-6)
    assert back.end == pytest.approx(way.end, abs=1e-6)
    assert way.is_same(back)


def test_a_window_keeps_a_way_once_wherever_the_robot_goes():
    seen = [observe(*one) for one in observations()]
    window = append_blocked_way(append_keyframe((), seen[0]), AHEAD)
    moved = append_keyframe(window, seen[1])
    (known,) = ways_in_base(moved)

    assert known.end == pytest.approx((2.0, 0.0))
    assert moved is append_blocked_way(moved, known)
    assert 2 == len(ways_in_base(append_blocked_way(moved, AHEAD.moved(Pose2(0.0, 4.0, 0.0)))))


def observations():
    """Two scans, the second one metre ahead of the first."""
    (scan, _), *_ = readings_of(walk()[:1])
    return [(scan, (), Pose2.identity()), (scan, (), Pose2(1.0, 0.0, 0.0))]


def test_a_way_is_counted_once_and_lets_other_places_gain():
    localizer = Localizer(build_atlas(flat(12.0), coarse(120, 120)), SMALL, seed=1)
    for reading in readings_of(walk()[:12]):
        localizer.update(*reading)
    before, null = localizer.estimate, localizer.tracks.log_null
    free = BlockedWay((0.0, 0.0), (0.2, 0.0))  # drawn free wherever the robot may be
    localizer.add_blocked_way(free)
    once = localizer.tracks.log_null
    localizer.add_blocked_way(free)

    assert null < once
    assert once == localizer.tracks.log_null
    assert localizer.estimate.probability <= before.probability
    assert localizer.estimate.stamp == before.stamp


def test_a_way_needs_a_scan_before_it():
    with pytest.raises(ValueError, match="a blocked way needs a scan before it, got none"):
        Localizer(build_atlas(flat(12.0), coarse(120, 120)), SMALL).add_blocked_way(AHEAD)
