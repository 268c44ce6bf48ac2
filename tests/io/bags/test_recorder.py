"""What is recorded is read by a reader that is not ours, and says what was believed."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from benchmarks.lib.bag_making import decoded
from hypothesis import given
from hypothesis import strategies as st

from knowing import estimate_at
from pilotage import Pose2, Reading, open_log, open_map, worlds
from pilotage.geometry import Homography
from pilotage.io.bags import outgoing
from pilotage.io.bags.belief import Belief, MapFrame, Place, covariance_of
from pilotage.io.bags.recorder import TYPES, recording
from pilotage.io.estimates import estimate_record
from pilotage.maps import FileAxes
from pilotage.maps.cells.decomposition import decompose
from pilotage.maps.cells.free_space import DecompositionSettings

SCALE = 20.0
EXAMPLES = Path(__file__).parents[3] / "examples"


@pytest.fixture(scope="module")
def frame():
    return MapFrame(open_map(worlds.OFFICE.careful), SCALE)


@pytest.fixture(scope="module")
def recorded(frame, tmp_path_factory):
    """The beliefs of five moments, and all messages by topic."""
    path = tmp_path_factory.mktemp("recorded") / "out.mcap"
    readings = open_log(worlds.LOG).readings[:5]
    values = {"status": "located", "place": "kitchen"}
    beliefs = [
        Belief(r.scan.stamp, (Place(Pose2(k, 2.0, 0.5), 0.9), Place(Pose2(0, 0, 0), 0.1)), np.eye(2), values)
        for k, r in enumerate(readings)
    ]
    with recording(path, frame, decompose(frame.sketch, DecompositionSettings())) as recorder:
        for belief, reading in zip(beliefs, readings, strict=True):
            recorder.add(belief, reading)
    messages, types = {}, {}
    for topic, type_name, message in decoded(path):
        messages.setdefault(topic, []).append(message)
        types[topic] = type_name
    assert types == TYPES
    return beliefs, readings, messages


def test_every_topic_has_its_standard_type(recorded):
    _, _, messages = recorded

    assert set(TYPES) == set(messages)


def test_pose_and_covariance_are_those_of_the_belief(recorded):
    beliefs, _, messages = recorded
    for belief, one in zip(beliefs, messages["/pilotage/pose"], strict=True):
        pose = one.pose
        assert "map" == one.header.frame_id
        assert (belief.pose.x, belief.pose.y) == (pose.pose.position.x, pose.pose.position.y)
        assert pytest.approx(belief.pose.theta) == 2 * math.atan2(
            pose.pose.orientation.z, pose.pose.orientation.w
        )
        np.testing.assert_allclose(np.eye(2), np.reshape(pose.covariance, (6, 6))[:2, :2])


def test_the_transforms_lead_from_the_map_to_the_robot(recorded):
    beliefs, _, messages = recorded
    found = [one.transforms[0] for one in messages["/tf"]]
    for belief, above, below in zip(beliefs, found[::2], found[1::2], strict=True):
        assert ("map", "odom", "odom", "base_link") == (
            above.header.frame_id,
            above.child_frame_id,
            below.header.frame_id,
            below.child_frame_id,
        )
        pose = planar(above) @ planar(below)
        assert pytest.approx((belief.pose.x, belief.pose.y)) == (pose.x, pose.y)


def test_scans_come_back_as_they_were(recorded):
    _, readings, messages = recorded
    for reading, one in zip(readings, messages["/scan"], strict=True):
        np.testing.assert_allclose(reading.scan.ranges, one.ranges, rtol=1e-6)


def test_the_grid_knows_walls_and_rooms(recorded, frame):
    _, _, messages = recorded
    grid = messages["/map"][0]
    cells = np.reshape(grid.data, (grid.info.height, grid.info.width))
    wall = frame.from_sketch(frame.sketch.segments[:1, :2])[0]
    column, row = ((wall - [grid.info.origin.position.x, grid.info.origin.position.y]) / 0.05).astype(int)

    assert {-1, 0, 100} == set(np.unique(cells).tolist())
    assert 100 in cells[row - 1 : row + 2, column - 1 : column + 2]


def planar(message):
    move, turn = message.transform.translation, message.transform.rotation
    return Pose2(move.x, move.y, 2 * math.atan2(turn.z, turn.w))


@given(x=st.floats(-50, 50), y=st.floats(-50, 50), theta=st.floats(-3.1, 3.1))
def test_a_pose_of_the_map_comes_back_from_the_file(frame, x, y, theta):
    pose = Pose2(x, y, theta)
    back = frame.from_file(*frame.to_file(pose))

    assert pytest.approx((x, y, theta), abs=1e-9) == (back.x, back.y, back.theta)


@given(angle=st.floats(0, 6), long=st.floats(0.01, 5), share=st.floats(0, 1))
def test_a_covariance_has_the_spread_and_the_axis_that_were_told(angle, long, share):
    axis = long * np.array([math.cos(angle), math.sin(angle)])
    std = long * math.sqrt(1.0 + share)
    covariance = covariance_of(std, axis)

    assert pytest.approx(std**2) == np.trace(covariance)
    np.testing.assert_allclose(covariance @ axis, long**2 * axis, atol=1e-6)


def test_a_line_of_a_journal_becomes_the_same_belief(frame):
    place = {"x": 100.0, "y": 60.0, "heading": 1.0, "probability": 0.8}
    belief = Belief.of_record({"stamp": 3.0, "hypotheses": [place], "status": "lost", "scale": 20.0}, frame)

    assert Pose2(5.0, -3.0, 1.0) == belief.pose  # y of SVG points down
    assert "lost" == belief.values["status"]
    assert 1 == outgoing.diagnostics(belief).status[0].level


def test_places_on_a_photo_are_the_same_from_an_estimate_and_from_its_record(frame):
    tilted = Homography.from_matrix(np.array([[1.0, 0.1, 3.0], [-0.2, 0.9, 5.0], [4e-4, -3e-4, 1.0]]))
    sketch = replace(frame.sketch, photo_from_sketch=tilted)
    axes = FileAxes(sketch.y_down, tilted)
    estimate = replace(estimate_at(100.0, -60.0, 1.0, scale=20.0), file_axes=axes)
    told = Belief.of_estimate(estimate, MapFrame(sketch, SCALE)).pose
    read = Belief.of_record(estimate_record(estimate, sketch), MapFrame(sketch, SCALE)).pose

    assert pytest.approx((5.0, -3.0, 1.0)) == (told.x, told.y, told.theta)
    assert pytest.approx((told.x, told.y, told.theta), abs=1e-6) == (read.x, read.y, read.theta)


def test_the_layout_shows_topics_that_are_recorded():
    layout = json.loads((EXAMPLES / "foxglove-layout.json").read_text(encoding="utf-8"))

    assert set(layout["configById"]["3D!pilotage"]["topics"]) - {"/pilotage/route"} <= set(TYPES)


def test_an_interrupted_recording_leaves_nothing(frame, tmp_path):
    reading = next(iter(open_log(worlds.LOG)))
    belief = Belief(1.0, (Place(Pose2.identity(), 1.0),), np.eye(2), {})
    with pytest.raises(ZeroDivisionError), recording(tmp_path / "out.mcap", frame, None) as recorder:  # noqa: PT012
        recorder.add(belief, Reading(reading.scan, reading.odometry))
        raise ZeroDivisionError

    assert [] == list(tmp_path.iterdir())
