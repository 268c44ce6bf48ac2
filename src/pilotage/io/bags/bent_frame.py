"""The frame `map` once the drawing is corrected: true metres, and it stays where it was."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from pilotage.correction import BELIEVED, CorrectedDrawing, Sighting
from pilotage.geometry import Array, Pose2, Similarity2, fit_similarity
from pilotage.io.bags.belief import MapFrame
from pilotage.io.bags.ground import Ground

RECENT = 40
"""Keyframes, 20 m of travel, by which the frame is kept where it was: near the robot it must not jump."""
STEPS = 20
"""Of the inverse; each makes the error smaller by the bend's share of the scale."""
AHEAD = 0.1
"""[m] A heading is carried as the way to a point so far ahead."""


@dataclass(frozen=True, eq=False)
class BentFrame(MapFrame):
    """The frame `map` of a corrected drawing; `scale` is that of the drawing on average."""

    corrected: CorrectedDrawing
    map_from_metres: Pose2  # from the metres of the corrected drawing
    ground: Ground = field(init=False)
    roughly: Similarity2 = field(init=False)  # from the sketch to the frame, without the bend

    def __post_init__(self) -> None:
        """Lay out floor and walls, and find what the bend is a bend of."""
        drawn = self.sketch.segments.reshape(-1, 2)
        object.__setattr__(self, "roughly", fit_similarity(drawn, self.from_sketch(drawn)))
        object.__setattr__(self, "ground", Ground.corrected(self.corrected, self.map_from_metres))

    @classmethod
    def after(
        cls, frame: MapFrame, corrected: CorrectedDrawing, sightings: Sequence[Sighting]
    ) -> "BentFrame":
        """Lay a corrected drawing where the frame was; `sightings` are those that it was made of."""
        places = [one.sketch_from_base.translation for one in sightings if one.probability >= BELIEVED]
        drawn = np.array(places[-RECENT:])
        metres, wanted = corrected.metres_from_sketch @ drawn, frame.from_sketch(drawn)
        map_from_metres = fit_similarity(metres, wanted, rigid=True).pose
        return cls(frame.sketch, corrected.scale, corrected, map_from_metres)

    def from_sketch(self, points: Array) -> Array:
        """Carry points (n, 2) from the sketch [drawing units] to the frame [m]."""
        return np.asarray(self.map_from_metres @ (self.corrected.metres_from_sketch @ points))

    def pose_from_sketch(self, pose: Pose2) -> Pose2:
        """Carry a pose of the sketch [drawing units] to the frame [m]."""
        ahead = AHEAD * self.scale
        tip = pose.x + ahead * math.cos(pose.theta), pose.y + ahead * math.sin(pose.theta)
        (x, y), (tip_x, tip_y) = self.from_sketch(np.array([[pose.x, pose.y], tip])).tolist()
        return Pose2(x, y, math.atan2(tip_y - y, tip_x - x))

    def to_file(self, pose: Pose2) -> tuple[float, float, float]:
        """Carry a pose from the frame to the axes of the drawing's file."""
        tip = pose @ np.array([[AHEAD, 0.0]])
        (x, y), (tip_x, tip_y) = self._to_sketch(np.vstack([[pose.x, pose.y], tip])).tolist()
        in_file = self.sketch.file_axes.pose_from_sketch(Pose2(x, y, math.atan2(tip_y - y, tip_x - x)))
        return in_file.x, in_file.y, in_file.theta

    def _to_sketch(self, points: Array) -> Array:
        """Carry points (n, 2) from the frame [m] to the sketch [drawing units]."""
        rough = self.roughly.inverse()
        found = rough @ points
        for _ in range(STEPS):
            found += rough @ points - rough @ self.from_sketch(found)
        return np.asarray(found)
