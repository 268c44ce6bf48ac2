"""A robot in ir-sim, the simulator of others, that is driven and read like one in ours.

Ir-sim spoils how commands are carried out and reports the true pose, so odometry is what the wheels were
told: it drifts as the robot strays from its commands.
"""

import contextlib
import io
import json
import math
import warnings

import matplotlib as mpl
import numpy as np

from pilotage.geometry import Pose2, Twist
from pilotage.perception import LaserScan, Odometry, Reading
from pilotage.simulation import Scene, SimulatorSettings
from pilotage.simulation.body import rolled

USUAL = SimulatorSettings()

STRAYING = (0.01, 0.0, 0.0, 0.01)
"""Variance of the velocities carried out, as a share of their squares: 10 % in each step of 0.1 s."""


def import_quietly():
    """Import ir-sim without a word, and without the window that it asks for."""
    backend = mpl.get_backend()
    with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("ignore")
        import irsim
    mpl.use(backend)
    return irsim


class IrSimRobot:
    """The face of `Simulator`, ir-sim behind it; walls are segments (n, 4) [m]."""

    def __init__(self, walls, start, folder, *, settings=USUAL, seed=0, straying=STRAYING):
        self.settings = settings
        self.stamp = 0.0
        self.collisions = 0
        path = folder / "world.yaml"
        path.write_text(json.dumps(described(walls, start, settings, straying)))  # JSON is YAML
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self._env = import_quietly().make(str(path), headless=True, log_level="ERROR", seed=seed)
        self._odom_from_base = Pose2.identity()
        self._twist = Twist(0.0, 0.0)

    @property
    def world_from_base(self):
        """Where the robot truly is."""
        return Pose2(*self._env.get_robot_state()[:3, 0].tolist())

    @property
    def scene(self):
        """All that a spectator sees; nothing moves here but the robot."""
        nobody, no_doors = np.empty((0, 2)), np.empty((0, 4))
        return Scene(self.world_from_base, self.read().scan, nobody, no_doors, self.collisions)

    def step(self, command):
        """Obey a command for one time step."""
        self._twist = self.settings.body.obeyed(self._twist, command, self.settings.time_step)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self._env.step([self._twist.linear, self._twist.angular])
        self.stamp += self.settings.time_step
        self.collisions = max(
            self.collisions, int(self._env.robot.collision_flag)
        )  # it never goes on after one
        self._odom_from_base = self._odom_from_base @ rolled(self._twist, self.settings.time_step)

    def read(self):
        """Read the laser and the wheels."""
        scan = self._env.get_lidar_scan()
        ranges = np.where(scan["valid"], scan["ranges"], math.inf)
        laser = LaserScan(
            self.stamp, scan["angle_min"], scan["angle_increment"], ranges, range_max=scan["range_max"]
        )
        return Reading(laser, Odometry(self.stamp, self._odom_from_base))

    def close(self):
        """Let ir-sim go."""
        with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
            warnings.simplefilter("ignore")
            self._env.end(0.0)


def described(walls, start, settings, straying):
    """Describe a world as ir-sim's files do."""
    low, high = walls.reshape(-1, 2).min(axis=0) - 1.0, walls.reshape(-1, 2).max(axis=0) + 1.0
    body, laser = settings.body, settings.laser
    lidar = {
        "type": "lidar2d",
        "range_max": laser.range_max,
        "angle_range": laser.field_of_view,
        "number": laser.beams,
        "noise": laser.noise > 0.0,
        "std": laser.noise,
    }
    robot = {
        "kinematics": {"name": "diff", "noise": any(straying), "alpha": list(straying)},
        "shape": {"name": "circle", "radius": body.radius},
        "state": [start.x, start.y, start.theta],
        "vel_min": [-2.0 * body.speed, -2.0 * body.turn_rate],
        "vel_max": [2.0 * body.speed, 2.0 * body.turn_rate],
        "sensors": [lidar],
    }
    obstacles = [
        {"shape": {"name": "linestring", "vertices": [[x1, y1], [x2, y2]]}, "state": [0, 0, 0]}
        for x1, y1, x2, y2 in walls.tolist()
    ]
    world = {
        "width": float(high[0] - low[0]),
        "height": float(high[1] - low[1]),
        "offset": low.tolist(),
        "step_time": settings.time_step,
        "collision_mode": "stop",
    }
    return {"world": world, "robot": [robot], "obstacle": obstacles}
