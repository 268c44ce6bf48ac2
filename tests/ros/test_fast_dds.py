"""A robot that speaks Fast DDS, in C++ and with no code of ours, is driven to a goal in real time."""

import os
import shutil
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from benchmarks.lib.dds_robot import LOOPBACK

from pilotage import Settings, open_map, open_world, worlds
from pilotage.cli.ros2 import open_session
from pilotage.ros.node import Node
from pilotage.ros.robot import LiveRobot, Topics
from pilotage.simulation import find_start

HEADERS = Path("/usr/include/fastdds/dds/domain/DomainParticipant.hpp")
needs_fast_dds = pytest.mark.skipif(
    not HEADERS.exists() or shutil.which("g++") is None,
    reason="Fast DDS (libfastrtps-dev) or a compiler is not here",
)
DOMAIN, LIMIT = 55, 240.0  # [s]


@pytest.fixture
def program(tmp_path):
    """The robot, compiled."""
    source, made = Path(__file__).with_name("fast_dds_robot.cpp"), tmp_path / "robot"
    flags = ["-std=c++17", "-O1", "-lfastrtps", "-lfastcdr"]
    subprocess.run([shutil.which("g++"), source, "-o", made, *flags], check=True, timeout=120)  # noqa: S603
    return made


@needs_fast_dds
@pytest.mark.slow
def test_a_robot_of_others_reaches_the_goal(program, tmp_path):
    assert os.environ["CYCLONEDDS_URI"] == LOOPBACK
    settings, world = Settings(), open_world(worlds.OFFICE.world)
    walls = tmp_path / "walls.txt"
    np.savetxt(walls, world.solid)
    session = open_session(open_map(worlds.OFFICE.careful), settings, 0, None, None)
    start = world.start or find_start(world, settings.navigator.radius, np.random.default_rng(0))
    words = [program, DOMAIN, walls, start.x, start.y, start.theta, LIMIT]
    with subprocess.Popen(list(map(str, words)), stdout=subprocess.PIPE, text=True) as robot:  # noqa: S603
        said = []
        live = LiveRobot(Node(DOMAIN), session, Topics(drives=True), said.append)
        live.set_goal("kitchen")
        end = time.monotonic() + LIMIT
        while not live.is_over and time.monotonic() < end:
            live.spin_once()
        robot.terminate()
        *_, touched = robot.communicate(timeout=10)[0].split()

    assert live.told is not None
    assert live.told.step is not None
    assert live.told.step.outcome is not None, said
    assert 0 == int(touched)
    assert "reached" == live.told.step.outcome.value
