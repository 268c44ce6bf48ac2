"""The local map of what was seen on the last meters (Wolter 2001, section 3.3).

It holds shapes, not points; it is small, it forgets, and it never closes a loop: what comes into sight again
is entered again, where the robot now believes it to be.
"""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Pose2
from pilotage.perception.correspondence import Registration
from pilotage.perception.odometry_noise import OdometryNoise
from pilotage.perception.scan import Odometry
from pilotage.shape.partial import PartialShape

if TYPE_CHECKING:
    from pilotage.kernels.segment_field import SegmentField


@dataclass(frozen=True, slots=True)
class PerceptionMapSettings:
    """What the map keeps."""

    window: float = 10.0  # [m] of the robot's way; over 10 m registration drifts by less than 10 cm
    key_distance: float = 0.3  # [m] a scan is entered once the robot has moved this far
    key_turn: float = math.radians(10.0)  # [rad] or turned so much since the last one that was
    cover_distance: float = 0.12  # [m] a shape is covered where a newer one runs its way within this
    cover_share: float = 0.7  # [0..1] of its length: then the newer one replaces it
    reach: float = 0.6  # [m] how far from a shape its nearest segment is known
    cell: float = 0.1  # [m] how exactly
    sample_step: float = 0.1  # [m] between the points that tell whether a shape is covered
    min_cosine: float = 0.7  # lines less than 45 degrees apart run the same way

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("window", "cover_distance", "reach", "cell", "sample_step"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0 m, got {getattr(self, name)}")
        for name in ("key_distance", "key_turn"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")
        if not 0.0 <= self.cover_share <= 1.0:
            raise ValueError(f"cover_share must be in [0, 1], got {self.cover_share}")


@dataclass(frozen=True, eq=False)
class PerceptionMap:
    """Shapes in the `odom` frame, each with when it was last seen; where the robot is, and what it reckoned.

    Start with `PerceptionMap()`; `register` and `merged` take it from there.
    """

    settings: PerceptionMapSettings = field(default_factory=PerceptionMapSettings)
    shapes: tuple[PartialShape, ...] = ()
    last_seen: tuple[float, ...] = ()  # [s]
    entered_at: tuple[float, ...] = ()  # [m] of the robot's way when each shape was entered
    traveled: float = 0.0  # [m] of way so far
    odom_from_base: Pose2 = field(default_factory=Pose2.identity)
    odometry: Odometry | None = None  # the raw reckoning of the last reading; None before the first
    noise: OdometryNoise = field(default_factory=OdometryNoise)  # how far the reckoning errs
    odom_from_key: Pose2 | None = None  # where the last scan was entered

    @cached_property
    def segments(self) -> Array:
        """All segments of all shapes, (m, 4) [m]."""
        return segments_of(self.shapes)

    @cached_property
    def segment_field(self) -> "SegmentField":
        """The segments, ready for nearest-segment queries."""
        from pilotage.kernels.segment_field import build_segment_field

        return build_segment_field(self.segments, self.settings.cell, self.settings.reach)

    @cached_property
    def shape_of_segment(self) -> NDArray[np.intp]:
        """Index of the shape each segment belongs to, (m,)."""
        return segment_owners(self.shapes)

    def merged(self, registration: Registration) -> "PerceptionMap":
        """Enter what a registered scan shows.

        Newer shapes replace those they cover; the rest is entered as it is, and what the robot saw too long
        ago is forgotten. A scan taken where the last one was entered moves the robot only.
        """
        motion = registration.last_from_base
        moved = replace(
            self,
            traveled=self.traveled + math.hypot(motion.x, motion.y),
            odom_from_base=registration.odom_from_base,
            odometry=registration.odometry,
            noise=registration.noise,
        )
        if not self._is_key(registration.odom_from_base):
            moved.__dict__.update({name: self.__dict__[name] for name in _DERIVED if name in self.__dict__})
            return moved
        return moved._entered(registration)  # noqa: SLF001  # of its own kind

    def _is_key(self, odom_from_base: Pose2) -> bool:
        """Tell whether the robot moved far enough for a new scan to be worth entering."""
        if self.odom_from_key is None or not self.shapes:
            return True
        motion = self.odom_from_key.inverse() @ odom_from_base
        return (
            math.hypot(motion.x, motion.y) >= self.settings.key_distance
            or abs(motion.theta) >= self.settings.key_turn
        )

    def _entered(self, registration: Registration) -> "PerceptionMap":
        """Replace, enter and forget."""
        seen = tuple(shape.moved(registration.odom_from_base) for shape in registration.shapes)
        oldest = self.traveled - self.settings.window
        kept = [
            index
            for index, is_covered in enumerate(self._covered_by(seen))
            if not is_covered and self.entered_at[index] >= oldest
        ]
        stamp = registration.odometry.stamp
        return replace(
            self,
            shapes=(*(self.shapes[index] for index in kept), *seen),
            last_seen=(*(self.last_seen[index] for index in kept), *(stamp for _ in seen)),
            entered_at=(*(self.entered_at[index] for index in kept), *(self.traveled for _ in seen)),
            odom_from_key=registration.odom_from_base,
        )

    def _covered_by(self, seen: tuple[PartialShape, ...]) -> list[bool]:
        """Tell of each known shape whether newer shapes cover enough of it to replace it."""
        if not seen or not self.shapes:
            return [False] * len(self.shapes)
        from pilotage.kernels.segment_field import NONE, build_segment_field, find_nearest
        from pilotage.kernels.segment_sampling import sample_segments

        points, directions, weights, owners = sample_segments(self.segments, self.settings.sample_step)
        newer = build_segment_field(segments_of(seen), self.settings.cell / 2, self.settings.cover_distance)
        covered = weights * (find_nearest(points, directions, newer, self.settings.min_cosine) != NONE)
        shape = self.shape_of_segment[owners]
        whole = np.bincount(shape, weights, len(self.shapes))
        share = np.bincount(shape, covered, len(self.shapes)) / np.maximum(whole, np.finfo(float).tiny)
        return [bool(is_covered) for is_covered in share >= self.settings.cover_share]


_DERIVED = ("segments", "segment_field", "shape_of_segment")  # what depends on the shapes alone


def segments_of(shapes: tuple[PartialShape, ...]) -> Array:
    """Return all segments of all shapes, (m, 4) as x1, y1, x2, y2."""
    if not shapes:
        return np.empty((0, 4))
    rings = [shape.polyline.ring for shape in shapes]
    vertices = np.concatenate(rings)
    segments = np.hstack([vertices[:-1], vertices[1:]])
    between_shapes = np.cumsum([len(ring) for ring in rings[:-1]], dtype=np.intp) - 1
    return np.delete(segments, between_shapes, axis=0)


def segment_owners(shapes: tuple[PartialShape, ...]) -> NDArray[np.intp]:
    """Return the index of the shape that each segment of `segments_of` belongs to, (m,)."""
    return np.repeat(np.arange(len(shapes)), [len(shape.polyline.ring) - 1 for shape in shapes])
