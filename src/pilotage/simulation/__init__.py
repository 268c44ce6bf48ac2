"""True walls, noisy beams, drifting odometry."""

from pilotage.simulation.body import BodySettings
from pilotage.simulation.laser import LaserSettings, sense
from pilotage.simulation.odometry import OdometrySettings, Wheels
from pilotage.simulation.people import WALKING_SPEED, Person
from pilotage.simulation.robot import DriveSettings, Moment, follow, reckon
from pilotage.simulation.run import Run, RunSettings, simulate
from pilotage.simulation.scene import Door, Movers, Scene
from pilotage.simulation.simulator import Simulator, SimulatorSettings, StartError
from pilotage.simulation.starting import find_start
from pilotage.simulation.ways import Way
from pilotage.simulation.world import World

__all__ = [
    "WALKING_SPEED",
    "BodySettings",
    "Door",
    "DriveSettings",
    "LaserSettings",
    "Moment",
    "Movers",
    "OdometrySettings",
    "Person",
    "Run",
    "RunSettings",
    "Scene",
    "Simulator",
    "SimulatorSettings",
    "StartError",
    "Way",
    "Wheels",
    "World",
    "find_start",
    "follow",
    "reckon",
    "sense",
    "simulate",
]
