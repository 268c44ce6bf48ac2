"""Score a trajectory by relations between poses (Kümmerle et al. 2009), so that drift counts only once."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pilotage.errors import FileError
from pilotage.evaluation.trajectory import MotionErrors, motion_errors
from pilotage.geometry import Pose2, Trajectory, wrap_angle

COLUMNS = 5


@dataclass(frozen=True, slots=True)
class Relation:
    """Where the robot was at one moment, seen from where it was at another."""

    stamp_a: float  # [s]
    stamp_b: float  # [s]
    a_from_b: Pose2


def read_relations(path: Path | str) -> tuple[Relation, ...]:
    """Read `stamp_a stamp_b x y theta` a line; `#` begins a comment."""
    try:
        table = np.loadtxt(path, ndmin=2)
    except (OSError, ValueError) as error:
        raise FileError("relations are `stamp_a stamp_b x y theta` a line", path) from error
    if table.shape[1] != COLUMNS:
        raise FileError(f"relations have {COLUMNS} numbers a line, got {table.shape[1]}", path)
    return tuple(Relation(a, b, Pose2(x, y, theta)) for a, b, x, y, theta in table.tolist())


def relation_errors(trajectory: Trajectory, relations: tuple[Relation, ...]) -> MotionErrors:
    """Compare each relation with what the trajectory, whose stamps must rise, says of it."""
    estimated = [
        interpolate(trajectory, relation.stamp_a).inverse() @ interpolate(trajectory, relation.stamp_b)
        for relation in relations
    ]
    return motion_errors(estimated, [relation.a_from_b for relation in relations])


def interpolate(trajectory: Trajectory, stamp: float) -> Pose2:
    """Return the pose at a moment, moving evenly from each pose to the next; the ends stand still.

    >>> there = Trajectory([0.0, 1.0], [[0.0, 0.0, 3.0], [2.0, 0.0, -3.0]])
    >>> interpolate(there, 0.5).x
    1.0
    """
    after = int(np.clip(np.searchsorted(trajectory.stamps, stamp), 1, len(trajectory) - 1))
    start, end = trajectory.stamps[after - 1 : after + 1].tolist()
    share = min(max((stamp - start) / (end - start), 0.0), 1.0)
    a, b = trajectory.pose(after - 1), trajectory.pose(after)
    turn = wrap_angle(b.theta - a.theta)
    return Pose2(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.theta + share * turn)
