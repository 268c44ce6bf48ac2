"""Whole drives on the packed buildings: to a room by its name, and by a drawing of another building."""

from dataclasses import replace

import numpy as np
import pytest

from knowing import with_leading
from pilotage import worlds
from pilotage.config import Settings
from pilotage.drives import Drive, drive, set_out
from pilotage.evaluation.drive import Destination, score
from pilotage.evaluation.rooms import read_world_rooms
from pilotage.io import open_map, open_world
from pilotage.localization import Localizer, LocalizerSettings, Status
from pilotage.navigation import Navigator, NavigatorSettings, Outcome
from pilotage.ranking.evidence import reduced
from pilotage.simulation import BodySettings, LaserSettings, Simulator, SimulatorSettings, find_start

FEW = reduced(LocalizerSettings(), 1 / 8)
SHORT = replace(Settings(), navigator=NavigatorSettings(time_limit=150.0))


@pytest.mark.slow
def test_a_room_that_is_named_is_reached_without_a_start():
    goal = "archive"
    navigator, simulator = set_out(
        open_map(worlds.OFFICE.careful), open_world(worlds.OFFICE.world), goal, seed=1, settings=SHORT
    )
    instants = list(drive(navigator, simulator))
    told = Drive.of(navigator.planner.atlas, simulator.world, navigator.planner.goal, instants)
    rooms = read_world_rooms(worlds.OFFICE.folder / "rooms.geojson")
    room = rooms.polygons[rooms.names.index(goal)]
    point = room.representative_point()
    scored = score(told, Destination((point.x, point.y), room, is_room=True), shortest=10.0)

    assert scored.reached, (scored.outcome, scored.reason, told.positions[-1])
    assert 0 == scored.collisions
    assert 3.0 < scored.way


class Unfit(Localizer):
    """Says that nothing of the drawing fits, as a localizer must once it has seen enough of another."""

    @property
    def estimate(self):
        return with_leading(replace(super().estimate, status=Status.MISMATCH), probability=0.1)

    def update(self, scan, odometry):
        super().update(scan, odometry)
        return self.estimate


def by_a_drawing_of_another_building(kind, seconds):
    """Drive in the office by a drawing of the house."""
    sketch, world = open_map(worlds.HOME.careful), open_world(worlds.OFFICE.world)
    rng = np.random.default_rng(0)
    localizer = kind(sketch, FEW, seed=0)
    label = sketch.labels[0].text
    navigator = Navigator(localizer, label, NavigatorSettings(time_limit=seconds, mismatch_patience=20.0))
    simulator = Simulator(world, find_start(world, 0.2, rng), rng, SHORT.simulator)
    instants = list(drive(navigator, simulator))
    return Drive.of(navigator.planner.atlas, world, navigator.planner.goal, instants)


@pytest.mark.slow
def test_a_robot_that_knows_that_its_drawing_does_not_fit_says_so_and_has_looked_for_more():
    told = by_a_drawing_of_another_building(Unfit, 60.0)

    assert Outcome.MISMATCH is told.outcome
    assert "this drawing does not fit this building" == told.reason
    assert 3.0 < told.length
    assert 0 == told.collisions


@pytest.fixture(scope="module")
def lost_in_another_building():
    return by_a_drawing_of_another_building(Localizer, 90.0)


@pytest.mark.slow
def test_there_is_little_evidence_for_a_drawing_of_another_building(lost_in_another_building):
    told = lost_in_another_building

    assert 25.0 > max(step.estimate.log_evidence for step in told.steps)  # by its own it would be 60
    assert 5.0 < told.length
    assert 0 == told.collisions


@pytest.mark.slow
def test_by_a_drawing_of_another_building_the_goal_is_not_reached(lost_in_another_building):
    """So it is on this drive; other drives by other drawings still end at a goal (decision 0032)."""
    assert Outcome.REACHED is not lost_in_another_building.outcome


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [360, 270])
def test_a_rectangular_robot_drives_through_the_office_and_touches_nothing(degrees):
    settings = replace(
        SHORT,
        localizer=reduced(SHORT.localizer, 1 / 4),
        navigator=replace(SHORT.navigator, radius=0.22, length=0.7, time_limit=240.0),
        simulator=SimulatorSettings(
            BodySettings(radius=0.22, length=0.7),
            LaserSettings(beams=degrees, field_of_view=np.radians(degrees - 1.0)),
        ),
    )
    navigator, simulator = set_out(
        open_map(worlds.OFFICE.careful), open_world(worlds.OFFICE.world), "archive", seed=1, settings=settings
    )
    instants = list(drive(navigator, simulator))
    told = Drive.of(navigator.planner.atlas, simulator.world, navigator.planner.goal, instants)

    assert 0 == told.collisions
    assert Outcome.REACHED is told.outcome, told.reason
