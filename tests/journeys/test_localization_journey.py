"""Logs on drawings of their buildings: a robot put down anywhere finds its room, doubts when carried off."""

import json
import math

import numpy as np
import pytest

from few_particles import FEW
from pilotage import worlds
from pilotage.evaluation.episodes import continued, follow, score, spread_episodes, way_along
from pilotage.evaluation.rooms import read_drawn_rooms, read_world_rooms
from pilotage.evaluation.trajectory import associate
from pilotage.io import open_log, open_map
from pilotage.io.tum import read_trajectory
from pilotage.localization import Localizer, Status
from pilotage.maps import AtlasSettings, build_atlas
from shared_data import LOGS, SKETCHES, needs_logs

QUICK = FEW.localizer


def right_at_end(building, hand, count, length, apart):
    """Put a robot down `count` times, give it one scan in `apart`; count the times it ends in its room."""
    log = open_log(LOGS / f"{building}.log.gz")
    truth = read_trajectory(LOGS / f"{building}.truth.tum")
    stamps = np.array([reading.scan.stamp for reading in log])
    positions = truth.poses[associate(stamps, truth), :2]
    truths = read_world_rooms(SKETCHES / building / "rooms.geojson").names_at(positions)
    drawn_rooms = read_drawn_rooms(SKETCHES / building / f"{hand}.json")
    atlas = build_atlas(open_map(SKETCHES / building / f"{hand}.svg"), AtlasSettings())

    scores = []
    for seed, episode in enumerate(spread_episodes(positions, count, length)):
        chosen = slice(episode.first, episode.last + 1, apart)
        way = way_along(positions[chosen])
        localizer = Localizer(atlas, QUICK, seed=seed)
        scores.append(score(follow(localizer, log.readings[chosen], truths[chosen], way, drawn_rooms)))

    return sum(score.right_at_end for score in scores)


@needs_logs
@pytest.mark.slow
def test_a_robot_finds_its_room_on_quick_drawings():
    buildings = ("freiburg-079", "fhw")

    assert 6 <= sum(right_at_end(one, "quick", count=4, length=30.0, apart=3) for one in buildings)


@needs_logs
@pytest.mark.slow
def test_a_robot_finds_its_room_on_careful_drawings():
    buildings = ("belgioioso", "csail")

    assert 6 <= sum(right_at_end(one, "draftsman", count=4, length=40.0, apart=2) for one in buildings)


@pytest.fixture(scope="module")
def office():
    """The quick drawing of the packed office, its log, and the true place on the drawing at each scan."""
    truth = [json.loads(line) for line in worlds.TRUTH.read_text().splitlines()]
    places = np.array([(one["x"], one["y"]) for one in truth])
    return build_atlas(open_map(worlds.OFFICE.quick), AtlasSettings()), open_log(worlds.LOG).readings, places


def error(estimate, place):
    """Distance from the true place on the drawing [m]."""
    return math.dist((estimate.x, estimate.y), place) / estimate.scale


@pytest.mark.slow
def test_every_other_scan_leads_to_the_same_place(office):
    atlas, readings, places = office
    ends = []
    for apart in (1, 2):
        localizer = Localizer(atlas, QUICK)
        for reading in readings[:121:apart]:
            end = localizer.update(reading.scan, reading.odometry)
        ends.append(end)

    assert 1 == len({end.cell_id for end in ends})
    assert 1.0 > math.dist((ends[0].x, ends[0].y), (ends[1].x, ends[1].y)) / ends[0].scale
    assert all(1.0 > error(end, places[120]) for end in ends)


@pytest.mark.slow
def test_a_robot_that_was_carried_off_notices_and_finds_itself_again(office):
    atlas, readings, places = office
    taken, put, last = 60, 210, 285
    localizer = Localizer(atlas, QUICK)
    for reading in readings[: taken + 1]:
        before = localizer.update(reading.scan, reading.odometry)
    moved = continued(readings[put : last + 1], readings[taken])
    after = [localizer.update(reading.scan, reading.odometry) for reading in moved]
    positions = np.array([reading.odometry.odom_from_base.position for reading in moved])
    soon = [one for one, way in zip(after, way_along(positions), strict=True) if way <= 15.0]

    assert Status.LOCATED is before.status
    assert 1.0 > error(before, places[taken])
    assert 8.0 < math.dist(places[taken], places[put]) / before.scale
    assert 0.5 > min(one.probability for one in soon)
    assert Status.LOCATED is after[-1].status
    assert 1.0 > error(after[-1], places[last])
