"""The robot's path in metres while a drawing is corrected: odometry that bends a little from knot to knot."""

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix

from pilotage.correction.spline import Rows
from pilotage.geometry import Array, Pose2

KNOT_DISTANCE = 2.0
"""[m] of travel between knots: over less, scan matching is exact."""
PLACE_DRIFT = (0.0015, 0.0015)
"""[m, m/m] Standard deviation of the motion from knot to knot, fixed and in proportion to the way."""
TURN_DRIFT = (0.001, 0.001)
"""[rad, rad/m] The same of the turn."""


@dataclass(frozen=True, eq=False)
class Path:
    """Poses of sightings, and which of them are knots; between two knots corrections are interpolated."""

    poses: Array  # (n, 3) x, y [m], heading [rad]
    motions: Array  # (k - 1, 3) from knot to knot in the frame of the former, as scan matching tells
    ways: Array  # (k - 1,) [m] from knot to knot
    knots: NDArray[np.intp]  # (k,) numbers of poses, rising

    @property
    def places(self) -> Array:
        """Positions, (n, 2) [m]."""
        return self.poses[:, :2]

    def from_base(self, points: Array, owners: NDArray[np.intp]) -> Array:
        """Carry points (m, 2) in the frames of the poses with these numbers (m,) to metres."""
        return self.turned(points, owners) + self.poses[owners, :2]

    def turned(self, vectors: Array, owners: NDArray[np.intp]) -> Array:
        """Turn vectors (m, 2) of the frames of the poses with these numbers (m,)."""
        cosine, sine = np.cos(self.poses[owners, 2]), np.sin(self.poses[owners, 2])
        x, y = vectors.T
        return np.column_stack([cosine * x - sine * y, sine * x + cosine * y])

    @cached_property
    def pose_changes(self) -> Rows:
        """How changes of all poses (3 n) follow from changes of the knots (3 k), sparse."""
        count = len(self.poses)
        number = np.arange(count)
        before = np.clip(np.searchsorted(self.knots, number, side="right") - 1, 0, len(self.knots) - 2)
        share = (number - self.knots[before]) / (self.knots[before + 1] - self.knots[before])
        rows, columns, values = [], [], []
        for knot, weight in ((before, 1.0 - share), (before + 1, share)):
            arm = self.places - self.places[self.knots[knot]]
            for row, column, value in (
                (0, 0, weight),
                (0, 2, -weight * arm[:, 1]),
                (1, 1, weight),
                (1, 2, weight * arm[:, 0]),
                (2, 2, weight),
            ):
                rows.append(3 * number + row)
                columns.append(3 * knot + column)
                values.append(value)
        return coo_matrix(
            (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
            shape=(3 * count, 3 * len(self.knots)),
        ).tocsr()

    def motion_rows(self) -> tuple[Rows, Array]:
        """Weighted rows on changes of the knots (3 k), and what they should be: motions as they were seen."""
        at, next_ = self.poses[self.knots[:-1]], self.poses[self.knots[1:]]
        cosine, sine = np.cos(at[:, 2]), np.sin(at[:, 2])
        step = next_[:, :2] - at[:, :2]
        ahead, aside = cosine * step[:, 0] + sine * step[:, 1], cosine * step[:, 1] - sine * step[:, 0]
        turn = np.angle(np.exp(1j * (next_[:, 2] - at[:, 2] - self.motions[:, 2])))
        place_weight = 1.0 / (PLACE_DRIFT[0] + PLACE_DRIFT[1] * self.ways)
        turn_weight = 1.0 / (TURN_DRIFT[0] + TURN_DRIFT[1] * self.ways)
        one = np.ones(len(step))
        first = 3 * np.arange(len(step))
        entries = (
            (0, 0, -cosine), (0, 1, -sine), (0, 2, aside), (0, 3, cosine), (0, 4, sine),
            (1, 0, sine), (1, 1, -cosine), (1, 2, -ahead), (1, 3, -sine), (1, 4, cosine),
            (2, 2, -one), (2, 5, one),
        )  # fmt: skip
        weights = (place_weight, place_weight, turn_weight)
        rows = coo_matrix(
            (
                np.concatenate([value * weights[row] for row, _, value in entries]),
                (
                    np.concatenate([first + row for row, _, _ in entries]),
                    np.concatenate([first + column for _, column, _ in entries]),
                ),
            ),
            shape=(3 * len(step), 3 * len(self.knots)),
        ).tocsr()
        errors = np.column_stack([ahead - self.motions[:, 0], aside - self.motions[:, 1], turn])
        return rows, -(errors * np.column_stack(weights)).ravel()

    def changed(self, change: Array) -> "Path":
        """Add changes of the knots (3 k,)."""
        return replace(self, poses=self.poses + (self.pose_changes @ change).reshape(-1, 3))


def path_of(poses: list[Pose2], travels: Array) -> Path:
    """Take poses of scan matching and the travel [m] at each; at least two."""
    knots = [0]
    for number, travel in enumerate(travels):
        if travel - travels[knots[-1]] >= KNOT_DISTANCE:
            knots.append(number)
    if knots[-1] != len(poses) - 1:
        knots.append(len(poses) - 1)
    motions = [poses[a].inverse() @ poses[b] for a, b in pairwise(knots)]
    return Path(
        np.array([(pose.x, pose.y, pose.theta) for pose in poses]),
        np.array([(motion.x, motion.y, motion.theta) for motion in motions]),
        np.diff(travels[knots]),
        np.array(knots, dtype=np.intp),
    )
