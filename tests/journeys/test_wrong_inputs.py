"""Inputs that are wrong, poor or strange: a clear error, or a sane answer."""

import json
import math

import numpy as np
import pytest

from pilotage import Localizer, LocalizerSettings, open_log, open_map, worlds
from pilotage.errors import FileError, PilotageError
from pilotage.geometry import Pose2
from pilotage.localization import Status, TrackSettings
from pilotage.maps import AtlasSettings, RangeTableSettings, build_atlas
from pilotage.perception import LaserScan, Odometry, Reading

FEW = LocalizerSettings(  # enough to fall over
    atlas=AtlasSettings(range_table=RangeTableSettings(cells=80, directions=60)),
    tracks=TrackSettings(first_count=4_000, max_count=2_000, min_count=1_000),
    proposals=500,
)
HOUSE = '<rect x="{x}" y="{y}" width="60" height="40" fill="none" stroke="black"/>'


def drawing(tmp_path, body):
    path = tmp_path / "drawing.svg"
    path.write_text(f'<svg viewBox="0 0 400 400">{body}</svg>')
    return path


def reading(k, ranges, *, stamp=None, step=0.2):
    at = float(k) if stamp is None else stamp
    scan = LaserScan(at, -math.pi / 2, math.pi / 180, np.asarray(ranges), range_max=30.0)
    return Reading(scan, Odometry(at, Pose2(step * k, 0.0, 0.0)))


def is_sane(estimate):
    place = estimate.sketch_from_base
    numbers = (place.scale, place.pose.x, place.pose.y, place.pose.theta, estimate.probability)
    return all(map(math.isfinite, numbers)) and 0.0 <= estimate.probability <= 1.0 and place.scale > 0.0


@pytest.fixture(scope="module")
def atlas():
    return build_atlas(open_map(worlds.OFFICE.quick), FEW.atlas)


@pytest.mark.parametrize(
    "ranges",
    [np.full(181, np.nan), np.full(181, np.inf), np.full(181, -np.inf), np.zeros(181), [np.inf], [np.nan]],
    ids=["nan", "no return", "too close", "zero", "one beam, no return", "one beam, nan"],
)
def test_scans_that_show_nothing_leave_the_robot_lost(atlas, ranges):
    localizer = Localizer(atlas, FEW)
    estimates = [localizer.update(one.scan, one.odometry) for one in (reading(k, ranges) for k in range(5))]

    assert all(is_sane(estimate) for estimate in estimates)
    assert {Status.LOST} == {estimate.status for estimate in estimates}


@pytest.mark.parametrize("ranges", [[2.0], [2.0, 2.0], [2.0, np.nan, 3.0]], ids=["one", "two", "three"])
def test_scans_of_a_few_beams_are_no_reason_to_fall_over(atlas, ranges):
    localizer = Localizer(atlas, FEW)
    estimates = [localizer.update(one.scan, one.odometry) for one in (reading(k, ranges) for k in range(5))]

    assert all(is_sane(estimate) for estimate in estimates)


def test_a_blind_stretch_in_a_log_is_survived(atlas):
    readings = open_log(worlds.LOG).readings[:30]
    blind = [
        Reading(
            LaserScan(r.scan.stamp, r.scan.angle_min, r.scan.angle_increment, np.full(len(r.scan), np.nan)),
            r.odometry,
        )
        for r in readings[10:20]
    ]
    localizer = Localizer(atlas, FEW)
    run = [*readings[:10], *blind, *readings[20:]]

    assert all(is_sane(localizer.update(one.scan, one.odometry)) for one in run)


def test_the_same_stamp_twice_is_taken_as_it_comes(atlas):
    readings = open_log(worlds.LOG).readings[:8]
    localizer = Localizer(atlas, FEW)
    estimates = [
        localizer.update(one.scan, one.odometry) for one in (part for part in readings for _ in range(2))
    ]

    assert all(is_sane(estimate) for estimate in estimates)
    assert estimates[0].stamp == estimates[1].stamp


def test_time_that_runs_backwards_is_no_reason_to_fall_over(atlas):
    localizer = Localizer(atlas, FEW)

    assert all(
        is_sane(localizer.update(one.scan, one.odometry))
        for one in reversed(open_log(worlds.LOG).readings[:8])
    )


def test_odometry_that_jumps_is_no_reason_to_fall_over(atlas):
    localizer = Localizer(atlas, FEW)
    room = np.full(181, 2.0)

    assert all(
        is_sane(localizer.update(one.scan, one.odometry))
        for one in (reading(k, room, step=step) for k, step in enumerate([0.0, 60.0, 0.1, -20.0, 0.1]))
    )


def test_two_buildings_on_one_sheet_are_both_possible(tmp_path):
    two = open_map(drawing(tmp_path, HOUSE.format(x=10, y=10) + HOUSE.format(x=300, y=300)))
    localizer = Localizer(two, FEW)
    estimates = [
        localizer.update(one.scan, one.odometry) for one in (reading(k, np.full(181, 2.0)) for k in range(4))
    ]

    assert all(is_sane(estimate) for estimate in estimates)


@pytest.mark.parametrize(
    "body",
    [
        '<path d="M10 10 L 90 10" stroke="black"/>',
        '<path d="M10 10 L 90 10 L 90 90" fill="none" stroke="black"/>',
        '<path d="M10 10 L 90 10 M10 30 L 90 30" stroke="black"/>',
    ],
)
def test_a_drawing_that_encloses_nothing_is_refused_in_one_line_or_answered(pilotage, tmp_path, body):
    outcome = pilotage("localize", drawing(tmp_path, body), worlds.LOG, "--to", 3)

    assert outcome.code in (0, 1)
    assert "Traceback" not in outcome.err
    if outcome.code == 1:
        assert outcome.err.startswith("pilotage: error: ")
        assert 1 == outcome.err.count("\n")


@pytest.mark.parametrize(
    ("content", "rule"),
    [
        ("", "empty"),
        ("stamp,x,y\n1,2,3\n", "no laser log"),
        ("\x89PNG\r\n", "no laser log"),
        ("FLASER 2 1.0 x 0 0 0 0 0 0 1 host 1\n", "no scan that can be read"),
    ],
)
def test_a_log_of_another_format_is_refused(tmp_path, content, rule):
    path = tmp_path / "run.log"
    path.write_bytes(content.encode("latin1"))

    with pytest.raises(FileError, match=rule):
        open_log(path)


def test_every_error_on_purpose_has_one_root():
    assert issubclass(FileError, PilotageError)


def test_estimates_on_standard_output_are_json_lines(pilotage):
    outcome = pilotage("localize", worlds.OFFICE.quick, worlds.LOG, "--from", 10, "--to", 13, "--seed", 3)
    records = [json.loads(line) for line in outcome.out.splitlines()]

    assert 0 == outcome.code
    assert 3 == len(records)
    names = {
        "stamp",
        "status",
        "place",
        "cell",
        "x",
        "y",
        "heading",
        "scale",
        "probability",
        "fit",
        "evidence",
        "hypotheses",
    }
    assert all(names == set(one) for one in records)
    assert outcome.err.startswith("3 scans: ")


def test_a_given_start_is_where_the_first_estimate_is(pilotage):
    outcome = pilotage(
        "localize", worlds.OFFICE.quick, worlds.LOG, "--to", 1, "--start", "105,176,-86", "--scale", "20"
    )
    (record,) = [json.loads(line) for line in outcome.out.splitlines()]

    assert 60.0 > math.hypot(record["x"] - 105.0, record["y"] - 176.0)
