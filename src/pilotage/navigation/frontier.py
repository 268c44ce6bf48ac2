"""Frontier-based exploration (Yamauchi 1997): drive to the border of what was seen to find the place.

A frontier is worth more if it is far from where the robot was, if the hypotheses predict different ranges
there, and if it is nearer to the goal on average over the belief (Q-MDP, in cost_to_go.py).
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array
from pilotage.localization import PoseHypothesis
from pilotage.maps import Atlas
from pilotage.navigation.local_grid import ReachableSet

DIRECTIONS = 36
"""Number of directions in which predicted ranges are compared."""

UNKNOWN_SHARE = 0.45
"""Share of unknown grid cells around a frontier: more than in a corner, whose far side is behind walls."""

AROUND = 0.5
"""Half the side [m] of the square in which they are counted."""

BLOCK = 0.6
"""Side [m] of the blocks of which only the nearest frontier is kept."""

NEW_UP_TO = 4.0
"""Distance [m] from the trail beyond which a frontier is not worth more."""

DIFFERENCE = 4.0
"""Worth [m] of predicted ranges that differ by a factor of e between the hypotheses."""

PATH = 0.25
"""Cost of a metre of the path [m]."""

TURN = 0.5
"""Cost of turning round by half a circle [m]."""

DETOUR = 0.3
"""Cost of a metre of the path [m] where the robot drives on along an axis."""

DEAD_END = 0.5
"""A place less far along the axis than this [m] does not lead on."""

SAME = 0.3
"""A place within this distance [m] of the target is the target."""

DONE = 0.5
"""A target is reached once the path to it is shorter than this [m]."""

UNREACHABLE_KEPT = 10
"""Number of unreachable targets to remember."""

RECENT = 20
"""Number of positions of the trail to back away from."""


@dataclass(frozen=True, eq=False)
class Exploration:
    """The frontier that the robot drives to, and those that it could not reach; in odom [m]."""

    target: Array | None = None  # (2,)
    unreachable: Array = field(default_factory=lambda: np.empty((0, 2)))

    def given_up(self) -> "Exploration":
        """Remember that the robot could not reach its target."""
        if self.target is None:
            return self
        return Exploration(None, np.vstack([self.unreachable, self.target])[-UNREACHABLE_KEPT:])

    def target_in(self, reachable: ReachableSet) -> int | None:
        """Return which of `reachable.points` is the target; None if there is none, or it is reached."""
        if self.target is None:
            return None
        away = np.hypot(*(reachable.points - self.target).T)
        index = int(away.argmin())
        return index if away[index] < SAME and reachable.lengths[index] > DONE else None


def find_frontiers(reachable: ReachableSet) -> NDArray[np.intp]:
    """Find places of `reachable.points` from where much would be seen that was not, one a block, (k,)."""
    grid = reachable.local_grid
    half = max(1, round(AROUND / grid.cell))
    unknown = box_mean(grid.evidence == 0, half)
    cells = reachable.cells
    at_border = np.flatnonzero(unknown[cells[:, 0], cells[:, 1]] > UNKNOWN_SHARE)
    if len(at_border) == 0:
        return at_border
    blocks = np.floor(reachable.points[at_border] / BLOCK).astype(np.int64)
    order = np.lexsort((reachable.lengths[at_border], blocks[:, 1], blocks[:, 0]))
    ordered = blocks[order]
    first = np.append(True, (ordered[1:] != ordered[:-1]).any(axis=1))
    return np.asarray(at_border[order[first]], dtype=np.intp)


def box_mean(mask: NDArray[np.bool_], half: int) -> Array:
    """Average a mask over squares of 2 half + 1 cells; beyond its border it counts as False."""
    padded = np.pad(mask.astype(np.float64), ((half + 1, half), (half + 1, half)))
    sums = padded.cumsum(axis=0).cumsum(axis=1)
    width = 2 * half + 1
    total = sums[width:, width:] - sums[:-width, width:] - sums[width:, :-width] + sums[:-width, :-width]
    return np.asarray(total / width**2)


def frontier_worth(
    reachable: ReachableSet,
    frontiers: NDArray[np.intp],
    avoided: Array,
    hypotheses: tuple[PoseHypothesis, ...],
    atlas: Atlas,
) -> Array:
    """Return what frontiers are worth apart from the progress towards the goal, (k,) [m].

    `frontiers` (k,) are indices of `reachable.points`; `avoided` (n, 2) is where the robot was or could not
    get to, in odom [m].
    """
    odom_from_base = reachable.local_grid.odom_from_base
    points = reachable.points[frontiers]
    to_avoided = np.hypot(*(points[:, np.newaxis] - avoided).transpose(2, 0, 1)).min(axis=1)
    in_base = odom_from_base.inverse() @ points
    return np.asarray(
        np.minimum(to_avoided, NEW_UP_TO)
        + DIFFERENCE * range_differences(in_base, hypotheses, atlas)
        - PATH * reachable.lengths[frontiers]
        - TURN * np.abs(np.arctan2(in_base[:, 1], in_base[:, 0])) / np.pi
    )


def range_differences(points: Array, hypotheses: tuple[PoseHypothesis, ...], atlas: Atlas) -> Array:
    """Tell how much the ranges that hypotheses predict at points (n, 2) differ, (n,).

    Points are in the robot's frame [m]. The difference is the standard deviation of log ranges [m] between
    hypotheses, weighted by their probabilities and averaged over directions.
    """
    if len(hypotheses) < 2:
        return np.zeros(len(points))
    table = atlas.range_table
    count = table.log_ranges.shape[1]
    directions = np.arange(DIRECTIONS) * np.pi * 2.0 / DIRECTIONS
    probabilities = np.array([one.probability for one in hypotheses])
    probabilities = probabilities / probabilities.sum()
    logs = []
    for one in hypotheses:
        lines = table.lines_at(one.sketch_from_base @ points)
        theta, scale = one.sketch_from_base.pose.theta, one.sketch_from_base.scale
        turned = np.round((directions + theta) / (2.0 * np.pi) * count).astype(np.int64) % count
        logs.append(table.log_ranges[np.ix_(lines, turned)] * kernels.visibility.LOG_STEP - np.log(scale))
    stacked = np.stack(logs)
    mean = np.tensordot(probabilities, stacked, 1)
    variance = np.tensordot(probabilities, (stacked - mean) ** 2, 1)
    return np.asarray(np.sqrt(variance).mean(axis=1))


def farthest(reachable: ReachableSet, trail: Array) -> int:
    """Choose the place of `reachable.points` that is farthest from where the robot was recently."""
    away = np.hypot(*(reachable.points[:, np.newaxis] - trail[-RECENT:]).transpose(2, 0, 1)).min(axis=1)
    return int(away.argmax())


def farthest_along(reachable: ReachableSet, axis: Array) -> int | None:
    """Choose the place of `reachable.points` farthest along an axis (2,) in odom, ahead of the robot.

    None if only turning back leads on.
    """
    odom_from_base = reachable.local_grid.odom_from_base
    ahead = odom_from_base.rotation[:, 0]
    onward = axis / np.hypot(*axis) * (1.0 if axis @ ahead >= 0.0 else -1.0)
    gained = (reachable.points - odom_from_base.position) @ onward
    best = int((gained - DETOUR * reachable.lengths).argmax())
    return best if gained[best] > DEAD_END else None
