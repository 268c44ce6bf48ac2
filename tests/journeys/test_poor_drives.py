"""Drives under poor conditions: the robot does what it can, touches nothing, and ends with an outcome.

Each journey has a floor that says how much it must do at least. A robot that does nothing fails them.
"""

import functools
import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest

from pilotage.config import Settings
from pilotage.drives import navigate
from pilotage.geometry import Polyline, Pose2, Twist
from pilotage.localization import LocalizerSettings
from pilotage.maps import AtlasSettings, RangeTableSettings, SchematicMap
from pilotage.navigation import Behavior, Navigator, NavigatorSettings, Outcome
from pilotage.simulation import BodySettings, LaserSettings, SimulatorSettings, World

ROOMS = (
    [(0, 0), (15, 0), (15, 5), (0, 5), (0, 0)],
    [(5, 0), (5, 2)],
    [(5, 3), (5, 5)],
    [(10, 0), (10, 2)],
    [(10, 3), (10, 5)],
)
"""Three rooms in a row."""
START, GOAL = Pose2(2.5, 2.5, 0.0), (12.5, 2.5)
TOLD = (2.5, 2.5, 0.0)
FEW = LocalizerSettings(atlas=AtlasSettings(range_table=RangeTableSettings(cells=80, directions=60)))


CORNER = [(0, 0), (15, 0), (15, 9), (9, 9), (9, 5), (0, 5), (0, 0)]
CLOSED, OPEN = (CORNER, [(5, 0), (5, 5)]), (CORNER, [(5, 0), (5, 3)], [(5, 4), (5, 5)])
"""Two rooms, one of them around a corner, by someone who forgot the door; and as they are."""


def world_of(strokes):
    """Build what is drawn."""
    return World.of(SchematicMap(tuple(Polyline.through(stroke) for stroke in strokes)))


WORLD = world_of(ROOMS)


def drawn(scale=1.0, strokes=ROOMS):
    """Draw the rooms, so many units a metre."""
    return SchematicMap(tuple(Polyline.through(scale * np.array(stroke)) for stroke in strokes))


def boxed_in(pose, half):
    """Put up four walls about a place."""
    x, y = pose.position
    corners = [(x + half * dx, y + half * dy) for dx, dy in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))]
    walls = [[*a, *b] for a, b in pairwise(corners)]
    return World(np.vstack([WORLD.segments, walls]))


@dataclass(frozen=True)
class Journey:
    """A drive, and the least that the robot must do."""

    seconds: float
    travels: float = 0.0  # [m] at least
    turns: float = 0.0  # [rad] at least
    reaches: bool = False
    world: World = WORLD
    scale: float = 1.0
    strokes: tuple[list[tuple[float, float]], ...] = ROOMS
    told: tuple[float, float, float] = TOLD
    truly: Pose2 = START
    laser: LaserSettings | None = None
    radius: float = 0.2

    def driven(self, seconds=None):
        simulator = SimulatorSettings(body=BodySettings(radius=self.radius))
        if self.laser is not None:
            simulator = replace(simulator, laser=self.laser)
        navigator = NavigatorSettings(radius=self.radius, time_limit=seconds or self.seconds)
        scale, (x, y, heading) = self.scale, self.told
        return navigate(
            drawn(scale, self.strokes),
            self.world,
            (scale * GOAL[0], scale * GOAL[1]),
            start=(scale * x, scale * y, heading),
            world_start=self.truly,
            settings=Settings(localizer=FEW, navigator=navigator, simulator=simulator),
        )

    def is_done_by(self, told):
        """Tell whether the robot did at least what it must."""
        headings = np.unwrap([scene.world_from_base.theta for scene in told.scenes])
        return (
            told.length >= self.travels
            and np.abs(np.diff(headings)).sum() >= self.turns
            and (told.outcome is Outcome.REACHED or not self.reaches)
        )


JOURNEYS = {
    "short-sighted": Journey(8.0, travels=1.0, laser=LaserSettings(range_max=0.5)),
    "31 beams": Journey(30.0, travels=9.0, reaches=True, laser=LaserSettings(beams=31)),
    "narrow": Journey(
        30.0, travels=9.0, reaches=True, laser=LaserSettings(beams=90, field_of_view=math.radians(60.0))
    ),
    "noisy": Journey(15.0, travels=2.0, laser=LaserSettings(noise=0.5)),
    "boxed in": Journey(8.0, turns=0.5, world=boxed_in(START, 0.5)),
    "tiny drawing": Journey(20.0, travels=9.0, scale=1e-3),
    "huge drawing": Journey(20.0, travels=9.0, scale=1e4),
    "forgotten doors": Journey(40.0, travels=9.0, reaches=True, strokes=CLOSED, world=world_of(OPEN)),
    "wrong start": Journey(15.0, travels=3.0, told=(7.5, 2.5, 0.0), truly=Pose2(1.0, 1.0, 2.0)),
    "large robot": Journey(15.0, travels=1.0, radius=0.6),
}


@functools.cache
def driven(name):
    """Go on a journey once, for all tests that look at it."""
    return JOURNEYS[name].driven()


@pytest.mark.parametrize("name", JOURNEYS)
def test_a_robot_under_poor_conditions_does_its_least_and_no_harm(name):
    told = driven(name)

    assert JOURNEYS[name].is_done_by(told), (told.length, told.outcome)
    assert told.outcome is not None
    assert told.reason
    assert 0 == told.collisions


@pytest.mark.parametrize("name", JOURNEYS)
def test_a_robot_that_does_nothing_does_not_do_its_least(name, monkeypatch):
    monkeypatch.setattr(Navigator, "_command", lambda _self, _scan: (Twist(0.0, 0.0), Behavior.WAIT))
    told = JOURNEYS[name].driven(seconds=1.0)

    assert 0.0 == told.length
    assert not JOURNEYS[name].is_done_by(told)


def test_a_robot_that_is_boxed_in_gives_up_where_it_is():
    told = driven("boxed in")

    assert Outcome.GAVE_UP is told.outcome
    assert 1.0 > np.ptp(told.positions, axis=0).max()


def test_a_large_robot_does_not_force_a_narrow_door():
    assert 5.0 > driven("large robot").positions[:, 0].max()


def test_a_robot_whose_laser_is_covered_does_not_move():
    told = Journey(4.0, laser=LaserSettings(dropout=1.0)).driven()

    assert 0.0 == told.length
    assert Outcome.GAVE_UP is told.outcome


def test_a_robot_that_stands_at_its_goal_stays_and_says_so():
    told = Journey(8.0, told=(*GOAL, 0.0), truly=Pose2(*GOAL, 0.0)).driven()

    assert Outcome.REACHED is told.outcome
    assert 0.5 > told.length
