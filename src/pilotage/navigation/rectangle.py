"""Steering for a robot that is no disc: a rectangle about its base must have room to drive, and to turn.

A path has room for a disc as wide as the robot. Along the arc of a command, and while it turns on the spot,
the whole rectangle is tried. Where it can neither drive on nor turn, the robot backs out.
"""

import math

import numpy as np

from pilotage.geometry import Array, Twist
from pilotage.navigation.braking import SLOW, SteeringSettings, brake, braking_path
from pilotage.navigation.local_grid import CLEARANCE

BACKWARD = 0.15
"""Speed [m/s] at which a robot backs out."""

STOPPING_TURN = 0.1
"""Turn [rad] that a robot may still make once it has begun to stop turning."""

STEP = 0.04
"""Angle [rad] between two poses that are tried while the robot turns."""

Size = tuple[float, float]
"""Length along the heading and width [m]."""


def is_free_to_obey(command: Twist, obstacles: Array, size: Size, settings: SteeringSettings) -> bool:
    """Tell whether a rectangle that obeys a command and then stops touches no obstacle (n, 2).

    Near to an obstacle already, it may move as long as it comes no nearer.
    """
    poses = poses_until_stopped(command, settings)
    extent = float(np.hypot(poses[:, 0], poses[:, 1]).max()) + math.hypot(*size) / 2.0 + CLEARANCE
    near = obstacles[np.hypot(obstacles[:, 0], obstacles[:, 1]) < extent]
    needed = np.minimum(CLEARANCE, rectangle_gaps(near, np.zeros((1, 3)), size)[0])
    return bool((rectangle_gaps(near, poses, size) >= needed - 1e-9).all())


def poses_until_stopped(command: Twist, settings: SteeringSettings) -> Array:
    """List the poses of a robot that obeys and then stops, (k, 3) as x, y [m] and heading [rad]."""
    forward = math.copysign(1.0, command.linear)
    if abs(command.linear) <= SLOW:
        turn = command.angular * settings.delay + math.copysign(STOPPING_TURN, command.angular)
        headings = np.linspace(0.0, turn, max(2, math.ceil(abs(turn) / STEP) + 1))
        return np.column_stack([np.zeros((len(headings), 2)), headings])
    way = braking_path(Twist(abs(command.linear), forward * command.angular), settings)
    until = settings.delay + abs(command.linear) / settings.braking
    headings = command.angular * np.linspace(0.0, until, len(way) + 1)[1:]
    return np.column_stack([forward * way, headings])


def rectangle_gaps(points: Array, poses: Array, size: Size) -> Array:
    """Measure from a rectangle at poses (k, 3) to points (n, 2), (k, n) [m]; negative inside.

    Beside a corner it is the larger of both distances along the sides, which is a little too small.
    """
    cosine, sine = np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
    dx, dy = points[:, 0] - poses[:, :1], points[:, 1] - poses[:, 1:2]
    along, aside = np.abs(cosine * dx + sine * dy), np.abs(cosine * dy - sine * dx)
    return np.asarray(np.maximum(along - size[0] / 2.0, aside - size[1] / 2.0))


def turned_or_backed_out(
    wanted: float, obstacles: Array, size: Size, settings: SteeringSettings, moving: Twist
) -> Twist:
    """Turn [rad/s] on the spot if there is room, else back out, else turn the other way, else stand."""
    if abs(moving.linear) > SLOW:
        return brake(moving, settings)
    candidates = (Twist(0.0, wanted), Twist(-BACKWARD, 0.0), Twist(0.0, -wanted))
    for command in candidates:
        if is_free_to_obey(command, obstacles, size, settings):
            return command
    return Twist(0.0, 0.0)
