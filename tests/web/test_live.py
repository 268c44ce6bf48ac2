"""Drives over the websocket."""

import json
from collections.abc import Iterator, MutableMapping
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from starlette.testclient import TestClient
from starlette.websockets import WebSocket, WebSocketDisconnect

from pilotage.config import settings_from
from pilotage.drives import drive, set_out
from pilotage.io import open_map
from pilotage.io.journal import journal_file
from pilotage.simulation import World
from pilotage.web.app import build_app
from pilotage.web.folder import Folder
from pilotage.web.guard import Access
from pilotage.web.live_routes import live, receive
from pilotage.web.table import Table
from web_table import APART, CONTENT, FLAT, HOST, LIVE, TOKEN, TWO_ROOMS, Talk, finished

SVG = "{http://www.w3.org/2000/svg}"
REAL = {"made_real": {"severity": 0.4, "seed": 3}}


def says(kind: str, **fields: object) -> dict[str, Any]:
    """Make a message of a page, as the server hears it."""
    return {"type": "websocket.receive", "text": json.dumps({"v": 1, "type": kind, **fields})}


def to_a_page(
    heard: Iterator[dict[str, Any]], *, takes: tuple[str, ...], table: Table | None = None
) -> WebSocket:
    """Open a websocket to a page that says these messages, and that takes no other kinds than these."""

    async def receive_next() -> dict[str, Any]:
        return next(heard)

    async def send(message: MutableMapping[str, Any]) -> None:
        if message["type"] not in takes:
            raise OSError

    app = SimpleNamespace(state=SimpleNamespace(table=table))
    return WebSocket({"type": "websocket", "app": app}, receive_next, send)


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
        talk.say("goal", goal="kitchen")
        assert "reached" == talk.hear("done")["outcome"]  # a way long enough to correct the drawing
        corrected = talk.hear_until("corrected", lambda one: one["seen_share"] > 0.5)

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
    assert {"open"} == {one["state"] for one in corrected["passages"]} - {"unseen"}
    check_record(client, session["session"])


def check_record(client: TestClient, number: str) -> None:
    """A drive that is over can be looked back at, kept, and gone on with."""
    journal = client.get(f"/api/sessions/{number}/journal").text.splitlines()
    assert "reached" == json.loads(journal[-1])["outcome"]
    assert client.get(f"/api/sessions/{number}/picture").content.startswith(b"\x89PNG")
    check_corrected(client.get(f"/api/sessions/{number}/corrected").text)
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
        talk.say("goal", goal="store")
        talk.hear_until("state", lambda state: state["over"] is False)
        assert now["t"] < talk.hear("frame")["t"]
    assert 204 == client.delete(f"/api/sessions/{number}").status_code
    assert 404 == client.get(f"/api/sessions/{number}/journal").status_code


def check_corrected(svg: str) -> None:
    """The flat, drawn 200 x 120, is corrected to metres: a building of people's size, of the same shape."""
    root = ET.fromstring(svg)  # noqa: S314  # our own
    _, _, width, height = (float(part) for part in (root.get("viewBox") or "").split())
    assert 5.0 < width < 60.0
    assert 1.2 < width / height < 2.3  # as it lies on the page
    assert {"kitchen", "office", "hall", "store"} <= {one.text for one in root.iter(f"{SVG}text")}


def test_a_drawing_is_not_corrected_by_a_robot_that_does_not_know(client: TestClient) -> None:
    with talking(client) as talk:
        session = talk.start(paused=True)
        talk.hear("frame")
        refused = client.get(f"/api/sessions/{session['session']}/corrected")

    assert 504 == refused.status_code
    assert "must be sure" in refused.json()["error"]


def test_a_robot_has_the_settings_of_the_command_line(table: Table, client: TestClient) -> None:
    table.settings = settings_from({"navigator": {"time_limit": 0.5}})
    with talking(client) as talk:
        talk.start()
        done = talk.hear("done")

    assert "gave up" == done["outcome"]
    assert "within 0 s" in done["reason"]


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
            ("speed", {"speed": 500}, "from 0.1 to 100"),
            ("goal", {"goal": "attic"}, "attic"),
            ("door", {"x": 1e6, "y": 0}, "no door within"),
            ("person", {"x": "here"}, "x must be a number"),
            ("kidnap", {"x": corner[0], "y": corner[1]}, "cannot stand there"),
            ("kidnap", {"x": corner[0] - 500.0, "y": corner[1]}, "outside of the building"),
            ("box", {"x": corner[0] - 500.0, "y": corner[1]}, "outside of the building"),
            ("person", {"x": corner[0] - 500.0, "y": corner[1]}, "outside of the building"),
            ("scrub", {"t": "then"}, "t must be a number"),
        ):
            talk.say(kind, **fields)
            assert words in talk.hear("error")["text"]
        talk.say("step")
        assert 0.1 == talk.hear_until("frame", lambda frame: frame["t"] > 0.0)["t"]
        talk.say("stop")
        assert "stopped" == talk.hear("done")["outcome"]


