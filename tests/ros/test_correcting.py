"""The map is corrected while a robot drives, and the robot stays on it."""

import functools
import time
from dataclasses import replace

import numpy as np
import pytest
import shapely
from benchmarks.lib.dds_robot import DdsRobot, run_together
from hypothesis import given, settings
from hypothesis import strategies as st

from buildings import coarse, flat, readings_of, walk
from pilotage import Pose2, Settings, open_map, open_world, worlds
from pilotage.cli.ros2 import writing_at_the_end
from pilotage.correction import correct_drawing
from pilotage.drives.loop import put_down
from pilotage.io.bags.belief import MapFrame
from pilotage.io.bags.bent_frame import BentFrame
from pilotage.localization import LocalizerSettings
from pilotage.maps import build_atlas
from pilotage.navigation import NavigatorSettings
from pilotage.perception import Reading
from pilotage.ranking.evidence import reduced
from pilotage.ros.correcting import Correcting
from pilotage.ros.node import Node, Quality
from pilotage.ros.robot import LiveRobot, Topics
from pilotage.ros.session import Session

SMALL = LocalizerSettings(atlas=coarse()), NavigatorSettings()
FLAT = build_atlas(flat(scale=10.0), SMALL[0].atlas)
START = (10.0, 60.0, -1.57)
READINGS = [Reading(scan, odometry) for scan, odometry in readings_of(walk())]


def walked() -> Session:
    """Walk through the flat."""
    session = Session(FLAT, SMALL, start=START, keeps_sightings=True)
    for reading in READINGS:
        session.update(reading)
    return session


@pytest.fixture(scope="module")
def session() -> Session:
    """A session that has seen the flat."""
    return walked()


def test_the_frame_stays_where_it_was(session):
    before = MapFrame(FLAT.sketch, 10.0)
    frame = BentFrame.after(before, correct_drawing(FLAT, session.sightings), session.sightings)
    places = np.array([one.sketch_from_base.translation for one in session.sightings])

    assert 0.3 > np.hypot(*(frame.from_sketch(places) - before.from_sketch(places)).T).max()
    again = BentFrame.after(frame, frame.corrected, session.sightings)
    assert frame.from_sketch(places) == pytest.approx(again.from_sketch(places), abs=1e-6)


@settings(deadline=None)
@given(st.floats(5.0, 95.0), st.floats(5.0, 75.0), st.floats(-3.0, 3.0))
def test_a_pose_of_the_bent_frame_is_found_again_in_the_file(x, y, theta):
    seen = corrected_frame()
    pose = Pose2(x, y, theta)
    there = seen.to_file(seen.pose_from_sketch(pose))
    back = seen.sketch.file_axes.pose_to_sketch(Pose2(*there))

    assert (x, y) == pytest.approx((back.x, back.y), abs=0.01)
    assert 0.0 == pytest.approx(np.angle(np.exp(1j * (theta - back.theta))), abs=0.02)


def test_a_start_that_is_told_begins_the_sightings_anew():
    session = walked()
    session.correct(correct_drawing(FLAT, session.sightings), len(session.sightings))
    began = session.sightings_began
    assert "" == session.begin_at(START)

    assert began < session.sightings_began
    assert [] == session.sightings
    session.update(READINGS[0])


def test_the_corrected_drawing_is_written_at_the_end_or_one_line_says_why_not(session, tmp_path, capsys):
    path = tmp_path / "flat.svg"
    with writing_at_the_end(Session(FLAT, SMALL, keeps_sightings=True), path):
        pass
    assert not path.exists()
    assert "no corrected drawing is written" in capsys.readouterr().err
    with pytest.raises(KeyboardInterrupt), writing_at_the_end(session, path):
        raise KeyboardInterrupt

    assert open_map(path).metres_per_unit == pytest.approx(1.0)


