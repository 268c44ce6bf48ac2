"""Between a sketch (y up) and the axes of the file that it was read from."""

from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, Homography, Pose2

Y_DOWN = (1.0, -1.0)


@dataclass(frozen=True, slots=True)
class FileAxes:
    """How a file tells places: with y down or up, and in a photo from where it was taken.

    >>> FileAxes(y_down=True).from_sketch(np.array([[2.0, -3.0]])).tolist()
    [[2.0, 3.0]]
    """

    y_down: bool = False  # as in SVG and in pictures
    photo_from_sketch: Homography | None = None  # to the photo that was straightened, y up in both

    def from_sketch(self, points: Array) -> Array:
        """Carry points (n, 2) of the sketch to the file; the unit stays, a photo's nearly."""
        if self.photo_from_sketch is not None:
            points = self.photo_from_sketch.points(points)
        return points * Y_DOWN if self.y_down else np.array(points, dtype=np.float64)

    def to_sketch(self, points: Array) -> Array:
        """Carry points (n, 2) of the file to the sketch."""
        upright = points * Y_DOWN if self.y_down else np.array(points, dtype=np.float64)
        return upright if self.photo_from_sketch is None else self.photo_from_sketch.inverse.points(upright)

    def pose_from_sketch(self, pose: Pose2) -> Pose2:
        """Carry a pose of the sketch to the file; its heading is counter-clockwise on the page in both."""
        upright = pose if self.photo_from_sketch is None else self.photo_from_sketch.pose(pose)
        return self._flipped(upright)

    def pose_to_sketch(self, pose: Pose2) -> Pose2:
        """Carry a pose of the file to the sketch."""
        upright = self._flipped(pose)
        return upright if self.photo_from_sketch is None else self.photo_from_sketch.inverse.pose(upright)

    def _flipped(self, pose: Pose2) -> Pose2:
        return Pose2(pose.x, -pose.y, pose.theta) if self.y_down else pose
