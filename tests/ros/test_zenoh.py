"""Topics over Zenoh, between two sessions on loopback: keys, tokens and bytes as rmw_zenoh has them."""

import json
import socket
import time
from dataclasses import replace

import numpy as np
import pytest
from benchmarks.lib.dds_robot import DdsRobot, run_together
from rosbags.typesys import Stores, get_typestore

from pilotage import LocalizerSettings, Pose2, Settings, Twist, open_map, open_world, worlds
from pilotage.drives.loop import put_down
from pilotage.io.bags import outgoing
from pilotage.maps import build_atlas
from pilotage.ranking.evidence import reduced
from pilotage.ros import zenoh_node
from pilotage.ros.node import NoTransportError, Quality
from pilotage.ros.robot import LiveRobot, Topics
from pilotage.ros.session import Session
from pilotage.ros.zenoh_node import ZenohNode, peer_config

zenoh = pytest.importorskip("zenoh")
TWIST, STRING = "geometry_msgs/msg/Twist", "std_msgs/msg/String"
STRING_HASH = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"  # of ROS 2 Jazzy
FOUND = 10.0  # [s] in which two sessions must have found each other


def free_address():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{probe.getsockname()[1]}"


@pytest.fixture
def address():
    return free_address()


@pytest.fixture
def robot(address):
    node = ZenohNode(7, "robot1", peer_config(listen=address))
    yield node
    node.close()


@pytest.fixture
def ours(robot, address):  # noqa: ARG001  # the robot must listen first
    node = ZenohNode(7, "robot1", peer_config(listen="tcp/127.0.0.1:0", connect=address))
    yield node
    node.close()


@pytest.fixture
def plain(robot, address):  # noqa: ARG001  # the same
    session = zenoh.open(peer_config(listen="tcp/127.0.0.1:0", connect=address))
    yield session
    session.close()


def received(node, subscription, act=lambda: None):
    """Act until something comes."""
    deadline = time.monotonic() + FOUND
    while time.monotonic() < deadline:
        act()
        node.wait(0.1)
        if messages := subscription.take():
            return messages
    raise AssertionError("nothing came")


def test_a_message_goes_from_one_session_to_the_other(robot, ours):
    commands = robot.subscribe("cmd_vel", TWIST, Quality(5))
    publisher = ours.advertise("cmd_vel", TWIST)
    (command, *_) = received(
        robot, commands, lambda: publisher.publish(outgoing.twist_message(Twist(0.25, -0.5)))
    )

    assert (0.25, -0.5) == (command.linear.x, command.angular.z)


def test_who_joins_late_hears_what_is_latched(robot, ours):
    mounts = ours.advertise("/tf_static", "tf2_msgs/msg/TFMessage", latched=True)
    mounts.publish(outgoing.transform(0.0, "base_link", "laser", Pose2(0.1, 0.2, 0.3)))
    late = robot.subscribe("/tf_static", "tf2_msgs/msg/TFMessage", Quality(100, reliable=True, latched=True))
    (message,) = received(robot, late)

    assert "laser" == message.transforms[0].child_frame_id


def test_only_the_newest_messages_wait_and_broken_ones_are_passed_over(robot, plain):
    subscription = robot.subscribe("chatter", STRING, Quality(2))
    key = f"7/robot1/chatter/std_msgs::msg::dds_::String_/{STRING_HASH}"
    encoded = [
        get_typestore(Stores.ROS2_JAZZY).serialize_cdr(outgoing.make("std_msgs/String", text), STRING)
        for text in "abc"
    ]
    received(robot, subscription, lambda: plain.put(key, bytes(encoded[0])))
    for payload in (*encoded, b"\x00\x01"):
        plain.put(key, bytes(payload))
    time.sleep(0.5)

    assert ["c"] == [message.data for message in subscription.take()]


