"""Real logs on careful drawings of their buildings: put down three times, at home at least twice."""

import numpy as np
import pytest

from pilotage.evaluation.episodes import run_episode, spread_episodes, way_along
from pilotage.evaluation.rooms import read_drawn_rooms, read_world_rooms
from pilotage.evaluation.trajectory import associate
from pilotage.io import open_log, open_map
from pilotage.io.tum import read_trajectory
from pilotage.localization import Localizer
from pilotage.maps import AtlasSettings, build_atlas
from shared_data import LOGS, needs_logs

SKETCHES = LOGS.parent / "sketches"


@needs_logs
@pytest.mark.parametrize("building", ["belgioioso", "csail"])
def test_a_robot_finds_its_room_on_a_careful_drawing(building):
    log = open_log(LOGS / f"{building}.log.gz")
    truth = read_trajectory(LOGS / f"{building}.truth.tum")
    stamps = np.array([reading.scan.stamp for reading in log])
    positions = truth.poses[associate(stamps, truth), :2]
    truths = read_world_rooms(SKETCHES / building / "rooms.geojson").names_at(positions)
    drawn_rooms = read_drawn_rooms(SKETCHES / building / "draftsman.json")
    atlas = build_atlas(open_map(SKETCHES / building / "draftsman.svg"), AtlasSettings())

    scores = []
    for seed, episode in enumerate(spread_episodes(positions, 3, 40.0)):
        chosen = slice(episode.first, episode.last + 1)
        way = way_along(positions[chosen])
        localizer = Localizer(atlas, seed=seed)
        scores.append(run_episode(localizer, log.readings[chosen], truths[chosen], way, drawn_rooms))

    assert sum(score.right_at_end for score in scores) >= 2
