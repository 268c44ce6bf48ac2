"""The null hypothesis: how well drawings of buildings where the robot is not explain what it sees."""

import math
import runpy
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from buildings import coarse, flat, readings_of, walk
from pilotage import worlds
from pilotage.io import open_log, open_map
from pilotage.localization import (
    Localizer,
    LocalizerSettings,
    OtherBuildings,
    SensorSettings,
    Status,
    TrackSettings,
    observe,
)
from pilotage.localization.other_buildings import SHEET, sheet
from pilotage.maps import build_atlas
from pilotage.scan_matching import ScanMatcher
from shared_data import LOGS, SKETCHES, needs_logs

SCRIPT = Path(__file__).parents[2] / "examples" / "make_other_buildings.py"
ATLAS = build_atlas(flat(), coarse(120, 120))
PATH = walk()
FEW = LocalizerSettings(
    tracks=TrackSettings(first_count=20_000, max_count=5_000, min_count=1_000), proposals=2_000
)


def keyframes(poses=PATH[::2]):
    """Take what is compared with drawings along a walk in the flat."""
    matcher = ScanMatcher()
    for scan, odometry in readings_of(poses):
        seen = matcher.update(scan, odometry)
        yield observe(scan, seen.shapes, seen.last_from_base)


def test_the_sheet_is_what_its_script_draws():
    made = runpy.run_path(str(SCRIPT))
    with files("pilotage.localization").joinpath(SHEET).open() as file:
        packed = np.loadtxt(file, delimiter=",")

    assert packed == pytest.approx(made["sheet"](made["SEEDS"]), abs=0.0051)


def test_the_sheet_is_in_metres_and_has_room_for_a_robot():
    left, bottom, right, top = sheet().sketch.bounds

    assert 0.0 == sheet().log_scale
    assert 20.0 < right - left < 150.0
    assert 10.0 < top - bottom < 60.0
    assert 5_000 < len(sheet().range_table.places)


def test_a_keyframe_is_returned_as_it_was_but_for_its_likelihood_elsewhere():
    seen = next(iter(keyframes()))
    compared = OtherBuildings(SensorSettings()).compared(seen)

    assert 0.0 == seen.log_elsewhere != compared.log_elsewhere
    assert seen.scan is compared.scan
    assert seen.motion == compared.motion


def test_it_follows_a_robot_alike_each_time_and_goes_on_from_its_state():
    first, second, third = (OtherBuildings(SensorSettings()) for _ in range(3))
    some = list(keyframes())
    ratios = [first.compared(one).log_elsewhere for one in some]
    for one in some[:5]:
        second.compared(one)
    third.go_on(second.state)

    assert ratios[5:] == [third.compared(one).log_elsewhere for one in some[5:]]


def test_no_way_is_explained_much_worse_than_by_ranges_of_any_building():
    rng = np.random.default_rng(0)
    others, total = OtherBuildings(SensorSettings()), 0.0
    for seen in keyframes():
        levels = seen.scan.levels + rng.integers(-40, 40, len(seen.scan.levels)).astype(np.int32)
        noisy = replace(seen, scan=replace(seen.scan, levels=levels))
        total += others.compared(noisy).log_elsewhere

    assert math.log(0.2) - 1.0 < total  # its own null track: the prior, less what leaves the sheet


def test_the_right_drawing_explains_the_way_better_than_other_buildings_do():
    localizer = Localizer(ATLAS, FEW)
    for scan, odometry in readings_of(PATH):
        localizer.update(scan, odometry)

    assert 5.0 < localizer.log_evidence
    assert Status.LOCATED is localizer.estimate.status


@pytest.mark.slow
def test_in_the_office_its_own_drawing_is_told_from_that_of_the_museum():
    evidence = {}
    for building in (worlds.OFFICE, worlds.MUSEUM):
        localizer = Localizer(open_map(building.careful), FEW)
        for reading in open_log(worlds.LOG).readings[:121:2]:
            localizer.update(reading.scan, reading.odometry)
        evidence[building] = localizer.log_evidence

    assert 40.0 < evidence[worlds.OFFICE]
    assert 25.0 > evidence[worlds.MUSEUM]


@needs_logs
@pytest.mark.slow
def test_a_drawing_of_another_building_is_noticed():
    readings = open_log(LOGS / "belgioioso.log.gz").readings[:80]
    localizer = Localizer(open_map(SKETCHES / "freiburg-101" / "draftsman.svg"), FEW)
    for reading in readings:
        localizer.update(reading.scan, reading.odometry)

    assert -10.0 > localizer.log_evidence
    assert Status.MISMATCH is localizer.estimate.status
