"""A drive through a world as a log would hold it, and the truth beside it."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from pilotage.geometry import Pose2
from pilotage.perception import Odometry, Reading
from pilotage.simulation.laser import LaserSettings, sense
from pilotage.simulation.odometry import OdometrySettings
from pilotage.simulation.robot import DriveSettings, Moment, follow, reckon
from pilotage.simulation.world import World


@dataclass(frozen=True, slots=True)
class RunSettings:
    """The robot, its laser, its wheels, and how often it takes a scan."""

    drive: DriveSettings = field(default_factory=DriveSettings)
    laser: LaserSettings = field(default_factory=LaserSettings)
    odometry: OdometrySettings = field(default_factory=OdometrySettings)
    scan_every: float = 0.3  # [m]
    scan_every_turn: float = 0.3  # [rad]

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("scan_every", "scan_every_turn"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")


@dataclass(frozen=True, slots=True)
class Run:
    """What the robot read, and where it truly was at each reading."""

    readings: tuple[Reading, ...]
    truth: tuple[Moment, ...]


def simulate(
    world: World, waypoints: ArrayLike, rng: np.random.Generator, settings: RunSettings = RunSettings()
) -> Run:
    """Drive along waypoints (n, 2) [m] and scan on the way."""
    moments = list(follow(waypoints, settings.drive))
    reported = reckon([moment.world_from_base for moment in moments], rng, settings.odometry)
    chosen = list(spaced(moments, settings))
    readings = (
        Reading(
            sense(world, moments[k].world_from_base, moments[k].stamp, rng, settings.laser),
            Odometry(moments[k].stamp, reported[k]),
        )
        for k in chosen
    )
    return Run(tuple(readings), tuple(moments[k] for k in chosen))


def spaced(moments: Iterable[Moment], settings: RunSettings) -> Iterator[int]:
    """Choose the moments of scans: the first, and each that is far enough from the last chosen."""
    last: Pose2 | None = None
    for k, moment in enumerate(moments):
        pose = moment.world_from_base
        if last is not None:
            move = last.inverse() @ pose
            if np.hypot(move.x, move.y) < settings.scan_every and abs(move.theta) < settings.scan_every_turn:
                continue
        last = pose
        yield k