def test_a_process_that_ends_is_told_of_and_the_robot_goes_on(session, monkeypatch):
    monkeypatch.setattr("pilotage.ros.correcting.SIGHTINGS", 1)
    said = []
    beside = Correcting(session, said.append, every=0.0)
    beside.close()
    beside.look()
    beside.look()

    assert ["the map is not corrected any more: the process of the correction has ended"] == said


def test_a_map_that_has_not_changed_is_not_told_again(monkeypatch):
    monkeypatch.setattr("pilotage.ros.correcting.SIGHTINGS", 0)
    session, said = walked(), []
    beside = Correcting(session, said.append, every=0.0)
    frames = []
    for _ in range(2):
        beside.look()
        while beside.waits:
            time.sleep(0.01)
            beside.look()
        frames.append(session.frame)
    beside.close()

    assert isinstance(frames[0], BentFrame)
    assert frames[0] is frames[1]
    assert 1 == len(said)


@functools.cache
def corrected_frame() -> BentFrame:
    """Return the frame of the corrected flat."""
    session = walked()
    session.correct(correct_drawing(FLAT, session.sightings), len(session.sightings))
    assert isinstance(session.frame, BentFrame)
    return session.frame


@pytest.mark.slow
def test_a_corrected_map_is_published_and_scans_lie_on_it():
    chosen = replace(Settings(), localizer=reduced(LocalizerSettings(), 1 / 4))
    atlas = build_atlas(open_map(worlds.OFFICE.quick), chosen.localizer.atlas)
    simulator = put_down(open_world(worlds.OFFICE.world), None, np.random.default_rng(0), chosen.simulator)
    robot = DdsRobot(Node(191), simulator)
    session = Session(atlas, (chosen.localizer, chosen.navigator), keeps_sightings=True)
    said = []
    live = LiveRobot(Node(191), session, Topics(drives=True), said.append, lambda: simulator.stamp)
    live.set_goal("Ana")
    beside = Correcting(session, said.append, clock=lambda: simulator.stamp)
    listener = Node(191)
    maps = listener.subscribe("map", "nav_msgs/msg/OccupancyGrid", Quality(10, reliable=True, latched=True))
    time.sleep(0.5)

    def is_corrected() -> bool:
        beside.look()
        while beside.waits:  # the simulation is faster than reality
            time.sleep(0.01)
            beside.look()
        return isinstance(session.frame, BentFrame)

    run_together(robot, live, 300.0, is_corrected)
    heard = len(maps.take())
    off: list[tuple[float, float]] = []
    run_together(robot, live, 5.0, lambda: off.append((off_walls(live), off_drawing(live))))
    (grid,) = maps.take()
    beside.close()

    assert 1 <= heard <= 2  # as drawn, by a guessed scale and by the one that was found
    assert any("the map is corrected" in line for line in said)
    assert "map" == grid.header.frame_id
    assert {-1, 0, 100} == set(np.unique(grid.data).tolist())
    corrected, drawn = np.mean(off[1:], axis=0)
    assert 0.5 > corrected
    assert drawn > corrected


def off_walls(live: LiveRobot) -> float:
    """Return how far from the walls of the frame `map` the scan lies, as it is told [m]."""
    frame, told = live.session.frame, live.told
    assert isinstance(frame, BentFrame)
    walls = shapely.multilinestrings(frame.ground.walls.reshape(-1, 2, 2))
    ends = shapely.points(told.belief.pose @ told.scan.points_in_base)
    return float(np.median(np.abs(shapely.distance(ends, walls) - frame.ground.thickness / 2.0)))


def off_drawing(live: LiveRobot) -> float:
    """Return the same for the drawing as it is drawn, at the scale that is believed here."""
    estimate = live.session.position.estimate
    frame = MapFrame(live.session.atlas.sketch, estimate.scale)
    walls = shapely.multilinestrings(
        frame.from_sketch(frame.sketch.segments.reshape(-1, 2)).reshape(-1, 2, 2)
    )
    pose = frame.pose_from_sketch(estimate.sketch_from_base.pose)
    return float(np.median(shapely.distance(shapely.points(pose @ live.told.scan.points_in_base), walls)))
