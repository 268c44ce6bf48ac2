"""People who walk to and fro, and do not walk into robots."""

import math
from dataclasses import dataclass

import numpy as np

from pilotage import kernels
from pilotage.geometry import Array, Polyline

COURTESY = 0.6
"""A person stops this far from a robot that is in the way [m]."""

WALKING_SPEED = 1.0
"""Speed [m/s] of a person who is not in a hurry."""

PATIENCE = (2.0, 5.0)
"""Shortest and longest time [s] that a person waits for a free way before turning round."""

PAUSE = (1.0, 4.0)
"""Shortest and longest time [s] that a person stays at an end of the path."""


@dataclass(frozen=True, slots=True)
class Person:
    """Walks along a path and back; a closed path is walked round and round."""

    path: Polyline  # [m]
    speed: float = WALKING_SPEED  # [m/s]
    radius: float = 0.25  # [m]

    def __post_init__(self) -> None:
        """Reject a person that cannot walk."""
        for name in ("speed", "radius"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"a person's {name} must be > 0 and finite, got {getattr(self, name)}")
        if not self.path.length > 0.0:
            raise ValueError("a person's path must have a length, got one of 0 m")

    def position(self, station: float) -> Array:
        """Return where a station [m] along the path is, (2,)."""
        stations = np.concatenate([[0.0], np.cumsum(self.path.segment_lengths)])
        return np.array([np.interp(station, stations, self.path.ring[:, axis]) for axis in (0, 1)])


class Walker:
    """A person under way, who starts at a random station of the path and well away from the robot."""

    def __init__(self, person: Person, rng: np.random.Generator, robot: Array, robot_radius: float) -> None:
        self.person = person
        self._rng = rng
        self._robot_radius = robot_radius
        self._station = self._first_station(robot)
        self._forward = bool(rng.random() < 0.5)
        self._rest = 0.0  # [s] left at an end of the path
        self._waited = 0.0  # [s] before what is in the way
        self._patience = rng.uniform(*PATIENCE)
        self.position = person.position(self._station)

    def step(self, time_step: float, robot: Array, closed_doors: Array) -> None:
        """Walk on for a time step [s], if neither the robot nor a door is in the way."""
        if self._rest > 0.0:
            self._rest -= time_step
            return
        station, turns = self._next_station(self.person.speed * time_step)
        there = self.person.position(station)
        if self._is_barred(there, robot, closed_doors):
            self._wait(time_step)
            return
        self._station, self.position, self._waited = station, there, 0.0
        if turns:
            self._forward = not self._forward
            self._rest = self._rng.uniform(*PAUSE)

    def gap(self, place: Array, robot: Array) -> float:
        """Measure from the robot's body to the person's, if that were at a place [m]."""
        return float(np.hypot(*(robot - place))) - self._robot_radius - self.person.radius

    def _next_station(self, way: float) -> tuple[float, bool]:
        """Return how far along the path a step leads, and whether it ends there."""
        length = self.person.path.length
        station = self._station + (way if self._forward else -way)
        if self.person.path.closed:
            return station % length, False
        return min(max(station, 0.0), length), not 0.0 < station < length

    def _is_barred(self, there: Array, robot: Array, closed_doors: Array) -> bool:
        """Tell whether the robot is near ahead, or a closed door in between."""
        step = there - self.position
        if np.dot(robot - self.position, step) > 0.0 and self.gap(there, robot) < COURTESY:
            return True
        (x, y), (step_x, step_y), radius = self.position, step, self.person.radius
        return any(
            kernels.contact.share_before_segment(x, y, step_x, step_y, radius, door) < 1.0
            for door in closed_doors
        )

    def _wait(self, time_step: float) -> None:
        """Stand still, and turn round after a while."""
        self._waited += time_step
        if self._waited >= self._patience:
            self._forward = not self._forward
            self._waited, self._patience = 0.0, self._rng.uniform(*PATIENCE)

    def _first_station(self, robot: Array) -> float:
        """Choose a station at random; if the robot is near, the next one that is well away from it."""
        length = self.person.path.length
        stations = (self._rng.uniform(0.0, length) + np.linspace(0.0, length, 64)) % length
        gaps = [self.gap(self.person.position(station), robot) for station in stations]
        away = np.flatnonzero(np.array(gaps) > COURTESY)
        return float(stations[away[0] if len(away) else np.argmax(gaps)])
