"""A 2-D laser scanner: beams with noise, dropouts and a limited reach, blind to most glass."""

import math
from dataclasses import dataclass, field

import numpy as np

from pilotage import kernels
from pilotage.geometry import Pose2
from pilotage.perception import LaserScan
from pilotage.simulation.scene import NOBODY, Movers
from pilotage.simulation.world import World


@dataclass(frozen=True, slots=True)
class LaserSettings:
    """What the scanner is like; as it stands, the SICK of the nineties: 181 beams over 180 degrees."""

    beams: int = 181  # directions, evenly spaced over the field of view
    field_of_view: float = math.pi  # [rad] from the first beam to the last, symmetric about forward
    range_max: float = 30.0  # [m]
    noise: float = 0.015  # [m] standard deviation of a range
    dropout: float = 0.005  # share of beams that do not return
    glass_angle: float = math.radians(8.0)  # [rad] off its normal up to which glass throws a beam back
    glass_return: float = 0.05  # share of other beams that dust on the glass throws back
    base_from_laser: Pose2 = field(default_factory=Pose2.identity)

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        if self.beams < 2:
            raise ValueError(f"beams must be at least 2, got {self.beams}")
        if not 0.0 < self.field_of_view <= math.tau:
            raise ValueError(f"field_of_view must be in (0, 2 pi] rad, got {self.field_of_view}")
        if not self.range_max > 0.0:
            raise ValueError(f"range_max must be > 0 m, got {self.range_max}")
        if not self.noise >= 0.0:
            raise ValueError(f"noise must be >= 0 m, got {self.noise}")
        if not 0.0 <= self.glass_angle <= math.pi / 2.0:
            raise ValueError(f"glass_angle must be in [0, pi / 2] rad, got {self.glass_angle}")
        for name in ("dropout", "glass_return"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name} must be in [0, 1], got {getattr(self, name)}")


def sense(
    world: World,
    world_from_base: Pose2,
    stamp: float,
    rng: np.random.Generator,
    settings: LaserSettings,
    *,
    movers: Movers = NOBODY,
) -> LaserScan:
    """Take one scan from where the robot stands."""
    angle_min = -settings.field_of_view / 2.0
    increment = settings.field_of_view / (settings.beams - 1)
    world_from_laser = world_from_base @ settings.base_from_laser
    directions = world_from_laser.theta + angle_min + increment * np.arange(settings.beams, dtype=np.float64)
    origins = np.tile(world_from_laser.position, (settings.beams, 1))
    ranges = world.ranges(origins, directions)
    if len(world.glass) > 0:
        dusty = rng.random(settings.beams) < settings.glass_return
        steepest = np.where(dusty, math.pi / 2.0, settings.glass_angle)
        ranges = np.minimum(ranges, kernels.raycast.cast_on_panes(origins, directions, world.glass, steepest))
    ranges = np.minimum(ranges, kernels.raycast.cast(origins, directions, movers.closed_doors))
    ranges = np.minimum(ranges, kernels.raycast.cast_on_discs(origins, directions, movers.people))
    ranges = np.maximum(ranges + rng.normal(0.0, settings.noise, settings.beams), 0.0)
    ranges[rng.random(settings.beams) < settings.dropout] = np.inf
    return LaserScan(
        stamp,
        angle_min,
        increment,
        ranges,
        range_max=settings.range_max,
        base_from_laser=settings.base_from_laser,
    )
