"""A session that is stopped and started again still knows its place and what was blocked."""

from dataclasses import replace

import pytest

from buildings import coarse, flat, readings_of, walk
from pilotage.correction import correct_drawing
from pilotage.errors import PilotageError
from pilotage.io.state import read_state
from pilotage.localization import LocalizerSettings
from pilotage.maps import build_atlas
from pilotage.navigation import NavigatorSettings
from pilotage.perception import Reading
from pilotage.ros.session import Session

SETTINGS = LocalizerSettings(atlas=coarse()), NavigatorSettings()
ATLAS = build_atlas(flat(scale=10.0), SETTINGS[0].atlas)
READINGS = [Reading(scan, odometry) for scan, odometry in readings_of(walk())]


def test_a_session_goes_on_where_it_stopped(tmp_path):
    path = tmp_path / "flat.state"
    session = Session(ATLAS, SETTINGS, start=(10.0, 60.0, -1.57))
    assert not session.has_seen
    for reading in READINGS[:12]:
        before = session.update(reading).belief.values
    session.save(path)
    resumed = Session(ATLAS, SETTINGS, resumed=read_state(path))
    after = resumed.update(READINGS[11]).belief.values

    assert before["place"] == after["place"]
    assert float(before["probability"]) == pytest.approx(float(after["probability"]), abs=0.2)
    assert 0.9 < float(after["probability"])
    assert 0.9 > float(Session(ATLAS, SETTINGS).update(READINGS[11]).belief.values["probability"])


def test_the_gateways_that_were_blocked_are_blocked_again(tmp_path):
    path = tmp_path / "flat.state"
    session = Session(ATLAS, SETTINGS, start=(10.0, 60.0, -1.57))
    session.update(READINGS[0])
    session.save(path)
    saved = read_state(path)
    (gateway,) = ATLAS.cell_graph.gateways[:1]
    blocked = type(saved)(saved.localizer, (gateway.gateway_id,))
    resumed = Session(ATLAS, SETTINGS, resumed=blocked)
    assert not resumed.set_goal((85.0, 50.0))

    assert (gateway.gateway_id,) == resumed.blocked
    resumed.set_goal(None)
    assert (gateway.gateway_id,) == resumed.blocked


def test_gateways_that_the_drawing_has_no_more_are_forgotten(tmp_path):
    path = tmp_path / "flat.state"
    session = Session(ATLAS, SETTINGS, start=(10.0, 60.0, -1.57))
    session.update(READINGS[0])
    session.save(path)
    resumed = Session(ATLAS, SETTINGS, resumed=replace(read_state(path), blocked=("g99",)))

    assert not resumed.set_goal((85.0, 50.0))
    assert () == resumed.blocked


def test_a_session_of_another_drawing_is_refused(tmp_path):
    path = tmp_path / "flat.state"
    session = Session(ATLAS, SETTINGS)
    session.save(path)
    other = build_atlas(flat(scale=12.0), SETTINGS[0].atlas)
    with pytest.raises(PilotageError, match="of another drawing"):
        Session(other, SETTINGS, resumed=read_state(path))


def test_what_corrects_the_drawing_is_kept(tmp_path):
    path = tmp_path / "flat.state"
    session = Session(ATLAS, SETTINGS, start=(10.0, 60.0, -1.57), keeps_sightings=True)
    for reading in READINGS:
        session.update(reading)
    session.save(path)
    resumed = Session(ATLAS, SETTINGS, resumed=read_state(path), keeps_sightings=True)
    first, second = (correct_drawing(ATLAS, one.sightings) for one in (session, resumed))

    assert 10 < len(session.sightings) == len(resumed.sightings)
    assert first.path.tolist() == second.path.tolist()
    assert first.scale == second.scale
