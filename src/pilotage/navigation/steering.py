"""From a path to a command: pure pursuit of a look-ahead point, no faster than the robot can stop.

A command is tried on the arc that it leads to (dynamic window approach, Fox, Burgard and Thrun 1997).
"""

import math

import numpy as np

from pilotage.geometry import Array, Twist
from pilotage.navigation.braking import SLOW, SteeringSettings, brake, braking_path
from pilotage.navigation.local_grid import CLEARANCE
from pilotage.navigation.rectangle import is_free_to_obey, turned_or_backed_out

SHARES = (1.0, 0.75, 0.5, 0.3, 0.15)
"""Shares of the fastest speed, and of the look-ahead distance, that are tried in order."""

LOOK_AHEAD = 0.6
"""Distance [m] along the path of the point that the robot steers for."""

PIVOT = math.radians(45.0)
"""A turn wider than this [rad] is made on the spot."""

GAIN = 2.5
"""Turn rate for each radian of bearing [1/s]."""

ASIDE = np.radians([side * turn for turn in range(0, 181, 10) for side in (1, -1)])
"""Turns that are tried to get away from the nearest obstacle, the least first, to its far side first."""

AWAY = 0.1
"""Distance [m] that the robot must be able to go in that direction."""

STILL = Twist(0.0, 0.0)


def steer(
    path: Array,
    obstacles: Array,
    radius: float,
    settings: SteeringSettings,
    moving: Twist = STILL,
    *,
    sight: float = math.inf,
    rectangle: tuple[float, float] | None = None,
) -> Twist:
    """Follow a path (k, 2) among obstacles (n, 2) with a body of `radius`, all in the robot's frame [m].

    `moving` is how the robot moves now, `sight` how far it sees [m]: farther away may be obstacles.
    With a `rectangle`, length and width [m], the whole of it must have room; `radius` is half its width.
    Where no forward command is safe, the robot stands or turns on the spot. One that still moves brakes
    before it turns, on its arc, which was found free.
    """
    ahead = lookahead_point(path, obstacles, radius + CLEARANCE, LOOK_AHEAD)
    bearing = math.atan2(ahead[1], ahead[0])
    angular = max(-settings.turn_rate, min(settings.turn_rate, GAIN * bearing))
    if abs(bearing) <= PIVOT:
        to_end = float(np.hypot(*(path[-1] - path[0])))
        fastest = min(settings.speed * math.cos(bearing) ** 2, math.sqrt(2.0 * settings.braking * to_end))
        slowest = moving.linear - settings.braking * settings.delay / 2.0  # no robot slows down instantly
        for share in SHARES:
            command = Twist(share * fastest, share * angular)
            braking = Twist(max(command.linear, slowest), command.angular)
            if not can_stop(braking, obstacles, radius, settings, sight=sight):
                continue
            if rectangle is None or is_free_to_obey(braking, obstacles, rectangle, settings):
                return command
    return turn(angular, obstacles, settings, moving, rectangle)


def turn(
    angular: float,
    obstacles: Array,
    settings: SteeringSettings,
    moving: Twist,
    rectangle: tuple[float, float] | None,
) -> Twist:
    """Turn [rad/s] on the spot among obstacles (n, 2); a rectangle without the room for it backs out."""
    if rectangle is None:
        return turn_on_the_spot(angular, settings, moving)
    return turned_or_backed_out(angular, obstacles, rectangle, settings, moving)


def turn_on_the_spot(angular: float, settings: SteeringSettings, moving: Twist) -> Twist:
    """Turn [rad/s] once the robot stands; until then brake."""
    return brake(moving, settings) if moving.linear > SLOW else Twist(0.0, angular)


def lookahead_point(path: Array, obstacles: Array, room: float, distance: float) -> Array:
    """Find the farthest point of a path, up to a distance, with this room [m] on the line to it, (2,).

    If no line along the path has the room, as beside an obstacle that came too near, the point lies where the
    robot gets away from there.
    """
    near = obstacles[np.hypot(obstacles[:, 0], obstacles[:, 1]) < distance + room]
    needed = np.minimum(room, np.hypot(near[:, 0], near[:, 1]) - 1e-3)
    away = np.hypot(path[:, 0], path[:, 1])
    for share in SHARES:
        far = np.flatnonzero(away >= share * distance)
        point = path[far[0]] if len(far) else path[-1]
        if (gaps_beside(point, near) >= needed).all():
            return np.asarray(point)
    return free_point(point, near, room)


def gaps_beside(point: Array, obstacles: Array) -> Array:
    """Measure from the line that leads from the robot to a point (2,) to obstacles (n, 2), (n,) [m]."""
    along = np.clip(obstacles @ point / max(float(point @ point), 1e-9), 0.0, 1.0)
    return np.asarray(np.hypot(*(obstacles - along[:, np.newaxis] * point).T))


def free_point(point: Array, obstacles: Array, room: float) -> Array:
    """Turn a point (2,) aside until the way there leads no nearer to obstacles (n, 2) that are too near.

    All are in the robot's frame [m]; less than the `room` is too near. The least turn is taken. If there is
    none, the point stays where it is.
    """
    away = np.hypot(obstacles[:, 0], obstacles[:, 1])
    nearest, needed = obstacles[away.argmin()], np.minimum(room, away)
    wanted = math.atan2(point[1], point[0])
    side = -1.0 if point[0] * nearest[1] > point[1] * nearest[0] else 1.0
    for aside in side * ASIDE:
        step = AWAY * np.array([math.cos(wanted + aside), math.sin(wanted + aside)])
        if (gaps_beside(step, obstacles) >= needed).all():
            return np.asarray(step)
    return np.asarray(point)


def can_stop(
    command: Twist, obstacles: Array, radius: float, settings: SteeringSettings, *, sight: float = math.inf
) -> bool:
    """Tell whether a robot that obeys a command can still stop before it touches any obstacle (n, 2).

    It must come to a stop within its `sight` [m]. A robot that is too near to an obstacle already may move as
    long as it comes no nearer.
    """
    arc = braking_path(command, settings)
    extent = float(np.hypot(*arc[-1])) + radius + CLEARANCE
    if command.linear > SLOW and extent > sight:
        return False
    near = obstacles[np.hypot(obstacles[:, 0], obstacles[:, 1]) < 2.0 * extent]
    gaps = np.hypot(near[:, :1] - arc[:, 0], near[:, 1:] - arc[:, 1])
    needed = np.minimum(radius + CLEARANCE, np.hypot(near[:, 0], near[:, 1]))
    return bool((gaps >= needed[:, np.newaxis] - 1e-9).all())
