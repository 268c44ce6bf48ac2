"""A robot in a world, moved by commands: what it reads, and what is true."""

import math
from dataclasses import dataclass, field

import numpy as np

from pilotage import kernels
from pilotage.errors import PilotageError
from pilotage.geometry import Array, Pose2, Twist
from pilotage.perception import Odometry, Reading
from pilotage.simulation.body import BodySettings, rolled
from pilotage.simulation.laser import LaserSettings, sense
from pilotage.simulation.odometry import OdometrySettings, Wheels
from pilotage.simulation.rectangle import share_before_contact, touches
from pilotage.simulation.scene import Scene
from pilotage.simulation.traffic import Traffic
from pilotage.simulation.world import World

SKIN = 1e-6
"""The robot stops this far from what it touches [m], so that no rounding puts it inside."""

APART = 0.01
"""A contact is over once the robot is this far from all things [m]."""


class StartError(PilotageError, ValueError):
    """A robot cannot stand where it is to start."""


@dataclass(frozen=True, slots=True)
class SimulatorSettings:
    """The robot, its laser, its wheels, and how often it gets a command."""

    body: BodySettings = field(default_factory=BodySettings)
    laser: LaserSettings = field(
        default_factory=lambda: LaserSettings(beams=360, field_of_view=math.radians(359.0))
    )
    odometry: OdometrySettings = field(default_factory=OdometrySettings)
    time_step: float = 0.1  # [s]

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        if not self.time_step > 0.0:
            raise ValueError(f"time_step must be > 0 s, got {self.time_step}")


class Simulator:
    """Moves a robot through a world, one command a time step; equal seeds and commands give equal drives.

    Raises StartError if the robot would stand in a wall.
    """

    def __init__(
        self,
        world: World,
        start: Pose2,
        rng: np.random.Generator,
        settings: SimulatorSettings = SimulatorSettings(),
    ) -> None:
        check_standing(world, start, settings.body.reach)
        self.world = world
        self.settings = settings
        self.world_from_base = start
        self.twist = Twist(0.0, 0.0)  # how the robot moves now
        self.collisions = 0  # contacts until now, each counted once
        self._steps = 0
        self._touching = False
        self._reading: Reading | None = None
        self._laser_rng, wheels_rng, traffic_rng = rng.spawn(3)  # so that none disturbs the others
        self._wheels = Wheels(wheels_rng, settings.odometry)
        self._traffic = Traffic(world, traffic_rng, start.position, settings.body.reach)

    @property
    def stamp(self) -> float:
        """The time since the start [s]."""
        return self._steps * self.settings.time_step

    @property
    def people(self) -> Array:
        """Where people stand now, (k, 2) [m]."""
        return self._traffic.movers.people[:, :2]

    @property
    def closed_doors(self) -> Array:
        """The doors that are closed now, (m, 4) [m]."""
        return self._traffic.movers.closed_doors

    @property
    def scene(self) -> Scene:
        """All that a spectator sees now."""
        return Scene(self.world_from_base, self.read().scan, self.people, self.closed_doors, self.collisions)

    def step(self, command: Twist) -> None:
        """Obey a command for one time step."""
        if not (math.isfinite(command.linear) and math.isfinite(command.angular)):
            raise ValueError(f"a command must be finite, got {command}")
        self.twist = self.settings.body.obeyed(self.twist, command, self.settings.time_step)
        self._move()
        self._steps += 1
        self._traffic.step(self.stamp, self.settings.time_step, self.world_from_base.position)
        self._reading = None

    def carry(self, world_from_base: Pose2) -> None:
        """Put the robot elsewhere, unseen by its wheels; StartError if it cannot stand there."""
        check_standing(self.world, world_from_base, self.settings.body.reach)
        self.world_from_base, self.twist = world_from_base, Twist(0.0, 0.0)
        self._touching, self._reading = False, None

    def rebuild(self, world: World) -> None:
        """Change the world around the robot: people walk on, others join; doors follow their schedules.

        Raises StartError if something would stand where the robot is.
        """
        check_standing(world, self.world_from_base, self.settings.body.radius)
        self.world = world
        self._traffic.change(world, self.stamp, self.world_from_base.position)
        self._reading = None

    def read(self) -> Reading:
        """Read the laser and the wheels; the same reading until the next step."""
        if self._reading is None:
            scan = sense(
                self.world,
                self.world_from_base,
                self.stamp,
                self._laser_rng,
                self.settings.laser,
                movers=self._traffic.movers,
            )
            self._reading = Reading(scan, Odometry(self.stamp, self._wheels.odom_from_base))
        return self._reading

    def _move(self) -> None:
        """Drive on as far as nothing is in the way; where something is, stop at the point of contact."""
        wanted = rolled(self.twist, self.settings.time_step)
        share = self._share_before_contact(wanted)
        turned = share if self.settings.body.rectangle else 1.0  # a disc turns freely
        move = Pose2(share * wanted.x, share * wanted.y, turned * wanted.theta)
        self.world_from_base = self.world_from_base @ move
        self._wheels.roll(move)
        if share < 1.0:
            self.twist = Twist(0.0, self.twist.angular if self.settings.body.rectangle is None else 0.0)
            self.collisions += not self._touching
            self._touching = True
        elif self._touching:
            self._touching = self._room() < APART

    def _share_before_contact(self, move: Pose2) -> float:
        """Return what share of a motion in the robot's frame it can make before it touches anything."""
        size = self.settings.body.rectangle
        if size is not None:
            return share_before_contact(self.world_from_base, move, size, *self._things)
        if move.x == 0.0 and move.y == 0.0:
            return 1.0
        here = self.world_from_base
        step = (here @ move).position - here.position
        share = kernels.contact.share_before_all(
            here.x,
            here.y,
            step[0],
            step[1],
            self.settings.body.radius + SKIN,
            self.world.solid_grid,
            self.closed_doors,
            self._traffic.movers.people,
        )
        return float(share)

    @property
    def _things(self) -> tuple[Array, Array]:
        """What a robot may touch now: segments (m, 4) and discs (k, 3)."""
        return np.vstack([self.world.solid, self.closed_doors]), self._traffic.movers.people

    def _room(self) -> float:
        """Measure from the robot's body to the nearest thing, up to a little over APART [m]."""
        size = self.settings.body.rectangle
        if size is not None:
            grown = size[0] + 2.0 * APART, size[1] + 2.0 * APART
            return 0.0 if touches(self.world_from_base, grown, *self._things) else APART
        reach = self.settings.body.radius + 2.0 * APART
        x, y = where = self.world_from_base.position
        walls = float(self.world.clearance([where], reach)[0])
        doors = min(
            (float(kernels.contact.distance_to_segment(x, y, door)) for door in self.closed_doors),
            default=reach,
        )
        people = np.hypot(*(self.people - where).T) - self._traffic.movers.people[:, 2]
        return min(walls, doors, float(people.min(initial=reach))) - self.settings.body.radius


def check_standing(world: World, world_from_base: Pose2, radius: float) -> None:
    """Reject a place where a robot of this radius [m] would stand in a wall."""
    if not world.is_free([world_from_base.position], radius)[0]:
        raise StartError(
            f"a start must leave {radius:.3g} m around it free,"
            f" got ({world_from_base.x:.2f}, {world_from_base.y:.2f}), which is in or at a wall"
        )
