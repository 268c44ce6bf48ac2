"""Put the robot down somewhere in a log, let it find its place, and score room by room."""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pilotage.evaluation.rooms import Rooms
from pilotage.geometry import Array
from pilotage.localization import Localizer
from pilotage.perception import Reading

LAST = 10.0
"""The end of an episode over which scans are counted [m]."""
SURE = 0.9
"""Confidence from which on an estimate counts as confident."""


@dataclass(frozen=True, slots=True)
class Episode:
    """Scans `first .. last` (inclusive) of a log."""

    first: int
    last: int


@dataclass(frozen=True, slots=True)
class EpisodeScore:
    """How an episode went; scans in rooms that the drawing leaves out are not counted."""

    right_at_end: bool  # whether the last scan was put into the right room
    right_last: float  # share of scans in the right room over the last 10 m
    meters_to_fix: float  # [m] until right and right for the rest; the whole way if never
    sure: float  # share of scans with confidence above 0.9
    sure_and_wrong: float  # share of scans with confidence above 0.9 in a wrong room
    scan_ms: tuple[float, ...]  # [ms] each scan took


def spread_episodes(positions: Array, count: int, length: float) -> tuple[Episode, ...]:
    """Spread starts evenly over the way (n, 2) [m]; each episode is the next `length` metres of travel."""
    way = way_along(positions)
    if way[-1] <= length:
        raise ValueError(f"length must be < the way of {way[-1]:.0f} m, got {length}")
    starts = np.linspace(0.0, way[-1] - length, count)
    firsts = np.searchsorted(way, starts)
    lasts = np.minimum(np.searchsorted(way, starts + length), len(way) - 1)
    return tuple(Episode(int(first), int(last)) for first, last in zip(firsts, lasts, strict=True))


def way_along(positions: Array) -> Array:
    """Sum up the way to each position (n, 2), (n,) [m]."""
    steps = np.diff(positions, axis=0)
    return np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])


def run_episode(
    localizer: Localizer, readings: Sequence[Reading], truths: Sequence[str], way: Array, drawn_rooms: Rooms
) -> EpisodeScore:
    """Localize the readings of an episode, given the name of the true room and the way (n,) [m] of each."""
    estimates, scan_ms = [], []
    for reading in readings:
        began = time.perf_counter()
        estimates.append(localizer.update(reading.scan, reading.odometry))
        scan_ms.append(1e3 * (time.perf_counter() - began))
    claimed = np.array([estimate.sketch_from_base.pose.position for estimate in estimates])
    claims = drawn_rooms.names_at(localizer.atlas.sketch.file_from_sketch(claimed))
    counted = np.array([name in drawn_rooms.names for name in truths])
    if not counted.any():
        raise ValueError("an episode needs a scan in a room that the drawing shows, got none")
    right = np.array([claim == truth for claim, truth in zip(claims, truths, strict=True)])[counted]
    sure = np.array([estimate.confidence > SURE for estimate in estimates])[counted]
    way = way[counted] - way[0]
    wrong = np.flatnonzero(~right)
    to_fix = 0.0 if len(wrong) == 0 else way[-1] if wrong[-1] == len(right) - 1 else way[wrong[-1] + 1]
    return EpisodeScore(
        bool(right[-1]),
        float(right[way >= way[-1] - LAST].mean()),
        float(to_fix),
        float(sure.mean()),
        float((sure & ~right).mean()),
        tuple(scan_ms),
    )
