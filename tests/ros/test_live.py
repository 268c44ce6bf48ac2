"""A robot on the network is localized and driven: on loopback, by DDS, in simulated time."""

import itertools
import time
from dataclasses import replace

import numpy as np
import pytest
from benchmarks.lib.dds_robot import TWIST_TYPE, DdsRobot, run_together

from pilotage import LocalizerSettings, Settings, open_map, open_world, worlds
from pilotage.drives.loop import put_down
from pilotage.io.bags import outgoing
from pilotage.maps import build_atlas
from pilotage.ranking.evidence import reduced
from pilotage.ros.node import Node, Quality
from pilotage.ros.robot import LiveRobot, Topics
from pilotage.ros.session import Session

pytestmark = pytest.mark.slow
DOMAINS = itertools.count(100)
SETTINGS = replace(Settings(), localizer=reduced(LocalizerSettings(), 1 / 4))


@pytest.fixture(scope="module")
def atlas():
    return build_atlas(open_map(worlds.OFFICE.careful), SETTINGS.localizer.atlas)


class Pair:
    """A robot and what drives it, each with a node of its own in a domain that no other test uses."""

    def __init__(self, atlas, topics, seed=0, loss=0.0):
        self.domain, self.atlas, self.topics, self.seed, self.said = next(DOMAINS), atlas, topics, seed, []
        rng = np.random.default_rng(seed)
        self.simulator = put_down(open_world(worlds.OFFICE.world), None, rng, SETTINGS.simulator)
        self.robot = DdsRobot(Node(self.domain), self.simulator, loss, seed)
        self.start_live()

    def start_live(self):
        session = Session(self.atlas, (SETTINGS.localizer, SETTINGS.navigator), seed=self.seed)
        clock = lambda: self.simulator.stamp  # noqa: E731
        self.live = LiveRobot(Node(self.domain), session, self.topics, self.said.append, clock)
        time.sleep(0.5)  # for the nodes to find each other

    def run(self, seconds, until=lambda: False):
        return run_together(self.robot, self.live, seconds, until)


def test_a_goal_is_reached_though_messages_are_lost_and_both_sides_restart(atlas):
    pair = Pair(atlas, Topics(drives=True), loss=0.01)
    pair.live.set_goal("kitchen")
    pair.run(8.0)
    pair.start_live()
    pair.live.set_goal("kitchen")
    pair.run(5.0)
    pair.robot = DdsRobot(Node(pair.domain), pair.simulator, 0.01)
    time.sleep(0.5)
    pair.run(300.0, lambda: pair.live.is_over)

    assert "reached" == pair.live.told.step.outcome.value
    assert 0 == pair.simulator.collisions


def test_without_leave_to_drive_nothing_is_sent_and_the_estimate_is(atlas):
    pair = Pair(atlas, Topics())
    listener = Node(pair.domain)
    commands = listener.subscribe("cmd_vel", TWIST_TYPE, Quality(10))
    poses = listener.subscribe("amcl_pose", "geometry_msgs/msg/PoseWithCovarianceStamped", Quality(100))
    pair.live.set_goal("kitchen")
    pair.run(1.0)

    assert [] == commands.take()
    assert poses.take()
    assert 0.0 == pair.simulator.twist.linear == pair.simulator.twist.angular


def test_without_a_goal_others_may_drive(atlas):
    pair = Pair(atlas, Topics(drives=True))
    commands = Node(pair.domain).subscribe("cmd_vel", TWIST_TYPE, Quality(10))
    time.sleep(0.5)
    pair.run(0.5)

    assert pair.live.told is not None
    assert [] == commands.take()


def test_one_who_joins_late_gets_the_map(atlas):
    pair = Pair(atlas, Topics(localizes_only=True))
    pair.run(0.5)
    late = Node(pair.domain).subscribe(
        "map", "nav_msgs/msg/OccupancyGrid", Quality(1, reliable=True, latched=True)
    )
    time.sleep(0.5)
    (grid,) = late.take()

    assert "map" == grid.header.frame_id
    assert {-1, 0, 100} == set(np.unique(grid.data).tolist())


def test_goals_and_starts_are_heard_by_topic(atlas):
    pair = Pair(atlas, Topics())
    node = Node(pair.domain)
    names = node.advertise("pilotage/goal", "std_msgs/msg/String")
    time.sleep(0.5)
    names.publish(outgoing.make("std_msgs/String", "kitchen"))
    names.publish(outgoing.make("std_msgs/String", "kitchen"))
    time.sleep(0.2)
    pair.run(0.3)
    assert "kitchen" == pair.live.session.goal

    names.publish(outgoing.make("std_msgs/String", "no such room"))
    time.sleep(0.2)
    pair.run(0.3)
    assert "kitchen" == pair.live.session.goal
    assert any("no such room is no goal" in line for line in pair.said)


def test_a_robot_that_goes_silent_is_told_to_stand(atlas):
    pair = Pair(atlas, Topics(drives=True))
    pair.live.set_goal("kitchen")
    pair.run(3.0)
    commands = Node(pair.domain).subscribe("cmd_vel", TWIST_TYPE, Quality(50))
    time.sleep(0.5)
    for _ in range(8):  # time goes on without a scan
        pair.simulator.step(pair.robot.command)
        pair.live.spin_once(0.01)
    time.sleep(0.1)
    heard = commands.take()

    assert any("standing: no scan" in line for line in pair.said)
    assert heard
    assert (0.0, 0.0) == (heard[-1].linear.x, heard[-1].angular.z)
