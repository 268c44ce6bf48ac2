"""The window of keyframes: what the robot saw over the last metres, and from where."""

import math
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Pose2
from pilotage.localization.observation import Observation
from pilotage.localization.sensor_model import SparseScan
from pilotage.shape.corners import Corners

WINDOW = 10.0
"""[m] of travel that is searched for as one: over more, the proportions of a drawing change."""


@dataclass(frozen=True, slots=True)
class Keyframe:
    """A scan, where it was taken, and after how much travel."""

    scan: SparseScan
    corners: Corners  # in the frame of the robot [m]
    odom_from_base: Pose2
    travel: float  # [m]


def append_keyframe(window: tuple[Keyframe, ...], seen: Observation) -> tuple[Keyframe, ...]:
    """Add a keyframe after its motion, and drop those before the window."""
    if not window:
        return (Keyframe(seen.scan, seen.corners, Pose2.identity(), 0.0),)
    last = window[-1]
    travel = last.travel + math.hypot(seen.motion.x, seen.motion.y)
    kept = tuple(one for one in window if travel - one.travel <= WINDOW)
    return (*kept, Keyframe(seen.scan, seen.corners, last.odom_from_base @ seen.motion, travel))


def choose_keyframes(window: tuple[Keyframe, ...], count: int) -> tuple[Keyframe, ...]:
    """Take keyframes evenly spaced in order, the newest first."""
    picked = np.unique(np.linspace(0, len(window) - 1, min(count, len(window))).round().astype(np.intp))
    return tuple(window[index] for index in picked[::-1])


def corners_in_base(window: tuple[Keyframe, ...]) -> Corners:
    """Gather the corners of all keyframes in the frame of the newest."""
    base_from_odom = window[-1].odom_from_base.inverse()
    gathered = window[-1].corners
    for keyframe in window[:-1]:
        gathered = gathered.joined(keyframe.corners.moved(base_from_odom @ keyframe.odom_from_base))
    return gathered
