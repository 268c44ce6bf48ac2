"""From a way to a command: steer for a point ahead, no faster than one can stop."""

import math
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, Twist


@dataclass(frozen=True, slots=True)
class SteeringSettings:
    """How fast the robot may move, and how far it stays off things."""

    speed: float = 0.8  # [m/s]
    turn_rate: float = 1.2  # [rad/s]
    braking: float = 0.8  # [m/s2] that it can be sure of
    delay: float = 0.2  # [s] from a scan to wheels that obey
    clearance: float = 0.03  # [m] that the footprint stays off things
    look_ahead: float = 0.6  # [m] how far along the way it steers for
    pivot: float = math.radians(45.0)  # a turn wider than this is made on the spot
    gain: float = 2.5  # [1/s] turn rate for each radian of bearing

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("speed", "turn_rate", "braking", "look_ahead", "pivot", "gain"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")
        for name in ("delay", "clearance"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")


SHARES = (1.0, 0.75, 0.5, 0.3, 0.15)
"""Of the speed, and of the distance to steer for, so much is tried, in order."""

SLOW = 0.02
"""[m/s] from which on a robot counts as moving: wheels slip."""

STILL = Twist(0.0, 0.0)


def steer(
    way: Array,
    things: Array,
    radius: float,
    settings: SteeringSettings,
    moving: Twist = STILL,
    *,
    sight: float = math.inf,
) -> Twist:
    """Follow a way (k, 2) among things (n, 2), both in the robot's frame [m], safely for a disc of `radius`.

    `moving` is how the robot moves now, `sight` how far it sees [m]: what is farther away is not known to be
    free. Stands still, or turns on the spot, where moving on would not be safe; one that moves brakes on its
    arc before it turns on the spot, for that arc was found free.
    """
    ahead = point_ahead(way, things, radius + settings.clearance, settings.look_ahead)
    bearing = math.atan2(ahead[1], ahead[0])
    angular = max(-settings.turn_rate, min(settings.turn_rate, settings.gain * bearing))
    if abs(bearing) <= settings.pivot:
        to_end = float(np.hypot(*(way[-1] - way[0])))  # as the crow flies
        fastest = min(settings.speed * math.cos(bearing) ** 2, math.sqrt(2.0 * settings.braking * to_end))
        slowest = moving.linear - settings.braking * settings.delay / 2.0  # no robot slows down at once
        for share in SHARES:
            command = Twist(share * fastest, share * angular)
            braking = Twist(max(command.linear, slowest), command.angular)
            if is_safe(braking, things, radius, settings, sight=sight):
                return command
    return turn_on_the_spot(angular, moving)


def turn_on_the_spot(angular: float, moving: Twist) -> Twist:
    """Turn [rad/s] once the robot stands; until then brake on the arc that it is on: it was found free."""
    return Twist(0.0, moving.angular if moving.linear > SLOW else angular)


def point_ahead(way: Array, things: Array, room: float, distance: float) -> Array:
    """Find the farthest point of a way, up to a distance, with so much room on the line to it, (2,)."""
    near = things[np.hypot(things[:, 0], things[:, 1]) < distance + room]
    away = np.hypot(way[:, 0], way[:, 1])
    for share in SHARES:
        far = np.flatnonzero(away >= share * distance)
        point = way[far[0]] if len(far) else way[-1]
        along = np.clip(near @ point / max(float(point @ point), 1e-9), 0.0, 1.0)
        gaps = np.hypot(*(near - along[:, np.newaxis] * point).T)
        now = np.hypot(near[:, 0], near[:, 1])
        if (gaps >= np.minimum(room, now - 1e-3)).all():
            break
    return np.asarray(point)


def is_safe(
    command: Twist, things: Array, radius: float, settings: SteeringSettings, *, sight: float = math.inf
) -> bool:
    """Tell whether a disc that obeys a command can still stop before it touches any of the things (n, 2).

    It must come to a stop within its `sight` [m], whatever waits behind.

    One that is too near to something already may move on as long as it comes no nearer.
    """
    path = braking_path(command, settings)
    reach = float(np.hypot(*path[-1])) + radius + settings.clearance
    if command.linear > SLOW and reach > sight:
        return False
    near = things[np.hypot(things[:, 0], things[:, 1]) < 2.0 * reach]
    gaps = np.hypot(near[:, :1] - path[:, 0], near[:, 1:] - path[:, 1])
    needed = np.minimum(radius + settings.clearance, np.hypot(near[:, 0], near[:, 1]))
    return bool((gaps >= needed[:, np.newaxis] - 1e-9).all())


def braking_path(command: Twist, settings: SteeringSettings) -> Array:
    """List where a robot comes that obeys for the delay and then brakes, still turning, (k, 2) [m]."""
    speed, braking = command.linear, settings.braking
    until = settings.delay + speed / braking
    times = np.linspace(0.0, until, max(3, math.ceil(until / 0.05)) + 1)
    speeds = np.clip(speed - braking * np.maximum(times - settings.delay, 0.0), 0.0, speed)
    ways = (speeds[1:] + speeds[:-1]) / 2.0 * np.diff(times)
    headings = command.angular * (times[1:] + times[:-1]) / 2.0
    return np.column_stack([np.cumsum(ways * np.cos(headings)), np.cumsum(ways * np.sin(headings))])
