"""What the localizer offers."""

from dataclasses import dataclass, replace

import numpy as np

from pilotage.geometry import Affine2, Pose2
from pilotage.localization.estimate import Status


@dataclass(frozen=True)
class PoseHypothesis:
    """One cluster of particles."""

    cell_id: str
    sketch_from_base: Affine2
    probability: float
    position_std: float = 0.0
    position_axis: tuple[float, float] = (0.0, 0.0)

    def moved(self, motion: Pose2) -> "PoseHypothesis":
        """Carry the hypothesis along by a motion of the robot."""
        return replace(self, sketch_from_base=self.sketch_from_base @ motion)


@dataclass(frozen=True)
class Estimate:
    """Where the robot is on the drawing."""

    stamp: float
    status: Status
    hypotheses: tuple[PoseHypothesis, ...]
    cell_probability: float
    fit: float
    place: str
    x: float
    y: float
    heading: float
    scale: float
    y_down: bool = False
    confidence: float = 0.0

    @property
    def probability(self) -> float:
        """Of the leading hypothesis."""
        return self.hypotheses[0].probability

    @property
    def cell_id(self) -> str:
        """Of the leading hypothesis."""
        return self.hypotheses[0].cell_id

    @property
    def sketch_from_base(self) -> Affine2:
        """Of the leading hypothesis."""
        return self.hypotheses[0].sketch_from_base

    @property
    def position_std(self) -> float:
        """Of the leading hypothesis."""
        return self.hypotheses[0].position_std

    @property
    def position_axis(self) -> tuple[float, float]:
        """Of the leading hypothesis."""
        return self.hypotheses[0].position_axis

    def moved(self, motion: Pose2) -> "Estimate":
        """Carry the estimate along by a motion of the robot."""
        moved = tuple(one.moved(motion) for one in self.hypotheses)
        pose = moved[0].sketch_from_base.pose
        x, y = np.array([pose.x, -pose.y if self.y_down else pose.y]).tolist()
        return replace(self, hypotheses=moved, x=x, y=y, heading=pose.theta)
