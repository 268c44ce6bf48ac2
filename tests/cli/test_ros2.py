"""`pilotage ros2` refuses what must not be guessed before it touches the network."""

import pytest

from pilotage import worlds
from pilotage.ros.link import Link, Transport

DRIVE = ("--drive", "--radius", "0.2", "--speed", "0.4", "--turn-rate", "1")


@pytest.mark.parametrize(
    ("words", "rule"),
    [
        (DRIVE, "must be given to drive"),
        ((*DRIVE, "--braking", "-1"), "it must be positive, got -1.0"),
        (("--localize-only", "--drive"), "must be given to drive"),
        (("--localize-only", "--goal", "kitchen"), "excludes --drive and --goal"),
        (("--footprint", "0.8x0.5", "--radius", "0.2"), "it excludes --radius"),
        (("--resume", "x.state", "--start", "1,2,3"), "it excludes --start"),
        (("--domain", "900"), "less than or equal to 232"),
    ],
)
def test_a_drive_by_guessed_limits_is_refused(pilotage, words, rule):
    outcome = pilotage("ros2", worlds.OFFICE.careful, *words)

    assert 2 == outcome.code
    assert rule in " ".join(outcome.err.replace("│", " ").split())


def test_a_damaged_state_is_refused_and_stays_as_it_is(pilotage, tmp_path):
    path = tmp_path / "office.state"
    path.write_text("precious")
    outcome = pilotage("ros2", worlds.OFFICE.careful, "--resume", path)

    assert 1 == outcome.code
    assert f"this is no saved state, or it is damaged: {path}" in outcome.err or str(path) in outcome.err
    assert "precious" == path.read_text()


@pytest.mark.parametrize(("transport", "home"), [("dds", "node.Node"), ("zenoh", "zenoh_node.ZenohNode")])
def test_the_transport_is_the_one_that_was_asked_for(transport, home, monkeypatch):
    monkeypatch.setattr(f"pilotage.ros.{home}", lambda *words: (transport, *words))

    assert (transport, 7, "robot1") == Link(7, "robot1", Transport(transport)).join()


@pytest.mark.parametrize(
    ("words", "rule"),
    [
        (
            ("--drive", "--radius", "0.2", "--speed", "1", "--turn-rate", "1", "--braking", "1"),
            "it needs --ros2",
        ),
        (("--ros2", *DRIVE), "must be given to drive"),
        (("--ros2", "--speed", "nan"), "it must be positive, got nan"),
        (("--ros2", "--domain", "900"), "less than or equal to 232"),
        (("--ros2", "--namespace", "robot one"), "a name of ROS has letters, digits, _ and /"),
    ],
)
def test_a_table_by_guessed_limits_is_refused(pilotage, tmp_path, words, rule):
    outcome = pilotage("table", tmp_path, "--no-browser", *words)

    assert 2 == outcome.code
    assert rule in " ".join(outcome.err.replace("│", " ").split())


ROBOT = 'radius = 0.2\nspeed = 0.4\nturn-rate = 1\nbraking = -0.5\ndomain = 7\nscan-topic = "front/scan"\n'


@pytest.mark.parametrize(
    ("content", "words", "refusal"),
    [
        (ROBOT, ("--drive",), (2, "it must be positive, got -0.5")),
        (ROBOT, ("--drive", "--braking", "0.5", "--speed", "-1"), (2, "it must be positive, got -1.0")),
        ("wheels = 4", (), (1, "a robot has no 'wheels', only radius,")),
        ("radius = [1]", (), (1, "radius must be a number, got [1]")),
        ("radius = ", (), (1, "a file of a robot must be TOML")),
        ('radius = "big"', (), (1, "radius must be a number, got 'big'")),
        ("radius = true", (), (1, "radius must be a number, got True")),
        ("domain = 7.5", (), (1, "domain must be a whole number, got 7.5")),
        ('namespace = "robot one"', (), (2, "no part begins with a digit, got 'robot one'")),
        ('scan-topic = ""', (), (2, "no part begins with a digit, got ''")),
        ("", ("--start", "9e6,0,0"), (1, "the start lies outside the drawing")),
        ('stamped = "yes"', (), (1, "stamped must be true or false, got 'yes'")),
    ],
)
def test_a_file_of_a_robot_gives_options_their_values(pilotage, tmp_path, content, words, refusal):
    path = tmp_path / "robot.toml"
    path.write_text(content)
    outcome = pilotage("ros2", worlds.OFFICE.careful, "--robot", path, *words)

    assert refusal[0] == outcome.code
    assert refusal[1] in " ".join(outcome.err.replace("│", " ").split())


@pytest.mark.parametrize("words", [("--robot", "robot.toml"), ("--radius", "0.3"), ("--stamped",)])
def test_a_table_without_a_robot_refuses_what_would_change_nothing(pilotage, tmp_path, words):
    (tmp_path / "robot.toml").write_text("speed = 0.4\n")
    words = [tmp_path / word if word.endswith(".toml") else word for word in words]
    outcome = pilotage("table", tmp_path / "none", "--no-browser", *words)

    assert 2 == outcome.code
    assert "it needs --ros2" in outcome.err
