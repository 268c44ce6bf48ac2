"""Where to drive when the place is not known: where it would show, where nobody was, and towards the goal.

Which way that is, all places held possible are asked together: often most of them agree.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.localization import PoseHypothesis
from pilotage.maps import Atlas
from pilotage.navigation.cost_to_go import CostToGo
from pilotage.navigation.surroundings import Reach

DIRECTIONS = 36
"""In so many directions it is compared what the places held possible would show."""

SAMPLE = 200
"""So many hypotheses are asked which way the goal lies."""

DETOUR = 0.3
"""A metre of way counts against so much [m] farther along."""

DEAD_END = 0.5
"""Where the robot cannot get on by more than this [m], nothing leads on."""


@dataclass(frozen=True, slots=True)
class ExploringSettings:
    """What makes a place worth driving to."""

    unseen: float = 0.45  # share of unseen cells around it: more than in a corner, of what is behind walls
    around: float = 0.5  # [m] how far around
    block: float = 0.6  # [m] of places so near to each other the best one is considered
    newness: float = 1.0  # worth of each metre from where the robot was before, up to ...
    new_beyond: float = 4.0  # [m] ... this
    difference: float = 4.0  # worth of ranges that differ by a factor of e between the places held possible
    progress: float = 1.0  # worth of each metre by which the goal is nearer, on average over belief
    way: float = 0.25  # cost of each metre of the way
    turning: float = 0.5  # cost of turning round by half a circle

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("around", "block", "new_beyond"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0 m, got {getattr(self, name)}")


def find_rims(reach: Reach, settings: ExploringSettings) -> NDArray[np.intp]:
    """Choose places of `reach.points` from where much would be seen that was not, one a block, (k,)."""
    surroundings = reach.surroundings
    half = max(1, round(settings.around / surroundings.settings.cell))
    unseen = box_mean(surroundings.evidence == 0, half)
    cells = reach.cells
    worth = unseen[cells[:, 0], cells[:, 1]]
    at_rim = np.flatnonzero(worth > settings.unseen)
    if len(at_rim) == 0:
        return at_rim
    blocks = np.floor(reach.points[at_rim] / settings.block).astype(np.int64)
    order = np.lexsort((reach.lengths[at_rim], blocks[:, 1], blocks[:, 0]))
    ordered = blocks[order]
    first = np.append(True, (ordered[1:] != ordered[:-1]).any(axis=1))
    return np.asarray(at_rim[order[first]], dtype=np.intp)


def box_mean(mask: NDArray[np.bool_], half: int) -> Array:
    """Average a mask over squares of 2 half + 1 cells; beyond the rim counts as False."""
    padded = np.pad(mask.astype(np.float64), ((half + 1, half), (half + 1, half)))
    sums = padded.cumsum(axis=0).cumsum(axis=1)
    width = 2 * half + 1
    total = sums[width:, width:] - sums[:-width, width:] - sums[width:, :-width] + sums[:-width, :-width]
    return np.asarray(total / width**2)


def choose_rim(
    reach: Reach,
    trail: Array,
    places: tuple[PoseHypothesis, ...],
    atlas: Atlas,
    settings: ExploringSettings,
    *,
    goal: tuple[CostToGo, Array] | None = None,
) -> int | None:
    """Choose the place of `reach.points` that is most worth driving to; None if there is none.

    `trail` (n, 2) is where the robot was, in odom [m]; `places` are those held possible for where it is now.
    What is left of the way to a `goal` counts under a belief of where the robot is.
    """
    rims = find_rims(reach, settings)
    if len(rims) == 0:
        return None
    odom_from_base = reach.surroundings.odom_from_base
    points = reach.points[rims]
    to_trail = np.hypot(*(points[:, np.newaxis] - trail).transpose(2, 0, 1)).min(axis=1)
    in_base = odom_from_base.inverse() @ points
    worth = (
        settings.newness * np.minimum(to_trail, settings.new_beyond)
        + settings.difference * differences(in_base, places, atlas)
        + settings.progress * saved_towards(goal, in_base)
        - settings.way * reach.lengths[rims]
        - settings.turning * np.abs(np.arctan2(in_base[:, 1], in_base[:, 0])) / np.pi
    )
    return int(rims[worth.argmax()])


def differences(points: Array, places: tuple[PoseHypothesis, ...], atlas: Atlas) -> Array:
    """Tell how much the places held possible differ in what they would show from points (n, 2), (n,).

    Points are in the robot's frame [m]; the difference is the deviation of log ranges [m] between places, by
    their probability, averaged over directions.
    """
    from pilotage.kernels.visibility import LOG_STEP

    if len(places) < 2:
        return np.zeros(len(points))
    table = atlas.range_table
    count = table.log_ranges.shape[1]
    directions = np.arange(DIRECTIONS) * np.pi * 2.0 / DIRECTIONS
    probabilities = np.array([place.probability for place in places])
    probabilities = probabilities / probabilities.sum()
    logs = []
    for place in places:
        sketch_from_base = place.sketch_from_base
        pose, scale = sketch_from_base.pose, sketch_from_base.scale
        lines = table.lines_at(scale * (points @ pose.rotation.T) + pose.position)
        turned = np.round((directions + pose.theta) / (2.0 * np.pi) * count).astype(np.int64) % count
        logs.append(table.log_ranges[np.ix_(lines, turned)] * LOG_STEP - np.log(scale))
    stacked = np.stack(logs)
    mean = np.tensordot(probabilities, stacked, 1)
    variance = np.tensordot(probabilities, (stacked - mean) ** 2, 1)
    return np.asarray(np.sqrt(variance).mean(axis=1))


def saved_towards(goal: tuple[CostToGo, Array] | None, points: Array) -> Array:
    """Tell how much nearer the goal is from points (n, 2) in the robot's frame [m], (n,); 0 without one."""
    if goal is None:
        return np.zeros(len(points))
    cost_to_go, belief = goal
    return cost_to_go.saved(points, belief)


def farthest(reach: Reach, trail: Array) -> int:
    """Choose the place of `reach.points` that is farthest from where the robot was of late."""
    away = np.hypot(*(reach.points[:, np.newaxis] - trail[-20:]).transpose(2, 0, 1)).min(axis=1)
    return int(away.argmax())


def choose_onward(reach: Reach, axis: Array) -> int | None:
    """Choose the place of `reach.points` that lies farthest along an axis (2,) in odom, ahead of the robot.

    None if nothing but a turn back leads on.
    """
    odom_from_base = reach.surroundings.odom_from_base
    ahead = odom_from_base.rotation[:, 0]
    onward = axis / np.hypot(*axis) * (1.0 if axis @ ahead >= 0.0 else -1.0)
    gained = (reach.points - odom_from_base.position) @ onward
    best = int((gained - DETOUR * reach.lengths).argmax())
    return best if gained[best] > DEAD_END else None