def test_keys_bytes_and_attachments_are_those_of_rmw_zenoh(ours, plain):
    samples = []
    plain.declare_subscriber("7/**", samples.append)
    publisher = ours.advertise("chatter", STRING)
    message = outgoing.make("std_msgs/String", "hello")
    deadline = time.monotonic() + FOUND
    while len(samples) < 2 and time.monotonic() < deadline:
        publisher.publish(message)
        time.sleep(0.05)
    first, second = samples[:2]

    assert f"7/robot1/chatter/std_msgs::msg::dds_::String_/{STRING_HASH}" == str(first.key_expr)
    assert b"\x00\x01\x00\x00\x06\x00\x00\x00hello\x00" == first.payload.to_bytes().rstrip(b"\x00") + b"\x00"
    notes = [sample.attachment.to_bytes() for sample in (first, second)]
    numbers = [int.from_bytes(note[:8], "little") for note in notes]
    stamps = [int.from_bytes(note[8:16], "little") for note in notes]
    assert [33, 33] == [len(note) for note in notes]
    assert numbers[0] + 1 == numbers[1]
    assert stamps[0] < stamps[1]
    np.testing.assert_allclose(stamps, time.time_ns(), atol=60e9)
    assert 16 == notes[0][16]
    assert notes[0][17:] == notes[1][17:]


def test_nodes_and_topics_are_told_by_liveliness_tokens(ours, plain):
    kept = [
        ours.subscribe("scan", "sensor_msgs/msg/LaserScan", Quality(1)),
        ours.advertise("map", STRING, latched=True),
    ]
    time.sleep(0.5)
    tokens = sorted(str(reply.ok.key_expr) for reply in plain.liveliness().get("@ros2_lv/7/**"))
    words = [token.split("/") for token in tokens if str(ours._session.zid()) in token]  # noqa: SLF001

    assert 2 == len(kept)
    assert [["NN", "%", "%robot1", "pilotage"]] == [one[5:] for one in words if one[5] == "NN"]
    ((*named, scan_hash, quality),) = [one[5:] for one in words if one[5] == "MS"]
    assert ["MS", "%", "%robot1", "pilotage", "%robot1%scan", "sensor_msgs::msg::dds_::LaserScan_"] == named
    assert scan_hash.startswith("RIHS01_")
    assert "2::,1:,:,:,," == quality
    ((*_, topic, _, string_hash, quality),) = [one[5:] for one in words if one[5] == "MP"]
    assert ("%robot1%map", STRING_HASH, ":1:,1:,:,:,,") == (topic, string_hash, quality)


def test_a_router_that_does_not_answer_is_told(monkeypatch, address):
    monkeypatch.setattr(zenoh_node, "ROUTER", address)
    monkeypatch.setattr(zenoh_node, "PATIENCE_MS", 300)
    with pytest.raises(NoTransportError, match="no router of Zenoh answers") as caught:
        ZenohNode()

    assert "\n" not in str(caught.value)


def test_a_file_of_the_environment_configures_the_session(monkeypatch, tmp_path, robot, address):
    path = tmp_path / "session.json5"
    path.write_text(json.dumps({"mode": "client", "connect": {"endpoints": [address]}}))
    monkeypatch.setenv("ZENOH_SESSION_CONFIG_URI", str(path))
    node = ZenohNode(7, "robot1")
    heard = robot.subscribe("chatter", STRING, Quality(1))
    publisher = node.advertise("chatter", STRING)

    assert received(robot, heard, lambda: publisher.publish(outgoing.make("std_msgs/String", "a")))
    node.close()


@pytest.mark.parametrize("content", [None, "{ broken"])
def test_a_file_of_the_environment_that_cannot_be_used_is_named(monkeypatch, tmp_path, content):
    path = tmp_path / "zenoh.json5"
    if content is not None:
        path.write_text(content)
    monkeypatch.setenv("ZENOH_SESSION_CONFIG_URI", str(path))

    with pytest.raises(NoTransportError, match="must name a configuration of Zenoh") as refused:
        ZenohNode()
    assert str(refused.value).endswith(f": {path}")
    assert "/src/" not in str(refused.value)


@pytest.mark.slow
def test_a_robot_is_driven_to_its_goal(robot, ours):
    settings = replace(Settings(), localizer=reduced(LocalizerSettings(), 1 / 4))
    atlas = build_atlas(open_map(worlds.OFFICE.careful), settings.localizer.atlas)
    world = open_world(worlds.OFFICE.world)
    simulator = put_down(world, None, np.random.default_rng(0), settings.simulator)
    body = DdsRobot(robot, simulator)
    session = Session(atlas, (settings.localizer, settings.navigator), seed=0)
    live = LiveRobot(ours, session, Topics(drives=True), lambda _text: None, lambda: simulator.stamp)
    live.set_goal("kitchen")
    time.sleep(0.5)
    run_together(body, live, 300.0, lambda: live.is_over)

    assert "reached" == live.told.step.outcome.value
    assert 0 == simulator.collisions
