"""Drives over the websocket."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from pilotage.web.table import Table
from web_table import CLOSED, CONTENT, FLAT, LIVE, Talk

REAL = {"made_real": {"severity": 0.4, "seed": 3}}


@contextmanager
def talking(client: TestClient) -> Iterator[Talk]:
    """Open a websocket."""
    with client.websocket_connect(LIVE) as websocket:
        yield Talk(websocket)


@pytest.mark.slow
def test_a_drive_made_real_is_seen_from_its_start_to_its_goal(client: TestClient) -> None:
    with talking(client) as talk:
        session, world, frame = talk.start(), talk.hear("world"), talk.hear("frame")
        done = talk.hear("done")

    assert "reached" == done["outcome"]
    assert "store" == session["goal"]
    assert 4 == len(world["doors"])
    assert 750 == len(frame["believed"]["particles"])
    left, top, right, bottom = world["bounds"]
    x, y, _ = frame["world"]["pose"]
    assert left < x < right
    assert top < y < bottom
    (listed,) = client.get("/api/sessions").json()["sessions"]
    assert (True, "reached") == (listed["over"], listed["outcome"])
    check_record(client, session["session"])


def check_record(client: TestClient, number: str) -> None:
    """A drive that is over can be looked back at, kept, and gone on with."""
    journal = client.get(f"/api/sessions/{number}/journal").text.splitlines()
    assert "reached" == json.loads(journal[-1])["outcome"]
    assert client.get(f"/api/sessions/{number}/picture").content.startswith(b"\x89PNG")
    with talking(client) as talk:
        talk.say("resume", session=number)
        assert talk.hear("session")["resumed"]
        kinds = [mark["kind"] for mark in talk.hear("marks")["marks"]]
        assert ("found", "reached") == (kinds[0], kinds[-1])
        now = talk.hear("frame")
        talk.say("scrub", t=0)
        past = talk.hear("frame")
        assert (False, 0.0) == (past["live"], past["t"])
        talk.say("scrub", t=None)
        assert now == talk.hear("frame")
        talk.say("goal", goal="kitchen")
        talk.hear_until("state", lambda state: state["over"] is False)
        assert now["t"] < talk.hear("frame")["t"]
    assert 204 == client.delete(f"/api/sessions/{number}").status_code
    assert 404 == client.get(f"/api/sessions/{number}/journal").status_code


def test_a_person_may_play_fate(client: TestClient) -> None:
    with talking(client) as talk:
        talk.start(paused=True)
        world, before = talk.hear("world"), talk.hear("frame")
        x, y, heading = before["world"]["pose"]

        talk.say("box", x=x, y=y)
        assert "where the robot is" in talk.hear("error")["text"]
        talk.say("kidnap", x=x, y=y, heading=heading + 1.0)
        after = talk.hear("frame")
        assert before["world"]["scan"] != after["world"]["scan"]
        talk.hear("world")

        (x1, y1, x2, y2) = world["doors"][0]["segment"]
        talk.say("door", x=(x1 + x2) / 2, y=(y1 + y2) / 2, closed=True)
        assert talk.hear("world")["doors"][0]["closed"]
        assert (
            "a door was closed"
            == talk.hear_until("marks", lambda one: len(one["marks"]) > 1)["marks"][-1]["text"]
        )


def test_what_cannot_be_done_is_said_and_the_drive_goes_on(client: TestClient) -> None:
    with talking(client) as talk:
        talk.start(paused=True)
        corner = talk.hear("world")["walls"][0]
        for kind, fields, words in (
            ("speed", {"speed": 500}, "from 1 to 20"),
            ("goal", {"goal": "attic"}, "attic"),
            ("door", {"x": 1e6, "y": 0}, "no door within"),
            ("person", {"x": "here"}, "x must be a number"),
            ("kidnap", {"x": corner[0], "y": corner[1]}, "cannot stand there"),
            ("scrub", {"t": "then"}, "t must be a number"),
        ):
            talk.say(kind, **fields)
            assert words in talk.hear("error")["text"]
        talk.say("step")
        assert 0.1 == talk.hear_until("frame", lambda frame: frame["t"] > 0.0)["t"]
        talk.say("stop")
        assert "stopped" == talk.hear("done")["outcome"]


@pytest.mark.parametrize(
    ("first", "words"),
    [
        ({"type": "pause"}, "start or resume"),
        ({"type": "resume", "session": "gone"}, "no longer there"),
        ({"type": "resume"}, "session must be a text"),
        ({"type": "start", "drawing": "../secret.svg", **REAL}, "stay in the folder"),
        ({"type": "start", "drawing": "none.svg", **REAL}, "there is no drawing"),
        ({"type": "start", "content": CONTENT, "world": "file:../../x.yaml"}, "there is no world"),
        ({"type": "start", "content": CONTENT, "world": "packed:moon"}, "there is no world"),
        ({"type": "start", "content": CONTENT, "made_real": {"severity": 7}}, "severity must be"),
        ({"type": "start", "content": CONTENT, "goal": [1, "x"], **REAL}, "goal must be"),
        ({"type": "start", "content": CONTENT, "seed": -1, **REAL}, "seed must be"),
        ({"type": "start", "content": {"media": "text/html", "text": ""}, **REAL}, "content must hold"),
    ],
)
def test_what_cannot_be_started_is_one_sentence(
    client: TestClient, first: dict[str, object], words: str
) -> None:
    with client.websocket_connect(LIVE) as websocket:
        websocket.send_text("not json")
        websocket.send_text(json.dumps({"v": 1, **first}))
        talk = Talk(websocket)

        assert "JSON object" in talk.hear("error")["text"]
        assert words in talk.hear("error")["text"]


@pytest.mark.parametrize(
    ("text", "goal", "words"),
    [
        (CLOSED, "cell", "gateways"),
        (FLAT, "attic", "attic"),
        ("<svg/>", "hall", "stroke"),
        (FLAT, [900, 900], "outside"),
    ],
)
def test_a_drive_that_cannot_be_prepared_says_why(
    client: TestClient, text: str, goal: object, words: str
) -> None:
    with talking(client) as talk:
        talk.say("start", content={"media": "image/svg+xml", "text": text}, goal=goal, **REAL)
        error = talk.hear("error")

    assert error["fatal"]
    assert words in error["text"]


def test_a_crashed_worker_is_one_message_and_what_was_recorded_stays(
    client: TestClient, table: Table
) -> None:
    with talking(client) as talk:
        talk.start()
        talk.hear("frame")
        (session,) = table.sessions.all()
        session.end()
        error = talk.hear("error")
        assert error["fatal"]
        assert "ended unexpectedly" in error["text"]
        talk.say("scrub", t=0)
        assert 0.0 == talk.hear_until("frame", lambda frame: not frame["live"])["t"]
    assert 504 == client.get(f"/api/sessions/{session.number}/journal").status_code
    assert 200 == client.get("/api/info").status_code


def test_a_drawing_of_the_folder_drives_in_a_world_of_the_folder(client: TestClient, folder: Path) -> None:
    for name in ("flat.svg", "true.svg"):
        (folder / name).write_text(FLAT)
    with talking(client) as talk:
        talk.say("start", drawing="flat.svg", world="file:true.svg", paused=True)
        session, frame = talk.hear("session"), talk.hear("frame")

    assert [30.0, 30.0] == session["drawing"]["goal"]
    assert frame["world"]["on_drawing"] is None


def test_a_log_is_localized_live_and_can_only_be_watched(client: TestClient) -> None:
    with talking(client) as talk:
        talk.say("start", drawing="example:office/quick", log="packed:office", speed=20)
        session = talk.hear("session")
        frame = talk.hear_until("frame", lambda frame: frame["t"] > 5.0)
        talk.say("box", x=0, y=0)
        assert "only be watched" in talk.hear("error")["text"]
        talk.say("goal", goal="Ana")
        assert "cannot be driven" in talk.hear("error")["text"]

    assert frame["world"] is None
    assert 750 == len(frame["believed"]["particles"])
    assert frame["text"].startswith(("lost", "in "))
    refused = client.get(f"/api/sessions/{session['session']}/journal")
    assert (504, "a log can only be watched") == (refused.status_code, refused.json()["error"])
