"""What was believed at one moment, in the metres of the frame `map`: what all messages are made of.

The frame `map` (REP-105) is the drawing, y up, with its own origin and axes, divided by one scale. If the
drawing has no true scale, this is a convention: see docs/reference/ros.md.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from pilotage.geometry import Array, Pose2
from pilotage.localization import Estimate
from pilotage.maps import SchematicMap

UNKNOWN_STD = 100.0
"""[m] Told where the spread of an estimate is not known."""


@dataclass(frozen=True, slots=True)
class MapFrame:
    """The frame `map` of a drawing."""

    sketch: SchematicMap
    scale: float  # [drawing units per metre] one number for the whole drawing

    def from_sketch(self, points: Array) -> Array:
        """Carry points (n, 2) from the sketch [drawing units] to the frame [m]."""
        return points / self.scale

    def pose_from_sketch(self, pose: Pose2) -> Pose2:
        """Carry a pose of the sketch [drawing units] to the frame [m]."""
        return Pose2(pose.x / self.scale, pose.y / self.scale, pose.theta)

    def from_file(self, x: float, y: float, heading: float) -> Pose2:
        """Carry a pose from the axes of the drawing's file to the frame."""
        pose = self.sketch.file_axes.pose_to_sketch(Pose2(x, y, heading))
        return self.pose_from_sketch(pose)

    def to_file(self, pose: Pose2) -> tuple[float, float, float]:
        """Carry a pose from the frame to the axes of the drawing's file."""
        on_sketch = Pose2(self.scale * pose.x, self.scale * pose.y, pose.theta)
        in_file = self.sketch.file_axes.pose_from_sketch(on_sketch)
        return in_file.x, in_file.y, in_file.theta


def known_scale(sketch: SchematicMap, given: float | None) -> float | None:
    """Return the scale of the frame `map` [drawing units per metre] if it is given, or the file tells it."""
    if given is not None:
        return given
    return 1.0 / sketch.metres_per_unit if sketch.metres_per_unit else None


@dataclass(frozen=True, slots=True)
class Place:
    """One place where the robot may be."""

    pose: Pose2  # map_from_base
    probability: float


@dataclass(frozen=True, eq=False)
class Belief:
    """What was believed at one moment."""

    stamp: float  # [s]
    places: tuple[Place, ...]  # the most probable first
    covariance: Array  # (2, 2) of the position of the first [m2]
    values: Mapping[str, str]  # all else that is worth telling, in words

    @property
    def pose(self) -> Pose2:
        """The estimate."""
        return self.places[0].pose

    @classmethod
    def of_estimate(cls, estimate: Estimate, frame: MapFrame, stamp: float | None = None) -> "Belief":
        """Take an estimate of the localizer."""
        places = tuple(
            Place(frame.pose_from_sketch(one.sketch_from_base.pose), one.probability)
            for one in estimate.hypotheses
        )
        values = {
            "status": estimate.status.value,
            "place": estimate.place,
            "cell": estimate.cell_id,
            "probability": f"{estimate.probability:.3f}",
            "fit": f"{estimate.fit:.3f}",
            "evidence": f"{estimate.log_evidence:.1f}",
            "scale": f"{estimate.scale:.6g}",
            "stretch": f"{stretch_of(estimate):.4f}",
        }
        local = estimate.position_std * estimate.scale / frame.scale  # [m] of the frame
        axis = np.array(estimate.position_axis) / frame.scale
        return cls(estimate.stamp if stamp is None else stamp, places, covariance_of(local, axis), values)

    @classmethod
    def of_record(cls, record: Mapping[str, Any], frame: MapFrame) -> "Belief":
        """Take a line of a file of estimates or of a journal; raises KeyError, TypeError or ValueError."""
        places = tuple(
            Place(frame.from_file(one["x"], one["y"], one["heading"]), float(one["probability"]))
            for one in record["hypotheses"]
        )
        names = (
            "status",
            "place",
            "cell",
            "probability",
            "fit",
            "evidence",
            "scale",
            "behavior",
            "outcome",
            "reason",
        )
        values = {name: str(record[name]) for name in names if record.get(name) is not None}
        std = record.get("position_std")
        std = UNKNOWN_STD if std is None else float(std)
        return cls(float(record["stamp"]), places, covariance_of(std, np.zeros(2)), values)


def covariance_of(std: float, axis: Array) -> Array:
    """Return the covariance of a position, (2, 2), of its spread [m] and the largest axis of it (2,) [m]."""
    along = min(float(axis @ axis), std**2)
    if along == 0.0:
        return np.eye(2) * std**2 / 2.0
    across = std**2 - along
    return np.outer(axis, axis) + across * (np.eye(2) - np.outer(axis, axis) / along)


def stretch_of(estimate: Estimate) -> float:
    """Return how many times longer the drawing is in one direction than across it, here."""
    singular = np.linalg.svd(estimate.sketch_from_base.linear, compute_uv=False)
    return float(singular[0] / singular[1]) if singular[1] > 0.0 else math.inf
