import json
import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from buildings import flat, readings_of, walk
from pilotage.errors import FileError
from pilotage.evaluation.episodes import run_episode, spread_episodes, way_along
from pilotage.evaluation.rooms import Rooms, read_drawn_rooms, read_world_rooms
from pilotage.localization import Localizer
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


def test_an_episode_is_scored_by_rooms():
    poses = walk()
    readings = [Reading(scan, odometry) for scan, odometry in readings_of(poses)]
    positions = np.array([pose.position for pose in poses])

    score = run_episode(Localizer(flat()), readings, ROOMS.names_at(positions), way_along(positions), ROOMS)

    assert score.right_at_end
    assert 0.0 <= score.sure_and_wrong <= score.sure <= 1.0
    assert 0.0 <= score.meters_to_fix < way_along(positions)[-1]
    assert len(readings) == len(score.scan_ms)


def test_rooms_that_a_drawing_leaves_out_are_not_counted():
    poses = walk()[:4]
    readings = [Reading(scan, odometry) for scan, odometry in readings_of(poses)]
    only_east = Rooms(("east",), (SMALL_ROOM,))

    with pytest.raises(ValueError, match="a room that the drawing shows"):
        run_episode(Localizer(flat()), readings, ["west"] * 4, np.arange(4.0), only_east)


def test_the_way_adds_up_steps():
    assert [0.0, 5.0, 6.0] == way_along(np.array([(0, 0), (3, 4), (3, 5)])).tolist()
    assert math.isclose(0.0, way_along(np.zeros((1, 2)))[0])
