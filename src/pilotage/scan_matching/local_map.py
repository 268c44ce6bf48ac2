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
from pilotage.perception.scan import Odometry
from pilotage.scan_matching.odometry_noise import OdometryNoise
from pilotage.scan_matching.registration import Registration
from pilotage.shape.partial import PartialShape

if TYPE_CHECKING:
    from pilotage.kernels.segment_field import SegmentField


@dataclass(frozen=True, slots=True)
class PerceptionMapSettings:
    """What the map keeps."""

    window: float = 10.0  # [m] of the robot's way; over 10 m registration drifts by less than 10 cm
    key_distance: float = 0.3  # [m] a scan is entered once the robot has moved this far
    key_turn: float = math.radians(10.0)  # [rad] or turned so much since the last one that was
    reach: float = 0.6  # [m] how far from a shape its nearest segment is known
    cell: float = 0.1  # [m] how exactly

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("window", "reach", "cell"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0 m, got {getattr(self, name)}")
        for name in ("key_distance", "key_turn"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")


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
        """Enter what a registered scan shows that was not known (section 3.3, step 4).

        Known shapes stay as they were first seen: to replace them by newer ones, as the paper does, lets the
        map drift faster (decision 0006). What was entered too long ago is forgotten, and entered anew if it
        is still in sight. A scan taken where the last one was entered moves the robot only.
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
        """Enter and forget."""
        new = tuple(
            registration.shapes[index].moved(registration.odom_from_base) for index in registration.unmatched
        )
        oldest = self.traveled - self.settings.window
        kept = [index for index, entered_at in enumerate(self.entered_at) if entered_at >= oldest]
        stamp = registration.odometry.stamp
        seen_again = {correspondence.known for correspondence in registration.correspondences}
        last_seen = (stamp if index in seen_again else self.last_seen[index] for index in kept)
        entered = replace(
            self,
            shapes=(*(self.shapes[index] for index in kept), *new),
            last_seen=(*last_seen, *(stamp for _ in new)),
            entered_at=(*(self.entered_at[index] for index in kept), *(self.traveled for _ in new)),
            odom_from_key=registration.odom_from_base,
        )
        is_kept = np.isin(self.shape_of_segment, kept)
        entered.__dict__["segments"] = np.concatenate([self.segments[is_kept], segments_of(new)])
        return entered


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
