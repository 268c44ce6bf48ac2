"""Align what was seen on the last metres with the drawing, whatever its scale (Wolter 2001, section 3.4).

Proposals from all over the drawing are ranked by visibility over a window of looks: the cheapest test first,
on many, the dearest last, on few. What remains is refined where it stands and ranked once more.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Pose2
from pilotage.localization.belief import HEADING, LOG_SCALE, Belief, X, Y, stretched
from pilotage.localization.visibility import Look, VisibilityModel
from pilotage.shape.corners import Corners


@dataclass(frozen=True, slots=True)
class View:
    """What was seen, from where, and after how much travel."""

    look: Look
    corners: Corners  # in the frame of the robot [m]
    odom_from_base: Pose2
    way: float  # [m]


@dataclass(frozen=True, slots=True)
class AlignmentSettings:
    """How much is tried, how long, and how finely."""

    window: float = 10.0  # [m] of travel that is aligned as one: farther back, proportions change
    looks: int = 8  # of the window, evenly spaced
    proposals: int = 16_000  # ranked by the newest look
    kept: tuple[int, ...] = (3_000, 600)  # that are ranked by half of the looks, and by all
    rounds: int = 4  # of refinement
    place: float = 0.3  # [m] deviation of a refining move
    heading: float = math.radians(4.0)  # [rad] the same
    log_scale: float = 0.08  # the same
    stretch: float = 0.08  # the same
    wall_penalty: float = 3.0  # log-odds of having walked through a drawn wall between two looks
    wall_tolerance: float = 0.2  # log of how much longer than the way to the wall the way between may be
    trust: float = 0.1  # share of belief that a fresh alignment replaces when it explains the views as well

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        if not self.window > 0.0:
            raise ValueError(f"window must be > 0 m, got {self.window}")
        if not self.looks >= 1:
            raise ValueError(f"looks must be >= 1, got {self.looks}")
        if not 0.0 <= self.trust <= 1.0:
            raise ValueError(f"trust must be in [0, 1], got {self.trust}")


def extend_views(
    views: tuple[View, ...], motion: Pose2, seen: Look, corners: Corners, window: float
) -> tuple[View, ...]:
    """Add what was seen after a motion, and forget what was seen before the window [m]."""
    if not views:
        return (View(seen, corners, Pose2.identity(), 0.0),)
    last = views[-1]
    way = last.way + math.hypot(motion.x, motion.y)
    kept = tuple(view for view in views if way - view.way <= window)
    return (*kept, View(seen, corners, last.odom_from_base @ motion, way))


def corners_in_base(views: tuple[View, ...]) -> Corners:
    """Gather the corners of all views in the frame of the newest; what was seen often counts often."""
    base_from_odom = views[-1].odom_from_base.inverse()
    gathered = views[-1].corners
    for view in views[:-1]:
        gathered = gathered.joined(view.corners.moved(base_from_odom @ view.odom_from_base))
    return gathered


def align(
    views: tuple[View, ...],
    proposals: Array,
    model: VisibilityModel,
    settings: AlignmentSettings,
    rng: np.random.Generator,
) -> Belief:
    """Rank proposals (6, n) for where the newest view stands by how well they explain all views."""
    chosen = choose_views(views, settings.looks)
    states = proposals
    for count, seen in zip(settings.kept, (chosen[:1], chosen[::2]), strict=True):
        states = states[:, best_of(score_views(states, seen, model, settings), count)]
    scores = score_views(states, chosen, model, settings)
    deviations = np.array([settings.heading, settings.log_scale, settings.stretch, settings.stretch])
    for _ in range(settings.rounds):  # Metropolis: each proposal wanders to what explains the views better
        moves = rng.standard_normal(states.shape)
        moves[[X, Y]] *= settings.place * np.exp(states[LOG_SCALE])
        moves[HEADING:] *= deviations[:, np.newaxis]
        tried = states + moves
        tried_scores = score_views(tried, chosen, model, settings)
        taken = np.log(rng.random(len(scores))) < tried_scores - scores
        states = np.where(taken, tried, states)
        scores = np.where(taken, tried_scores, scores)
    return Belief(states, scores)


def trust_in(
    fresh: Belief,
    sample: Array,
    views: tuple[View, ...],
    model: VisibilityModel,
    settings: AlignmentSettings,
) -> float:
    """Return the share of belief that a fresh alignment should replace, given a sample (6, n) of belief.

    All of `trust` if it explains the views as well, else less: so belief that is right is not diluted, and
    one that has gone astray is soon replaced.
    """
    scores = score_views(sample, choose_views(views, settings.looks), model, settings)
    gain = _log_mean(fresh.log_weights) - _log_mean(scores)
    return settings.trust * math.exp(min(gain, 0.0))


def best_of(scores: Array, count: int) -> NDArray[np.intp]:
    """Find the best scores, in order of their index."""
    if count >= len(scores):
        return np.arange(len(scores))
    return np.sort(np.argpartition(-scores, count)[:count])


def _log_mean(log_values: Array) -> float:
    """Return the logarithm of the mean."""
    highest = float(log_values.max())
    return highest + math.log(float(np.exp(log_values - highest).mean()))


def choose_views(views: tuple[View, ...], count: int) -> tuple[View, ...]:
    """Take views evenly spaced in order, the newest first."""
    picked = np.unique(np.linspace(0, len(views) - 1, min(count, len(views))).round().astype(np.intp))
    return tuple(views[index] for index in picked[::-1])


def score_views(
    states: Array, views: tuple[View, ...], model: VisibilityModel, settings: AlignmentSettings
) -> Array:
    """Sum over views, the newest first, the log-likelihood of states (6, n) of the newest, (n,)."""
    from pilotage.kernels.visibility import LOG_STEP, find_blocked

    table = model.atlas.range_table
    tolerance = round(settings.wall_tolerance / LOG_STEP)
    base_from_odom = views[0].odom_from_base.inverse()
    scores = np.zeros(states.shape[1])
    later = states[:2]
    for view in views:
        base_from_then = base_from_odom @ view.odom_from_base
        then = states.copy()
        then[:2] += stretched(states, base_from_then.x, base_from_then.y)
        then[HEADING] += base_from_then.theta
        scores += model.score(then, view.look)
        if view is not views[0]:
            steps = later - then[:2]
            blocked = find_blocked(then[:2].copy(), steps, table.log_ranges, table.grid, tolerance)
            scores -= settings.wall_penalty * blocked
        later = then[:2]
    return scores