@pytest.mark.slow
def test_a_drive_is_begun_again_as_it_was_ordered_and_ends_when_it_is_left(client: TestClient) -> None:
    with talking(client) as talk, talking(client) as again:
        first, world = talk.start(speed=1), talk.hear("world")
        talk.say("leave")
        assert "stopped" == talk.hear("done")["outcome"]
        again.say("restart", session=first["session"], speed=5)
        second = again.hear("session")

        assert first["session"] != second["session"]
        assert ("store", 5) == (second["goal"], second["speed"])
        assert world == again.hear("world")
        with talking(client) as other:
            other.say("resume", session=second["session"])
            other.hear("session")
            again.say("leave")
            again.say("pause", paused=True)  # heard after it
            other.hear_until("state", lambda state: state["paused"])
    assert [True, False] == [one["over"] for one in client.get("/api/sessions").json()["sessions"]]


@pytest.mark.parametrize(
    ("first", "words"),
    [
        ({"type": "restart", "session": "gone"}, "no longer there"),
        ({"type": "pause"}, "start, resume or restart"),
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
        refused = talk.hear("error")
        assert words in refused["text"]
        assert refused["fatal"]  # else a page would try to resume for ever


@pytest.mark.parametrize(
    ("text", "goal", "words"),
    [
        (APART, "shed", "gateways"),
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


@pytest.mark.parametrize("sent", [{}, {"content": CONTENT}])
def test_a_drive_goes_to_a_room_that_the_table_beside_the_drawing_names(
    client: TestClient, folder: Path, sent: dict[str, object]
) -> None:
    (folder / "flat.svg").write_text(FLAT)
    (folder / "flat.svg.toml").write_text("[labels]\nattic = [150, 90]\n")
    with talking(client) as talk:
        talk.say("start", drawing="flat.svg", goal="attic", paused=True, **sent, **REAL)
        session = talk.hear("session")

    assert "attic" in session["goal"]


def test_a_log_is_localized_live_and_can_only_be_watched(client: TestClient) -> None:
    with talking(client) as talk:
        talk.say("start", drawing="example:office/quick", recording="packed:office", speed=20)
        session = talk.hear("session")
        frame = talk.hear_until("frame", lambda frame: frame["t"] > 5.0)
        talk.say("box", x=0, y=0)
        assert "only be watched" in talk.hear("error")["text"]
        talk.say("goal", goal="Ana")
        assert "only be watched" in talk.hear("error")["text"]

    assert "log" == session["kind"]
    assert frame["world"] is None
    assert 750 == len(frame["believed"]["particles"])
    assert frame["text"].startswith(("lost", "in "))
    refused = client.get(f"/api/sessions/{session['session']}/journal")
    assert (504, "a recording can only be watched") == (refused.status_code, refused.json()["error"])


@pytest.fixture(scope="module")
def text(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The journal of a drive of some seconds through the flat."""
    table = Table(Folder(tmp_path_factory.mktemp("drives")))
    app = build_app(table, Access(TOKEN, frozenset({HOST})), tmp_path_factory.mktemp("static"))
    with TestClient(app, base_url=f"http://{HOST}") as client:
        client.headers["Authorization"] = f"Bearer {TOKEN}"
        with talking(client) as talk:
            session = talk.start(speed=100)
            talk.hear_until("frame", lambda frame: frame["t"] > 5.0)
        return client.get(f"/api/sessions/{session['session']}/journal").text


def test_any_moment_of_a_journal_is_shown_as_it_was(client: TestClient, text: str) -> None:
    lines = [json.loads(line) for line in text.splitlines()]
    kept = client.post("/api/recordings?name=journal.jsonl", content=text).json()
    assert "journal" == kept["kind"]
    with talking(client) as talk:
        talk.say("start", content=CONTENT, recording=kept["id"], paused=True)
        session, state = talk.hear("session"), talk.hear("state")
        assert "journal" == session["kind"]
        assert [0.0, lines[-1]["stamp"]] == state["recorded"]
        assert [line["x"] for line in lines] == pytest.approx(
            [one["believed"][0] for one in session["way"]], abs=0.1
        )
        assert 0.0 == talk.hear("frame")["t"]
        for line in (lines[40], lines[3], lines[-1]):
            talk.say("scrub", t=line["stamp"])
            frame = talk.hear("frame")
            assert line["stamp"] == pytest.approx(frame["t"], abs=0.01)
            assert [line["x"], line["y"]] == pytest.approx(frame["believed"]["pose"][:2], abs=0.1)
            assert line["place"] == frame["believed"]["place"]
            true = [line["truth"]["x"], -line["truth"]["y"]]
            assert true == pytest.approx(frame["world"]["pose"][:2], abs=0.01)
        assert "over" == talk.hear("done")["outcome"]
        talk.say("scrub", t=1.0)
        talk.say("pause", paused=False)
        talk.hear_until("frame", lambda frame: frame["t"] > 1.5)
        talk.say("kidnap", x=0, y=0)
        assert "only be watched" in talk.hear("error")["text"]


def test_a_journal_of_a_plan_from_cad_is_shown_on_it(client: TestClient, tmp_path: Path) -> None:
    plan, journal = tmp_path / "plan.dxf", tmp_path / "journal.jsonl"
    plan.write_text(TWO_ROOMS)
    sketch = open_map(plan)
    navigator, simulator = set_out(sketch, World.of(sketch), (6.5, 4.0))
    with journal_file(journal, sketch) as write:
        for instant in islice(drive(navigator, simulator), 10):
            write(instant.step, instant.scene)
    last = json.loads(journal.read_text().splitlines()[-1])
    drawing = client.post("/api/uploads?name=plan.dxf", content=TWO_ROOMS).json()["svg"]
    kept = client.post("/api/recordings?name=journal.jsonl", content=journal.read_text()).json()
    with talking(client) as talk:
        content = {"media": "image/svg+xml", "text": drawing}
        talk.say("start", content=content, recording=kept["id"], speed=100)
        talk.hear("done")
        way = talk.hear("session")["way"]

    assert [last["x"], -last["y"]] == pytest.approx(way[-1]["believed"], abs=0.01)


def test_a_journal_of_a_named_world_shows_its_walls(client: TestClient, folder: Path, text: str) -> None:
    (folder / "run").mkdir()
    (folder / "run" / "journal.jsonl").write_text(text)
    (folder / "true.svg").write_text(FLAT)
    listed = client.get("/api/recordings").json()["recordings"]
    assert ["packed:office", "file:run/journal.jsonl"] == [one["id"] for one in listed]
    with talking(client) as talk:
        talk.say("start", content=CONTENT, recording="file:run/journal.jsonl", world="file:true.svg")
        assert talk.hear("world")["walls"]


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.jsonl", "not json", "no laser log"),
        ("a.jsonl", '{"stamp": 0}', "line 1 must be an estimate"),
        ("a.log", "nothing", "no laser log"),
    ],
)
def test_a_recording_that_cannot_be_read_says_why(
    client: TestClient, name: str, text: str, words: str
) -> None:
    kept = client.post(f"/api/recordings?name={name}", content=text).json()
    with talking(client) as talk:
        talk.say("start", content=CONTENT, recording=kept["id"])
        error = talk.hear("error")

    assert error["fatal"]
    assert words in error["text"]
    assert error["text"].endswith(f": {name}")


def test_a_journal_of_another_drawing_is_refused(client: TestClient, text: str) -> None:
    kept = client.post("/api/recordings?name=journal.jsonl", content=text).json()
    with talking(client) as talk:
        talk.say("start", drawing="example:office/quick", recording=kept["id"])
        error = talk.hear("error")

    assert "must be of this drawing" in error["text"]


def test_what_is_no_recording_is_not_kept(client: TestClient) -> None:
    refused = client.post("/api/recordings?name=run.exe", content=b"x")

    assert 400 == refused.status_code
    assert "a recording must end in" in refused.json()["error"]
    for number in range(6):
        kept = client.post(f"/api/recordings?name={number}.log", content=b"x").json()
    with talking(client) as talk:
        talk.say("start", content=CONTENT, recording="sent:gone")
        assert "there is no recording" in talk.hear("error")["text"]
    assert "5.log" == kept["title"]


def test_a_message_that_is_nested_too_deep_is_answered(client: TestClient) -> None:
    with client.websocket_connect(LIVE) as websocket:
        websocket.send_text("[" * 100_000)

        assert "JSON object" in websocket.receive_json()["text"]


def test_a_message_that_is_not_text_is_answered(client: TestClient) -> None:
    with client.websocket_connect(LIVE) as websocket:
        websocket.send_bytes(b"\xff\x00")

        assert "JSON object" in websocket.receive_json()["text"]


def test_a_page_that_is_gone_before_it_is_refused_raises_nothing(table: Table) -> None:
    heard = iter([{"type": "websocket.connect"}, says("resume", session="gone")])

    finished(live(to_a_page(heard, takes=("websocket.accept", "websocket.send"), table=table)))
    table.close()


def test_a_page_that_took_nothing_more_is_heard_to_the_end() -> None:
    async def talk() -> None:
        heard = iter(
            [{"type": "websocket.connect"}, says("seen"), {"type": "websocket.disconnect", "code": 1001}]
        )
        websocket = to_a_page(heard, takes=("websocket.accept",))
        await websocket.accept()
        with pytest.raises(WebSocketDisconnect):  # as the one who sends frames sees it
            await websocket.send_text("a frame")
        assert "seen" == (await receive(websocket))["type"]
        with pytest.raises(WebSocketDisconnect):
            await receive(websocket)

    finished(talk())
