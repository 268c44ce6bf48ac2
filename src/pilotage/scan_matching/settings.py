"""How a scan is registered."""

import math
from dataclasses import dataclass, field
from enum import Enum

from pilotage.scan_matching.by_shape import ShapeSettings
from pilotage.scan_matching.overlap import OverlapSettings


class Method(Enum):
    """How the pose is found."""

    SEGMENTS = "segments"  # samples of the shapes against segments of the map, from many starts
    SHAPES = "shapes"  # the mean of the poses that matches of shapes induce, as in the paper


@dataclass(frozen=True, slots=True)
class SearchSettings:
    """Where refinement starts: at the best of many poses, each tried with a part of the scan."""

    points: int = 80  # of the scan, at most
    count: int = 10  # poses returned
    turn_step: float = math.radians(2.0)  # [rad] between headings
    stride: int = 2  # cells of the map's field between places
    width: float = 0.3  # [m] at which a point counts half
    reach: float = 3.0  # deviations of odometry within which poses are tried
    max_place: float = 1.6  # [m] never search farther, unless lost
    max_turn: float = math.pi / 2  # [rad] never search farther
    lost_support: float = 0.3  # with less, odometry is taken to be grossly wrong and the search widened
    lost_place: float = 0.2  # [m] then search so far
    lost_place_per_meter: float = (
        2.2  # [m/m] and so much of the motion: a robot may have gone back instead of on
    )
    max_lost_place: float = 5.0  # [m] never search farther: the map ends soon, and odometry may jump by miles
    lost_max_place: float = 3.0  # [m] but no farther: odometry may have jumped
    lost_turn: float = math.radians(60.0)  # [rad]

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("points", "count", "stride"):
            if getattr(self, name) < 1:
                raise ValueError(f"{name} must be >= 1, got {getattr(self, name)}")
        for name in ("turn_step", "width"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")
        for name in (
            "reach",
            "max_place",
            "max_turn",
            "lost_place",
            "lost_place_per_meter",
            "lost_max_place",
            "lost_turn",
        ):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise ValueError(f"{name} must be finite and >= 0, got {getattr(self, name)}")


@dataclass(frozen=True, slots=True)
class RegistrationSettings:
    """How a scan is registered."""

    method: Method = Method.SEGMENTS
    search: SearchSettings = field(default_factory=SearchSettings)
    shape: ShapeSettings = field(default_factory=ShapeSettings)
    overlap: OverlapSettings = field(default_factory=OverlapSettings)
    sample_step: float = 0.05  # [m] between the points that stand for a shape
    full_incidence: float = math.radians(25.0)  # [rad] walls seen at a smaller angle than this weigh less
    widths: tuple[float, ...] = (0.5, 0.35, 0.25, 0.2, 0.15, 0.1, 0.08, 0.06, 0.05, 0.05, 0.05, 0.05)  # [m]
    deviation: float = 0.14  # [m] of one sampled point; neighbors err alike, so it is more than a range's
    min_cosine: float = 0.5  # lines less than 60 degrees apart may be the same
    overhang: float = 0.1  # [m] a point may lie this far past the end of its segment
    tail: float = 4.0  # squared deviations at which odometry loses half its hold
    penalty: float = 0.03  # share of points that outweighs a unit of log(1 + m^2 / tail)
    learning_rate: float = 0.1  # largest relative change of the deviations of odometry a step
    learning_support: float = 0.25  # with less, registration is no judge of odometry

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("sample_step", "full_incidence", "deviation", "tail"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")
        for name in ("overhang", "penalty", "learning_rate"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")
        if not self.widths or not min(self.widths) > 0.0:
            raise ValueError(f"widths must hold one width > 0 m at least, got {self.widths}")
