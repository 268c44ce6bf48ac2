"""Drives that cannot go well: the robot gives up or arrives, it touches nothing, and nothing falls over."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from pilotage.config import Settings
from pilotage.evaluation.drive import navigate
from pilotage.geometry import Polyline, Pose2
from pilotage.localization import LocalizerSettings
from pilotage.maps import AtlasSettings, RangeTableSettings, SchematicMap
from pilotage.navigation import NavigatorSettings, Outcome
from pilotage.simulation import BodySettings, LaserSettings, SimulatorSettings, World

ROOMS = (
    [(0, 0), (15, 0), (15, 5), (0, 5), (0, 0)],
    [(5, 0), (5, 2)],
    [(5, 3), (5, 5)],
    [(10, 0), (10, 2)],
    [(10, 3), (10, 5)],
)
"""Three rooms in a row."""
WORLD = World.of(SchematicMap(tuple(Polyline.through(stroke) for stroke in ROOMS)))
START, GOAL = Pose2(2.5, 2.5, 0.0), (12.5, 2.5)
SETTINGS = Settings(
    localizer=LocalizerSettings(atlas=AtlasSettings(range_table=RangeTableSettings(cells=80, directions=60))),
    navigator=NavigatorSettings(time_limit=8.0),
)


def drawn(scale=1.0):
    """Draw the rooms, so many units a metre."""
    return SchematicMap(tuple(Polyline.through(scale * np.array(stroke)) for stroke in ROOMS))


def boxed_in(pose, half):
    """Put up four walls about a place."""
    x, y = pose.position
    corners = [(x + half * dx, y + half * dy) for dx, dy in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))]
    walls = [[*a, *b] for a, b in pairwise(corners)]
    return World(np.vstack([WORLD.segments, walls]))


def is_over_without_harm(told):
    return told.outcome is not None and told.collisions == 0 and bool(told.reason)


@pytest.mark.parametrize(
    "laser",
    [
        LaserSettings(dropout=1.0),
        LaserSettings(range_max=0.5),
        LaserSettings(beams=31),
        LaserSettings(beams=90, field_of_view=math.radians(60.0)),
        LaserSettings(noise=0.5),
    ],
    ids=["blind", "short-sighted", "31 beams", "narrow", "noisy"],
)
def test_a_robot_with_a_poor_laser_gives_up_unharmed(laser):
    poor = replace(SETTINGS, simulator=SimulatorSettings(laser=laser))
    told = navigate(drawn(), WORLD, GOAL, start=START, world_start=START, settings=poor)

    assert is_over_without_harm(told)


def test_a_robot_that_is_boxed_in_gives_up():
    told = navigate(drawn(), boxed_in(START, 0.5), GOAL, start=START, world_start=START, settings=SETTINGS)

    assert is_over_without_harm(told)
    assert Outcome.GAVE_UP is told.outcome
    assert 1.0 > np.ptp(told.positions, axis=0).max()


def test_a_robot_that_stands_at_its_goal_need_not_go_far():
    told = navigate(drawn(), WORLD, (2.5, 2.5), start=START, world_start=START, settings=SETTINGS)

    assert is_over_without_harm(told)
    assert 2.5 > told.way


@pytest.mark.parametrize("scale", [1e-3, 1e4])
def test_a_drawing_may_be_of_any_scale(scale):
    goal = (12.5 * scale, 2.5 * scale)
    start = Pose2(2.5 * scale, 2.5 * scale, 0.0)
    told = navigate(drawn(scale), WORLD, goal, start=start, world_start=START, settings=SETTINGS)

    assert is_over_without_harm(told)


def test_a_robot_that_is_told_a_wrong_start_touches_nothing():
    told = navigate(
        drawn(), WORLD, GOAL, start=Pose2(7.5, 2.5, 0.0), world_start=Pose2(1.0, 1.0, 2.0), settings=SETTINGS
    )

    assert is_over_without_harm(told)


def test_a_large_robot_does_not_force_a_narrow_door():
    wide = replace(
        SETTINGS,
        simulator=SimulatorSettings(body=BodySettings(radius=0.6)),
        navigator=NavigatorSettings(radius=0.6, time_limit=15.0),
    )
    told = navigate(drawn(), WORLD, GOAL, start=START, world_start=START, settings=wide)

    assert is_over_without_harm(told)
    assert told.positions[:, 0].max() < 5.0
