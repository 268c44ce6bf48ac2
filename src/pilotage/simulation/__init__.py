"""True walls, noisy beams, drifting odometry."""

from pilotage.simulation.laser import LaserSettings, sense
from pilotage.simulation.robot import DriveSettings, Moment, OdometrySettings, follow, reckon
from pilotage.simulation.run import Run, RunSettings, simulate
from pilotage.simulation.scene import Scene
from pilotage.simulation.world import World

__all__ = [
    "DriveSettings",
    "LaserSettings",
    "Moment",
    "OdometrySettings",
    "Run",
    "RunSettings",
    "Scene",
    "World",
    "follow",
    "reckon",
    "sense",
    "simulate",
]
