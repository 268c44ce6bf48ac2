"""All that moves in a building but the robot: people, and doors that wait for those who are near."""

import numpy as np

from pilotage import kernels
from pilotage.geometry import Array
from pilotage.simulation.people import Walker
from pilotage.simulation.scene import Movers
from pilotage.simulation.world import World

DOOR_ROOM = 0.8
"""Distance [m] between a door and a body below which the door waits: nobody slams a door on a robot."""


class Traffic:
    """People and doors as they move; `movers` is where they are now."""

    def __init__(self, world: World, rng: np.random.Generator, robot: Array, robot_radius: float) -> None:
        self._rng = rng
        self._robot_radius = robot_radius
        self._walkers: tuple[Walker, ...] = ()
        self.change(world, 0.0, robot)

    def change(self, world: World, stamp: float, robot: Array) -> None:
        """Take the doors of another world, and let those people join who are not there yet."""
        self._doors = tuple(door for door in world.doors if door.closed)
        self._is_closed = [False] * len(self._doors)
        joining = world.people[len(self._walkers) :]
        walkers = (
            Walker(person, walker_rng, robot, self._robot_radius)
            for person, walker_rng in zip(joining, self._rng.spawn(len(joining)), strict=True)
        )
        self._walkers = (*self._walkers, *walkers)
        self._close_doors(stamp, robot)
        self.movers = self._seen()

    def step(self, stamp: float, time_step: float, robot: Array) -> None:
        """Move on to a time [s] while the robot is at (2,) [m]."""
        if not self._doors and not self._walkers:
            return
        for walker in self._walkers:
            walker.step(time_step, robot, self.movers.closed_doors)
        self._close_doors(stamp, robot)
        self.movers = self._seen()

    def _close_doors(self, stamp: float, robot: Array) -> None:
        """Follow the schedules, but close no door on or right before a robot or a person."""
        bodies = [(robot, self._robot_radius)]
        bodies += [(walker.position, walker.person.radius) for walker in self._walkers]
        for k, door in enumerate(self._doors):
            self._is_closed[k] = door.should_be_closed(stamp) and (
                self._is_closed[k]
                or all(
                    kernels.contact.distance_to_segment(x, y, door.segment) > radius + DOOR_ROOM
                    for (x, y), radius in bodies
                )
            )

    def _seen(self) -> Movers:
        """Gather what is in the way."""
        people = [(*walker.position, walker.person.radius) for walker in self._walkers]
        doors = [door.segment for door, closed in zip(self._doors, self._is_closed, strict=True) if closed]
        return Movers(np.array(people).reshape(-1, 3), np.array(doors).reshape(-1, 4))
