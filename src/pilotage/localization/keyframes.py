"""The window of keyframes: what the robot saw over the last metres, and from where."""

import math
from dataclasses import dataclass, replace

import numpy as np

from pilotage.geometry import Pose2
from pilotage.localization.blocked_way import BlockedWay
from pilotage.localization.observation import Observation
from pilotage.localization.sensor_model import SparseScan
from pilotage.shape.corners import Corners

WINDOW = 10.0
"""[m] of travel that is searched for as one, and within which a place is known again: over more, the
proportions of a drawing change."""
NEW_STEP = 0.5
"""[m] from where all keyframes were taken: there a scan counts in full."""
NEW_TURN = math.radians(60.0)
"""[rad] of a turn on the spot after which a scan that covers 180 degrees counts in full. One that covers 360
degrees shows nothing new, and between the two the novelty is interpolated."""


@dataclass(frozen=True, slots=True)
class Keyframe:
    """A scan, where it was taken, and after how much travel."""

    scan: SparseScan
    corners: Corners  # in the frame of the robot [m]
    odom_from_base: Pose2
    travel: float  # [m]
    novelty: float = 1.0  # [0..1] share of the scan that no keyframe of the window showed: its weight
    was_carried: bool = False  # to here, from wherever the keyframe before was taken
    blocked: tuple[BlockedWay, ...] = ()  # ways found blocked since, in the frame of the robot


def append_keyframe(window: tuple[Keyframe, ...], seen: Observation) -> tuple[Keyframe, ...]:
    """Add a keyframe after its motion, and drop those before the window.

    What was seen before the robot was carried tells nothing of where it is now.
    """
    if not window:
        return (Keyframe(seen.scan, seen.corners, Pose2.identity(), 0.0),)
    last = window[-1]
    travel = last.travel + math.hypot(seen.motion.x, seen.motion.y)
    if seen.was_carried:
        return (Keyframe(seen.scan, seen.corners, Pose2.identity(), travel, was_carried=True),)
    kept = tuple(one for one in window if travel - one.travel <= WINDOW)
    odom_from_base = last.odom_from_base @ seen.motion
    novelty = novelty_at(odom_from_base, seen.view, kept)
    return (*kept, Keyframe(seen.scan, seen.corners, odom_from_base, travel, novelty))


def novelty_at(odom_from_base: Pose2, view: float, window: tuple[Keyframe, ...]) -> float:
    """Return the share of a scan of `view` [rad] from a pose that no keyframe of a window showed, [0..1].

    A drawing errs alike whenever the same walls are seen from the same place, so they count once.
    """
    turn_rate = 2.0 * (1.0 - view / math.tau) / NEW_TURN
    novelty = 1.0
    for one in window:
        motion = one.odom_from_base.inverse() @ odom_from_base
        novelty = min(novelty, math.hypot(motion.x, motion.y) / NEW_STEP + turn_rate * abs(motion.theta))
    return novelty


def choose_keyframes(window: tuple[Keyframe, ...], count: int) -> tuple[Keyframe, ...]:
    """Choose at most `count` keyframes, the newest first, at even steps of the summed novelty.

    Keyframes that show the same things again are so passed over.
    """
    novelty = np.cumsum([one.novelty for one in window])
    picked = np.searchsorted(novelty, np.linspace(novelty[0], novelty[-1], min(count, len(window))) - 0.5)
    picked = np.unique([*picked[:-1], len(window) - 1])
    return tuple(window[index] for index in picked[::-1])


def corners_in_base(window: tuple[Keyframe, ...]) -> Corners:
    """Gather the corners of all keyframes in the frame of the newest."""
    base_from_odom = window[-1].odom_from_base.inverse()
    gathered = window[-1].corners
    for keyframe in window[:-1]:
        gathered = gathered.joined(keyframe.corners.moved(base_from_odom @ keyframe.odom_from_base))
    return gathered


def append_blocked_way(window: tuple[Keyframe, ...], way: BlockedWay) -> tuple[Keyframe, ...]:
    """Add a way that was found blocked, in the frame of the newest keyframe, unless it is known."""
    if any(way.is_same(known) for known in ways_in_base(window)):
        return window
    return (*window[:-1], replace(window[-1], blocked=(*window[-1].blocked, way)))


def ways_in_base(window: tuple[Keyframe, ...]) -> tuple[BlockedWay, ...]:
    """Gather the ways found blocked at all keyframes in the frame of the newest."""
    base_from_odom = window[-1].odom_from_base.inverse()
    return tuple(way.moved(base_from_odom @ one.odom_from_base) for one in window for way in one.blocked)
