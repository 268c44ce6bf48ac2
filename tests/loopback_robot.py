"""A simulated robot on the network of this machine that keeps real time, as a real one would."""

import threading

import numpy as np
from benchmarks.lib.dds_robot import DdsRobot

from pilotage import Twist, open_world, worlds
from pilotage.drives.loop import put_down
from pilotage.ros.node import Node
from pilotage.simulation.simulator import SimulatorSettings


class LoopbackRobot(threading.Thread):
    """Steps a simulator in real time; it obeys the last command until another comes, as careless bases do."""

    def __init__(self, domain: int) -> None:
        super().__init__(daemon=True)
        self.domain = domain
        rng = np.random.default_rng(0)
        self.simulator = put_down(open_world(worlds.OFFICE.world), None, rng, SimulatorSettings())
        self.robot = DdsRobot(Node(domain), self.simulator)
        self.heard = 0  # commands
        self.speaks = True
        self._ends = threading.Event()

    def run(self) -> None:
        """Tell, hear, move."""
        while not self._ends.wait(0.1):
            if self.speaks:
                self.robot.tell()
            for message in self.robot.commands.take():
                self.heard += 1
                self.robot.command = Twist(message.linear.x, message.angular.z)
            self.simulator.step(self.robot.command)

    def end(self) -> None:
        """Switch it off."""
        self._ends.set()
        self.join()

    @property
    def moves(self) -> bool:
        """Whether its wheels turn."""
        return self.robot.command.linear != 0.0 or self.robot.command.angular != 0.0
