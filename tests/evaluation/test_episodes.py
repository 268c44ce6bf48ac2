import json
import math
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from buildings import readings_of, walk
from pilotage.errors import FileError
from pilotage.evaluation.episodes import (
    Trace,
    continued,
    false_alarms,
    follow,
    lost,
    meters_to_doubt,
    meters_to_right,
    moved_elsewhere,
    score,
    settled,
    spread_episodes,
    way_along,
)
from pilotage.evaluation.rooms import Rooms, read_drawn_rooms, read_world_rooms
from pilotage.geometry import Pose2
from pilotage.localization import Status
from pilotage.perception import Reading

LONG_ROOM, SMALL_ROOM = shapely.box(0, 0, 3, 7), shapely.box(3, 0, 10, 7)
ROOMS = Rooms(("west", "east"), (LONG_ROOM, SMALL_ROOM))


def test_points_are_named_by_their_room():
    assert ("west", "east", "", "west") == ROOMS.names_at(np.array([(1, 1), (9, 1), (20, 1), (3, 3)]))


def test_rooms_are_read_from_both_formats(tmp_path):
    outline = [[0, 0], [3, 0], [3, 7], [0, 7]]
    feature = {"properties": {"name": "west"}, "geometry": {"coordinates": [[*outline, [0, 0]]]}}
    (tmp_path / "rooms.geojson").write_text(json.dumps({"features": [feature]}))
    (tmp_path / "quick.json").write_text(json.dumps({"rooms": {"west": outline}}))

    for rooms in (read_world_rooms(tmp_path / "rooms.geojson"), read_drawn_rooms(tmp_path / "quick.json")):
        assert ("west",) == rooms.names
        assert 21.0 == rooms.polygons[0].area


def test_a_broken_file_is_named(tmp_path):
    (tmp_path / "broken.json").write_text("{")

    with pytest.raises(FileError, match=r"broken\.json"):
        read_drawn_rooms(tmp_path / "broken.json")


@pytest.mark.parametrize(
    "content", ["{}", '{"rooms": 1, "features": 1}', "[]", "[1]", '{"rooms": {"a": [1]}}']
)
def test_rooms_of_another_shape_are_refused(tmp_path, content):
    (tmp_path / "odd.json").write_text(content)

    for read in (read_drawn_rooms, read_world_rooms):
        with pytest.raises(FileError, match=r"odd\.json"):
            read(tmp_path / "odd.json")


@given(st.lists(st.floats(0.01, 3.0), min_size=60, max_size=200), st.integers(1, 10))
def test_episodes_are_as_long_as_asked_give_or_take_one_step(steps, count):
    positions = np.column_stack([np.cumsum(steps), np.zeros(len(steps))])
    way = way_along(positions)
    length = 0.3 * way[-1]

    episodes = spread_episodes(positions, count, length)

    assert count == len(episodes)
    for episode in episodes:
        assert 0 <= episode.first < episode.last < len(positions)
        assert abs(way[episode.last] - way[episode.first] - length) <= 2 * max(steps)


def test_a_way_that_is_too_short_is_refused():
    with pytest.raises(ValueError, match="length must be"):
        spread_episodes(np.zeros((5, 2)), 3, 40.0)


def trace(probability, *, right=True, counted=True, mismatch=False, jump=0.0, step=1.0):
    """Make the trace of a robot that moves a step a scan."""
    n = len(probability)
    return Trace(
        step * np.arange(n),
        np.array(probability, dtype=float),
        np.broadcast_to(right, n).copy(),
        np.broadcast_to(counted, n).copy(),
        np.broadcast_to(mismatch, n).copy(),
        np.broadcast_to(np.asarray(jump, dtype=float), n).copy(),
        np.ones(n),
    )


class Fake:
    """A localizer that claims what it is told to."""

    def __init__(self, claims):
        self.claims = iter(claims)

    def update(self, _scan, _odometry):
        return next(self.claims)


def claim(x, y, probability=1.0, status="located", scale=1.0):
    return SimpleNamespace(x=x, y=y, probability=probability, status=status, scale=scale)


def test_claims_are_compared_with_rooms_and_odometry():
    poses = [Pose2(1.0, 1.0, 0.0), Pose2(2.0, 1.0, 0.0), Pose2(4.0, 1.0, 0.0)]
    readings = [Reading(scan, odometry) for scan, odometry in readings_of(poses)]
    claims = [claim(1, 1, 0.2, Status.LOST), claim(2, 1), claim(9, 1, status="mismatch")]

    made = follow(Fake(claims), readings, ["west", "west", "cellar"], np.array([5.0, 6.0, 8.0]), ROOMS)

    assert [0.0, 1.0, 3.0] == made.way.tolist()
    assert [0.2, 1.0, 1.0] == made.probability.tolist()
    assert [True, True, False] == made.right.tolist()
    assert [True, True, False] == made.counted.tolist()
    assert [False, False, True] == made.mismatch.tolist()
    assert [0.0, 0.0, 5.0] == made.jump.round(9).tolist()


