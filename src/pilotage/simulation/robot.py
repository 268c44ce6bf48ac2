"""A robot that follows a path, and the odometry that its slipping wheels report."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from pilotage.geometry import Array, Pose2, frozen_points, wrap_angle
from pilotage.simulation.odometry import OdometrySettings, Wheels


@dataclass(frozen=True, slots=True)
class DriveSettings:
    """How the robot moves along a path."""

    speed: float = 0.6  # [m/s]
    turn_rate: float = 1.0  # [rad/s]
    look_ahead: float = 0.5  # [m] how far along the path it steers for
    pivot: float = 0.8  # [rad] a turn wider than this is made on the spot
    time_step: float = 0.1  # [s]

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("speed", "turn_rate", "look_ahead", "pivot", "time_step"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")


@dataclass(frozen=True, slots=True)
class Moment:
    """Where the robot truly is at a time."""

    stamp: float  # [s]
    world_from_base: Pose2  # [m, rad]


def follow(waypoints: ArrayLike, settings: DriveSettings) -> Iterator[Moment]:
    """Drive along waypoints (n, 2) [m], steering for a point ahead on the path (pure pursuit)."""
    points = frozen_points(waypoints, name="waypoints", at_least=2)
    steps = np.diff(points, axis=0)
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])
    first = steps[0]
    pose = Pose2(points[0, 0], points[0, 1], math.atan2(first[1], first[0]))
    stamp, station = 0.0, 0.0
    yield Moment(stamp, pose)
    while station < stations[-1] - settings.speed * settings.time_step:
        station = nearest_station(points, stations, pose.position, station, settings.look_ahead)
        ahead = min(station + settings.look_ahead, stations[-1])
        target = np.array([np.interp(ahead, stations, points[:, axis]) for axis in (0, 1)])
        pose = steered(pose, target, settings)
        stamp += settings.time_step
        yield Moment(stamp, pose)


def nearest_station(points: Array, stations: Array, position: Array, station: float, reach: float) -> float:
    """Find how far along the path the robot has come: the nearest point of it not behind and within reach."""
    grid = np.linspace(station, min(station + reach, stations[-1]), 21)
    path = np.column_stack([np.interp(grid, stations, points[:, axis]) for axis in (0, 1)])
    return float(grid[np.argmin(np.hypot(*(path - position).T))])


def steered(pose: Pose2, target: Array, settings: DriveSettings) -> Pose2:
    """Move for one time step: turn towards the target, and forward unless the turn is wide."""
    bearing = math.atan2(target[1] - pose.y, target[0] - pose.x)
    turn = wrap_angle(bearing - pose.theta)
    limit = settings.turn_rate * settings.time_step
    turned = max(-limit, min(limit, turn))
    forward = 0.0 if abs(turn) > settings.pivot else settings.speed * settings.time_step
    return pose @ Pose2(0.0, 0.0, turned / 2.0) @ Pose2(forward, 0.0, turned / 2.0)


def reckon(world_from_base: list[Pose2], rng: np.random.Generator, settings: OdometrySettings) -> list[Pose2]:
    """Report each pose as slipping wheels would: `odom_from_base`, beginning at the origin."""
    wheels = Wheels(rng, settings)
    reported = [wheels.odom_from_base]
    for a, b in pairwise(world_from_base):
        wheels.roll(a.inverse() @ b)
        reported.append(wheels.odom_from_base)
    return reported
