"""Score motion: associate by stamp, thin, add noise, and compare with the truth."""

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Pose2, Trajectory

STAMP_TOLERANCE = 1e-3  # [s] stamps are written to microseconds at best


def associate(stamps: Array, truth: Trajectory) -> NDArray[np.intp]:
    """Find for each stamp the index of the true pose taken then, (n,).

    Equal stamps are associated in order. Trajectories of equal length whose stamps do not agree are
    associated index by index; otherwise a stamp without a true pose is an error.

    >>> truth = Trajectory([1.0, 2.0, 2.0, 3.0], np.zeros((4, 3)))
    >>> associate(np.array([2.0, 2.0, 3.0]), truth).tolist()
    [1, 2, 3]
    """
    order = np.argsort(truth.stamps, kind="stable")
    known = truth.stamps[order]
    turn = _occurrences(stamps)
    found = np.minimum(np.searchsorted(known, stamps - STAMP_TOLERANCE) + turn, len(known) - 1)
    is_near = np.abs(known[found] - stamps) <= STAMP_TOLERANCE
    if is_near.all():
        return np.asarray(order[found], dtype=np.intp)
    if len(stamps) == len(truth):
        return np.arange(len(stamps))
    raise ValueError(f"{np.count_nonzero(~is_near)} of {len(stamps)} stamps have no true pose")


def _occurrences(stamps: Array) -> NDArray[np.intp]:
    """Count for each stamp how many equal ones came before it, (n,)."""
    seen: dict[float, int] = {}
    counts = np.zeros(len(stamps), dtype=np.intp)
    for index, stamp in enumerate(stamps.tolist()):
        counts[index] = seen.get(stamp, 0)
        seen[stamp] = counts[index] + 1
    return counts


def motions(poses: Sequence[Pose2]) -> list[Pose2]:
    """Return the motion from each pose to the next, in the frame of the former."""
    return [before.inverse() @ after for before, after in itertools.pairwise(poses)]


def chain(steps: Sequence[Pose2]) -> list[Pose2]:
    """Return the poses that motions lead to, from the identity on; one more than there are motions."""
    poses = [Pose2.identity()]
    for step in steps:
        poses.append(poses[-1] @ step)
    return poses


def thin(poses: Sequence[Pose2], min_distance: float, min_turn: float) -> list[int]:
    """Keep the first pose and each that is `min_distance` [m] or `min_turn` [rad] from the last one kept."""
    kept = [0]
    for index, pose in enumerate(poses):
        motion = poses[kept[-1]].inverse() @ pose
        if math.hypot(motion.x, motion.y) >= min_distance or abs(motion.theta) >= min_turn:
            kept.append(index)
    return kept


def spoil(
    steps: Sequence[Pose2], rng: np.random.Generator, *, place_per_meter: float, turn_per_meter: float
) -> list[Pose2]:
    """Add noise to motions, in proportion to their length: x, y [m/m] and heading [rad/m], each normal."""
    spoilt = []
    for step in steps:
        distance = math.hypot(step.x, step.y)
        dx, dy, dtheta = rng.normal(size=3).tolist()
        spoilt.append(
            Pose2(
                step.x + dx * place_per_meter * distance,
                step.y + dy * place_per_meter * distance,
                step.theta + dtheta * turn_per_meter * distance,
            )
        )
    return spoilt


class MotionErrors(NamedTuple):
    """How far estimated motions are from true ones."""

    place: Array  # (n,) [m]
    turn: Array  # (n,) [rad], at least 0


def motion_errors(estimated: Sequence[Pose2], true: Sequence[Pose2]) -> MotionErrors:
    """Compare motions one by one, in the frame each arrives in."""
    errors = [b.inverse() @ a for a, b in zip(estimated, true, strict=True)]
    return MotionErrors(
        np.array([math.hypot(error.x, error.y) for error in errors]),
        np.array([abs(error.theta) for error in errors]),
    )
