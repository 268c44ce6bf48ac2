"""A robot on the network at the drawing table: on loopback, by DDS, a simulated one that keeps real time."""

import itertools
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest

pytest.importorskip("cyclonedds")

from starlette.testclient import TestClient

from loopback_robot import LoopbackRobot
from pilotage import Settings, open_map, worlds
from pilotage.evaluation.warp import read_warp
from pilotage.ros.link import Link, Topics
from pilotage.web.drawings import Page
from pilotage.web.order import RobotOrder
from pilotage.web.table import Table
from web_table import LIVE, Talk

DOMAINS = itertools.count(60)
OFFICE = {"drawing": "example:office/careful", "world": "robot"}


@pytest.fixture
def robot() -> Iterator[LoopbackRobot]:
    """A robot on the network, in a domain of its own."""
    robot = LoopbackRobot(next(DOMAINS))
    robot.start()
    yield robot
    robot.end()


@contextmanager
def talking(client: TestClient) -> Iterator[Talk]:
    """Open a websocket."""
    with client.websocket_connect(LIVE) as websocket:
        yield Talk(websocket)


def offer(table: Table, robot: LoopbackRobot, *, drives: bool) -> None:
    """Offer the robot as a world."""
    table.robot = RobotOrder(Link(robot.domain), Topics(drives=drives), Settings())


def wait_until(is_so: Callable[[], bool], seconds: float = 15.0) -> None:
    """Wait until something holds."""
    end = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < end
        time.sleep(0.05)


def keep_alive(talk: Talk, until: Callable[[], bool]) -> None:
    """Say that the page is there until something holds, 15 s at most."""

    def is_so() -> bool:
        talk.say("alive")
        return until()

    wait_until(is_so)


def let_drive(talk: Talk, robot: LoopbackRobot) -> None:
    """Press the button of the page, and wait until the wheels turn."""
    talk.say("drive")
    keep_alive(talk, lambda: robot.moves)


def hear_mark(talk: Talk, words: str) -> None:
    """Wait for a mark with these words; a later one may come in the same message."""
    talk.hear_until("marks", lambda one: any(words in mark["text"] for mark in one["marks"]))


def true_place(robot: LoopbackRobot) -> list[float]:
    """Return where on the page of the careful drawing the robot truly is."""
    sketch = open_map(worlds.OFFICE.careful)
    warp = read_warp(worlds.OFFICE.folder / "careful.json", sketch)
    pose = warp.sketch_from_base(robot.simulator.world_from_base).pose
    return Page(sketch).pose(pose.x, pose.y, pose.theta)


def test_without_a_robot_the_world_is_not_offered(client: TestClient) -> None:
    assert "robot" not in [one["id"] for one in client.get("/api/worlds").json()["worlds"]]
    with talking(client) as talk:
        talk.say("start", **OFFICE)
        assert "--ros2" in talk.hear("error")["text"]


@pytest.mark.slow
def test_a_dry_run_shows_all_and_sends_nothing(
    client: TestClient, table: Table, robot: LoopbackRobot
) -> None:
    offer(table, robot, drives=False)
    assert "robot" in [one["id"] for one in client.get("/api/worlds").json()["worlds"]]
    with talking(client) as talk:
        talk.say("start", **OFFICE, goal="kitchen")
        session, command = talk.hear("session"), talk.hear("command")
        frame = talk.hear("frame")
        talk.say("drive")
        assert "--drive" in talk.hear("error")["text"]
        talk.say("box", x=0, y=0)
        assert "this robot is real" in talk.hear("error")["text"]
        state = talk.hear_until("state", lambda one: not one["robot"]["trouble"])

    assert ("robot", "kitchen") == (session["kind"], session["goal"])
    assert session["drawing"]["goal"] is not None
    assert command["holds"]
    assert 750 == len(frame["believed"]["particles"])
    assert frame["believed"]["scan"]
    assert frame["world"] is None
    assert {"can_drive": False, "drives": False, "trouble": "", "goal": "kitchen"} == state["robot"]
    assert 0 == robot.heard


@pytest.mark.slow
def test_it_drives_when_a_person_says_so_and_stops_when_the_page_is_gone(
    client: TestClient, table: Table, robot: LoopbackRobot
) -> None:
    offer(table, robot, drives=True)
    with talking(client) as talk:
        talk.say("start", **OFFICE)
        number = talk.hear("session")["session"]
        talk.hear("frame")
        talk.say("drive")
        assert "there is no goal yet" == talk.hear("error")["text"]
        talk.say("goal", goal="kitchen")
        talk.hear_until("session", lambda one: one["goal"] == "kitchen")
        assert 0 == robot.heard
        let_drive(talk, robot)

        talk.say("stop")
        hear_mark(talk, "stopped by a person")
        wait_until(lambda: not robot.moves)

        let_drive(talk, robot)  # and then the page falls silent
        hear_mark(talk, "not heard")
        wait_until(lambda: not robot.moves)

        let_drive(talk, robot)
    wait_until(lambda: not robot.moves)  # the page was closed
    with talking(client) as talk:
        talk.say("resume", session=number)
        state = talk.hear_until("state", lambda one: not one["robot"]["trouble"])
        assert not state["robot"]["drives"]
        let_drive(talk, robot)
        client.delete(f"/api/sessions/{number}")
    wait_until(lambda: not robot.moves)


@pytest.mark.slow
def test_one_page_commands_another_watches_and_may_stop(
    client: TestClient, table: Table, robot: LoopbackRobot
) -> None:
    offer(table, robot, drives=True)
    with talking(client) as first:
        first.say("start", **OFFICE, goal="kitchen")
        session = first.hear("session")
        first.hear("frame")
        with talking(client) as second:
            second.say("start", **OFFICE, goal="hall")
            assert session["session"] == second.hear("session")["session"]
            assert not second.hear("command")["holds"]
            for kind in ("drive", "goal", "place", "alive"):
                second.say(kind)
                assert "another page commands" in second.hear("error")["text"]
            let_drive(first, robot)
            second.say("stop")
            wait_until(lambda: not robot.moves)
            hear_mark(first, "stopped by a person")
            with talking(client) as third:
                third.say("resume", session=session["session"])
                assert not third.hear("command")["holds"]
            assert 1 == len(client.get("/api/sessions").json()["sessions"])
    with talking(client) as again:
        again.say("resume", session=session["session"])
        assert again.hear("command")["holds"]


@pytest.mark.slow
def test_a_robot_that_falls_silent_is_told_of_and_a_start_is_taken(
    client: TestClient, table: Table, robot: LoopbackRobot
) -> None:
    offer(table, robot, drives=True)
    with talking(client) as talk:
        talk.say("start", **OFFICE, goal="kitchen")
        talk.hear("frame")
        x, y, heading = true_place(robot)
        talk.say("place", x=x, y=y, heading=heading)
        hear_mark(talk, "tells where")
        sure = talk.hear_until("frame", lambda one: one["believed"]["probability"] > 0.5)["believed"]
        assert [x, y, heading] == pytest.approx(sure["pose"], rel=0.1)
        let_drive(talk, robot)
        robot.speaks = False
        talk.hear_until("state", lambda one: "no scan for" in one["robot"]["trouble"])
        keep_alive(talk, lambda: not robot.moves)
