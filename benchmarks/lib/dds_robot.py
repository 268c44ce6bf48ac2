"""A simulated robot on the network: publishes scans, odometry and a mount, and obeys commands."""

import math
import os
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from pilotage import Pose2, Twist
from pilotage.io.bags import outgoing
from pilotage.io.bags.messages import ODOMETRY_TYPE, SCAN_TYPE
from pilotage.ros.node import Node
from pilotage.ros.robot import LiveRobot
from pilotage.simulation import Simulator

LOOPBACK = """<CycloneDDS><Domain Id="any"><General><Interfaces><NetworkInterface name="lo"/></Interfaces>
<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex><Peers>
<Peer address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>"""
TWIST_TYPE = "geometry_msgs/msg/Twist"
OBEYED_FOR = 0.5
"""Time [s] without a command after which a robot stands."""
PATIENCE = 0.02
"""Time [s] that the robot waits for a command after its scan was worked on."""

os.environ["CYCLONEDDS_URI"] = LOOPBACK  # tests stay on this machine


def odometry_message(stamp: float, pose: Pose2, twist: Twist) -> Any:  # noqa: ANN401  # made at run time
    """Make a nav_msgs/Odometry."""
    zero = np.zeros(36)
    return outgoing.make(
        "nav_msgs/Odometry",
        outgoing.header(stamp, "odom"),
        "base_link",
        outgoing.make("geometry_msgs/PoseWithCovariance", outgoing.pose_message(pose), zero),
        outgoing.make("geometry_msgs/TwistWithCovariance", outgoing.twist_message(twist), zero),
    )


class DdsRobot:
    """Steps a simulator, and tells and hears as a robot does; `loss` is the share of messages lost."""

    def __init__(self, node: Node, simulator: Simulator, loss: float = 0.0, seed: int = 0) -> None:
        self.node, self.simulator, self.loss = node, simulator, loss
        self.rng = np.random.default_rng(seed)
        self.scans, self.odometry = node.advertise("scan", SCAN_TYPE), node.advertise("odom", ODOMETRY_TYPE)
        self.mounts = node.advertise("/tf_static", "tf2_msgs/msg/TFMessage", latched=True)
        self.commands = node.subscribe("cmd_vel", TWIST_TYPE)
        self.command, self.commanded = Twist(0.0, 0.0), -math.inf  # in simulated time
        self.shift = 0.0
        self.deadline = math.inf  # of waiting for a command
        self.mounts.publish(outgoing.transform(0.0, "base_link", "laser", Pose2.identity()))

    def tell(self) -> None:
        """Publish what is sensed now."""
        reading, stamp = self.simulator.read(), self.simulator.stamp + 1000.0 + self.shift
        odom_from_base = reading.odometry.odom_from_base
        scan = outgoing.scan_message(reading.scan)
        scan.header.stamp = outgoing.time(stamp)
        if self.rng.random() >= self.loss:
            self.odometry.publish(odometry_message(stamp, odom_from_base, self.command))
        if self.rng.random() >= self.loss:
            self.scans.publish(scan)

    def hear(self) -> None:
        """Take the last command that came."""
        for message in self.commands.take():
            if self.rng.random() >= self.loss:
                self.command = Twist(message.linear.x, message.angular.z)
                self.commanded = self.simulator.stamp

    def await_command(self) -> float:
        """Wait for the next command, and return when it came [s]; -inf if none came before the deadline."""
        before = self.commanded
        while self.commanded == before and time.perf_counter() < self.deadline:
            self.node.wait(0.002)
            self.hear()
        return -math.inf if self.commanded == before else time.perf_counter()

    def step(self) -> None:
        """Obey for one time step."""
        if self.simulator.stamp - self.commanded > OBEYED_FOR:
            self.command = Twist(0.0, 0.0)
        self.simulator.step(self.command)


def run_together(
    robot: DdsRobot,
    live: LiveRobot,
    seconds: float,
    until: Callable[[], bool] = lambda: False,
    spent: Callable[[], float] = lambda: 0.0,
) -> list[float]:
    """Step the robot, and let the live side answer, as fast as both can; return the times of answers [s].

    The robot listens in a thread of its own: what the live side publishes after a command is no part of the
    answer. Counted is the time that was not `spent` otherwise, of scans that were answered by a command. The
    clock of the live side must be that of the simulation.
    """
    latencies = []
    end = robot.simulator.stamp + seconds
    with ThreadPoolExecutor(1) as ear:
        while robot.simulator.stamp < end and not until():
            robot.deadline = math.inf
            began, otherwise = time.perf_counter(), spent()
            heard = live.watchdog.heard
            robot.tell()
            came = ear.submit(robot.await_command)
            while live.watchdog.heard == heard and time.perf_counter() - began < 0.2:
                live.spin_once(0.02)
            robot.deadline = time.perf_counter() + PATIENCE
            took = came.result() - began
            if took > 0.0:
                latencies.append(took - (spent() - otherwise))
            robot.step()
    return latencies
