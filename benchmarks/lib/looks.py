"""What a robot has seen at places spread over a log: the keyframes of the last metres, and its true room."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from benchmarks.lib.protocols import travel_of
from pilotage.geometry import Pose2
from pilotage.localization.keyframes import WINDOW, Keyframe, append_keyframe
from pilotage.localization.localizer import LocalizerSettings
from pilotage.localization.observation import observe
from pilotage.scan_matching import ScanMatcher

HAND = "00"
"""Readings are the same whatever the drawing."""


@dataclass(frozen=True, eq=False)
class Look:
    """One place of a log."""

    window: tuple[Keyframe, ...]  # the newest last, over the last 10 m of travel
    scan: int  # of the log, that of the newest keyframe

    def last(self, metres: float) -> tuple[Keyframe, ...]:
        """Return the keyframes of the last metres of travel; of 0 m, the newest only."""
        newest = self.window[-1].travel
        return tuple(one for one in self.window if newest - one.travel <= metres)


@cache
def looks_of(building: str, count: int) -> tuple[Look, ...]:
    """Follow a log up to each of places spread evenly over its way, from 10 m before."""
    travel = travel_of(building, HAND)
    ends = np.searchsorted(travel.way, np.linspace(WINDOW + 2.0, travel.way[-1], count, endpoint=False))
    looks = []
    for end in ends.tolist():
        first = int(np.searchsorted(travel.way, travel.way[end] - WINDOW - 1.0))
        looks.append(_look(building, first, end))
    return tuple(looks)


def _look(building: str, first: int, end: int) -> Look:
    """Follow a log from one scan to another, as a localizer does."""
    matcher, settings = ScanMatcher(LocalizerSettings().scan_matching), LocalizerSettings()
    window: tuple[Keyframe, ...] = ()
    motion = Pose2.identity()
    newest = first
    for index in range(first, end + 1):
        reading = travel_of(building, HAND).readings[index]
        seen = matcher.update(reading.scan, reading.odometry)
        motion = motion @ seen.last_from_base
        if not window or settings.is_keyframe_due(motion):
            window = append_keyframe(window, observe(reading.scan, seen.shapes, motion))
            motion, newest = Pose2.identity(), index
    return Look(window, newest)