def test_jumps_are_measured_in_metres_of_the_drawing():
    poses = [Pose2(1.0, 1.0, 0.0), Pose2(2.0, 1.0, 0.0)]
    readings = [Reading(scan, odometry) for scan, odometry in readings_of(poses)]

    made = follow(
        Fake([claim(0, 0, scale=10.0), claim(60, 0, scale=10.0)]), readings, ["", ""], np.arange(2.0), ROOMS
    )

    assert [0.0, 5.0] == made.jump.round(9).tolist()


def test_a_trace_survives_json():
    made = trace([0.1, 0.9], right=[True, False])

    again = Trace.from_lists(json.loads(json.dumps(made.to_lists())))

    for name in made.to_lists():
        assert getattr(made, name).tolist() == getattr(again, name).tolist()
        assert getattr(made, name).dtype == getattr(again, name).dtype


def test_an_episode_is_scored_by_rooms():
    right = [False, True, False, *[True] * 17]
    scored = score(trace([0.5, 0.95, 0.95, *[0.99] * 17], right=right))

    assert scored.right_at_end
    assert 1.0 == scored.right_last
    assert 3.0 == scored.meters_to_fix
    assert math.isclose(19 / 20, scored.sure)
    assert math.isclose(1 / 20, scored.sure_and_wrong)


def test_a_robot_that_is_never_right_takes_the_whole_way():
    assert 9.0 == score(trace([0.5] * 10, right=False)).meters_to_fix


def test_rooms_that_a_drawing_leaves_out_are_not_counted():
    assert 0.0 == score(trace([1.0, 1.0], right=[False, True], counted=[False, True])).meters_to_fix
    with pytest.raises(ValueError, match="a room that the drawing shows"):
        score(trace([1.0], counted=False))


def test_a_robot_is_settled_once_it_was_sure_for_five_metres():
    unsure = trace([0.5, 0.5, *[0.95] * 8, 0.8, 0.95])

    assert [6, 7, 8, 9] == np.flatnonzero(settled(unsure)).tolist()
    assert not lost(unsure).any()


def test_false_alarms_are_counted_once_it_was_found():
    doubting = trace([0.2, 0.95, 0.4, 0.4, 0.95, 0.3, 0.9], right=[True, True, True, True, True, False, True])

    assert (1, 5.0) == false_alarms(doubting)
    assert (0, 0.0) == false_alarms(trace([0.2, 0.3]))


def test_an_old_place_is_doubted_by_probability_or_by_another_claim():
    assert 2.0 == meters_to_doubt(trace([0.95, 0.8, 0.4, 0.9]))
    assert 1.0 == meters_to_doubt(trace([0.95, 0.95, 0.95], jump=[9.0, 3.5, 0.0]))
    assert math.inf == meters_to_doubt(trace([0.95, 0.95]))


def test_a_place_found_again_must_be_right_for_a_while():
    assert 6.0 == meters_to_right(trace([0.9] * 14, right=[False, True, *[False] * 4, *[True] * 8]))
    assert math.inf == meters_to_right(trace([0.9] * 3, right=False))


def test_a_robot_is_moved_to_another_room_with_some_way_ahead():
    positions = np.column_stack([np.arange(60.0), np.zeros(60)])
    truths = ["a"] * 20 + ["b"] * 20 + [""] * 10 + ["b"] * 10

    found = moved_elsewhere(positions, truths, 15, away=10.0, length=25.0)

    assert list(range(26, 35)) == found.tolist()


def test_odometry_and_time_go_on_after_a_kidnap():
    readings = [Reading(scan, odometry) for scan, odometry in readings_of(walk())]

    after = continued(readings[20:30], readings[5])

    assert readings[5].odometry.odom_from_base.position == pytest.approx(
        after[0].odometry.odom_from_base.position
    )
    for old, new, older, newer in zip(readings[20:29], after[:9], readings[21:30], after[1:], strict=True):
        motion = old.odometry.odom_from_base.inverse() @ older.odometry.odom_from_base
        again = new.odometry.odom_from_base.inverse() @ newer.odometry.odom_from_base
        assert (motion.x, motion.y, motion.theta) == pytest.approx((again.x, again.y, again.theta))
    assert [6.0, 7.0, 8.0] == [reading.scan.stamp for reading in after[:3]]
    assert [6.0, 7.0, 8.0] == [reading.odometry.stamp for reading in after[:3]]


def test_the_way_adds_up_steps():
    assert [0.0, 5.0, 6.0] == way_along(np.array([(0, 0), (3, 4), (3, 5)])).tolist()
    assert math.isclose(0.0, way_along(np.zeros((1, 2)))[0])
