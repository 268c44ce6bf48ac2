"""A localizer that is saved and resumed goes on as if it had never stopped."""

import contextlib
import json
import math
import zipfile
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from buildings import coarse, flat, readings_of, walk
from pilotage.errors import FileError
from pilotage.io.state import TREE, read_state, resume, save_state
from pilotage.localization import BlockedWay, Localizer, LocalizerSettings
from pilotage.maps import build_atlas

SETTINGS = LocalizerSettings(atlas=coarse())
SKETCH = flat(scale=10.0)
ATLAS = build_atlas(SKETCH, SETTINGS.atlas)
READINGS = readings_of(walk())


def line_of(estimate):
    """Write an estimate to the last digit."""
    first = estimate.hypotheses[0]
    return estimate.stamp, estimate.status, estimate.x, estimate.y, estimate.heading, first.probability


def run(localizer, readings):
    """Localize along some readings."""
    return [line_of(localizer.update(scan, odometry)) for scan, odometry in readings]


def first_half(localizer):
    """Localize along the first readings, and find a way blocked."""
    estimates = run(localizer, READINGS[:20])
    localizer.add_blocked_way(BlockedWay((0.5, 0.0), (2.0, 0.5)))
    return estimates


@pytest.fixture(scope="module")
def unbroken():
    localizer = Localizer(ATLAS, SETTINGS, seed=3)
    return first_half(localizer) + run(localizer, READINGS[20:])


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    path = tmp_path_factory.mktemp("state") / "flat.state"
    localizer = Localizer(ATLAS, SETTINGS, seed=3)
    first_half(localizer)
    save_state(path, localizer, ("g1",))
    return path


def test_estimates_go_on_to_the_byte(saved, unbroken):
    assert unbroken[20:] == run(resume(saved, ATLAS, SETTINGS), READINGS[20:])


def test_what_is_saved_again_is_the_same(saved, tmp_path):
    again = tmp_path / "again.state"
    save_state(again, resume(saved, SKETCH, SETTINGS), read_state(saved).blocked)
    with zipfile.ZipFile(saved) as first, zipfile.ZipFile(again) as second:
        assert first.namelist() == second.namelist()
        assert all(first.read(name) == second.read(name) for name in first.namelist())
    assert ("g1",) == read_state(again).blocked


def test_a_robot_that_stood_may_have_odometry_that_begins_anew(saved, unbroken):
    localizer = resume(saved, ATLAS, SETTINGS, stood=True)
    first = READINGS[19][1].odom_from_base.inverse()
    anew = [(scan, replace(one, odom_from_base=first @ one.odom_from_base)) for scan, one in READINGS[19:]]
    ends = run(localizer, anew)

    assert 1e-9 > abs(anew[0][1].odom_from_base.x)
    assert math.dist(unbroken[-1][2:4], ends[-1][2:4]) < 5.0


def test_the_state_of_another_drawing_is_refused_in_one_line(saved):
    with pytest.raises(FileError, match="of another drawing"):
        resume(saved, flat(scale=11.0), SETTINGS)


def spoil(saved, tmp_path, **changes):
    """Write the state with changes to its tree."""
    path = tmp_path / "spoilt.state"
    with zipfile.ZipFile(saved) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            new.writestr(name, json.dumps({**json.loads(content), **changes}) if name == TREE else content)
    return path


@pytest.mark.parametrize(
    ("changes", "rule"),
    [
        ({"version": 1}, "must be of version 4, got 1"),
        ({"state": None}, "no saved state"),
        ({"state": {"type": "Path", "fields": {}}}, "no saved state"),
        ({"blocked": 3}, "no saved state"),
    ],
)
def test_a_state_of_another_version_or_kind_is_refused(saved, tmp_path, changes, rule):
    with pytest.raises(FileError, match=rule):
        read_state(spoil(saved, tmp_path, **changes))


@settings(deadline=None, max_examples=25)
@given(st.floats(0.0, 0.999), st.integers(0, 255))
def test_no_spoilt_byte_makes_anything_but_a_file_error(saved, tmp_path_factory, where, value):
    content = bytearray(saved.read_bytes())
    content[int(where * len(content))] ^= value
    path = tmp_path_factory.mktemp("spoilt") / "spoilt.state"
    path.write_bytes(content)
    with contextlib.suppress(FileError):
        read_state(path)


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"hello"])
def test_what_is_no_state_is_refused(tmp_path, content):
    path = tmp_path / "no.state"
    path.write_bytes(content)
    with pytest.raises(FileError, match="no saved state, or it is damaged"):
        read_state(path)
