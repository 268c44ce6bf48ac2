"""Put a robot down somewhere in a log, let it localize, and score what it claims scan by scan.

`follow` records a `Trace`; all scores are pure functions of traces, so that one run serves several of them.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pilotage.evaluation.rooms import Rooms
from pilotage.geometry import Array
from pilotage.perception import LaserScan, Odometry, Reading

LAST = 10.0  # [m] the end of an episode over which scans are counted
SURE = 0.9  # probability above which an estimate counts as sure
DOUBT = 0.5  # probability below which a place is doubted
SETTLED = 5.0  # [m] of travel during which a settled robot was sure
KEPT = 5.0  # [m] of travel during which a place found again must be right
OTHER_PLACE = 3.0  # [m] an estimate that moves this much farther than the robot is of another place
MISMATCH = "mismatch"

Flags = NDArray[np.bool_]


class Claim(Protocol):
    """What scoring reads of an estimate; `status` has a `value`, the rest is as in `Estimate`."""

    @property
    def status(self) -> object:
        """Located, lost or mismatch."""

    @property
    def probability(self) -> float:
        """Probability of the place."""

    @property
    def x(self) -> float:
        """Place in the axes of the drawing's file."""

    @property
    def y(self) -> float:
        """Place in the axes of the drawing's file."""

    @property
    def scale(self) -> float:
        """Drawing units per metre."""


class Locating(Protocol):
    """What `follow` needs of a localizer."""

    def update(self, scan: LaserScan, odometry: Odometry) -> Claim:
        """Take one scan in, give one estimate out."""


@dataclass(frozen=True, slots=True)
class Episode:
    """Scans `first .. last` (inclusive) of a log."""

    first: int
    last: int


@dataclass(frozen=True, eq=False)
class Trace:
    """What was claimed and what was true at each scan of an episode; all arrays are (n,)."""

    way: Array  # [m] true travel since the first scan
    probability: Array  # of the place claimed
    right: Flags  # whether it lies in the true room
    counted: Flags  # whether the drawing shows the true room
    mismatch: Flags  # whether the drawing was claimed to be of another building
    jump: Array  # [m] the claim moved farther than the robot since the scan before
    scan_ms: Array  # [ms]

    def part(self, chosen: Flags | slice) -> "Trace":
        """Return some of the scans."""
        return Trace(**{name: getattr(self, name)[chosen] for name in TRACE_FIELDS})

    def to_lists(self) -> dict[str, list[float]]:
        """Return a value that JSON can hold."""
        return {name: getattr(self, name).tolist() for name in TRACE_FIELDS}

    @classmethod
    def from_lists(cls, lists: dict[str, list[float]]) -> "Trace":
        """Read what `to_lists` returned."""
        return cls(**{name: np.array(lists[name], dtype=kind) for name, kind in TRACE_FIELDS.items()})


TRACE_FIELDS = {
    "way": np.float64,
    "probability": np.float64,
    "right": np.bool_,
    "counted": np.bool_,
    "mismatch": np.bool_,
    "jump": np.float64,
    "scan_ms": np.float64,
}


@dataclass(frozen=True, slots=True)
class EpisodeScore:
    """How an episode went; scans in rooms that the drawing leaves out are not counted."""

    right_at_end: bool  # whether the last scan was put into the right room
    right_last: float  # share of scans in the right room over the last 10 m
    meters_to_fix: float  # [m] until right and right for the rest; the whole way if never
    sure: float  # share of scans with probability above 0.9
    sure_and_wrong: float  # share of scans with probability above 0.9 in a wrong room


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
    """Return the length of the way to each position (n, 2), (n,) [m]."""
    steps = np.diff(positions, axis=0)
    return np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])


def follow(
    localizer: Locating, readings: Sequence[Reading], truths: Sequence[str], way: Array, drawn_rooms: Rooms
) -> Trace:
    """Localize readings one by one, given the true room's name and the way (n,) [m] of each."""
    claims: list[Claim] = []
    scan_ms = []
    for reading in readings:
        began = time.perf_counter()
        claims.append(localizer.update(reading.scan, reading.odometry))
        scan_ms.append(1e3 * (time.perf_counter() - began))
    return trace_of(claims, readings, truths, way, drawn_rooms, scan_ms=scan_ms)


def trace_of(
    claims: Sequence[Claim],
    readings: Sequence[Reading],
    truths: Sequence[str],
    way: Array,
    drawn_rooms: Rooms,
    *,
    scan_ms: Sequence[float],
) -> Trace:
    """Compare claims with the truth."""
    places = np.array([(claim.x, claim.y) for claim in claims])
    named = drawn_rooms.names_at(places)
    scales = np.array([claim.scale for claim in claims])
    driven = np.array([reading.odometry.odom_from_base.position for reading in readings])
    moved = np.diff(way_along(places)) / scales[1:]
    return Trace(
        np.asarray(way) - way[0],
        np.array([claim.probability for claim in claims], dtype=np.float64),
        np.array([name == truth != "" for name, truth in zip(named, truths, strict=True)]),
        np.array([truth in drawn_rooms.names for truth in truths]),
        np.array([status_of(claim) == MISMATCH for claim in claims]),
        np.concatenate([[0.0], np.maximum(moved - np.diff(way_along(driven)), 0.0)]),
        np.array(scan_ms, dtype=np.float64),
    )


def status_of(claim: Claim) -> str:
    """Return the word for a claim's status."""
    return str(getattr(claim.status, "value", claim.status))


def score(trace: Trace) -> EpisodeScore:
    """Score an episode room by room."""
    if not trace.counted.any():
        raise ValueError("an episode needs a scan in a room that the drawing shows, got none")
    counted = trace.part(trace.counted)
    right, way, sure = counted.right, counted.way, counted.probability > SURE
    wrong = np.flatnonzero(~right)
    to_fix = 0.0 if len(wrong) == 0 else way[-1] if wrong[-1] == len(right) - 1 else way[wrong[-1] + 1]
    return EpisodeScore(
        bool(right[-1]),
        float(right[way >= way[-1] - LAST].mean()),
        float(to_fix),
        float(sure.mean()),
        float((sure & ~right).mean()),
    )


def settled(trace: Trace) -> Flags:
    """Tell at which scans the robot has been sure for the last metres, (n,)."""
    unsure_at = np.where(trace.probability > SURE, -np.inf, trace.way)
    return np.asarray(trace.way - np.maximum(np.maximum.accumulate(unsure_at), 0.0) >= SETTLED)


def lost(trace: Trace) -> Flags:
    """Tell at which scans the robot doubts its place, (n,)."""
    return np.asarray(trace.probability < DOUBT)


def first_found(trace: Trace) -> int | None:
    """Return the first scan that was sure and right; None if there is none."""
    found = np.flatnonzero((trace.probability > SURE) & trace.right & trace.counted)
    return int(found[0]) if len(found) else None


def false_alarms(trace: Trace) -> tuple[int, float]:
    """Count how often a right place was doubted after it had been found, and over how many metres."""
    first = first_found(trace)
    if first is None:
        return 0, 0.0
    after = trace.part(slice(first, None))
    doubted = after.probability < DOUBT
    crossings = ~doubted[:-1] & doubted[1:] & after.right[:-1] & after.right[1:]
    return int(np.count_nonzero(crossings)), float(after.way[-1] - after.way[0])


def meters_to_doubt(trace: Trace) -> float:
    """Measure the way from the first scan until the place believed then is doubted [m]; inf if never.

    It is doubted when its probability falls below 0.5, or another place is claimed instead.
    """
    left = np.cumsum(trace.jump * (np.arange(len(trace.jump)) > 0) > OTHER_PLACE) > 0
    doubted = np.flatnonzero(left | (trace.probability < DOUBT))
    return float(trace.way[doubted[0]]) if len(doubted) else math.inf


def meters_to_right(trace: Trace) -> float:
    """Measure the way until the claim is right and stays right for 5 m more [m]; inf if never."""
    counted = trace.part(trace.counted)
    for index in np.flatnonzero(counted.right):
        near = (counted.way >= counted.way[index]) & (counted.way <= counted.way[index] + KEPT)
        if counted.right[near].all():
            return float(counted.way[index])
    return math.inf


def moved_elsewhere(
    positions: Array, truths: Sequence[str], taken: int, *, away: float, length: float
) -> NDArray[np.intp]:
    """Find the scans at which a robot may be set down that was taken away at scan `taken`.

    They are more than `away` [m] off, in another room with a name, and `length` [m] of the log follow.
    """
    way = way_along(positions)
    distances = np.hypot(*(positions - positions[taken]).T)
    other = np.array([name not in {"", truths[taken]} for name in truths])
    return np.flatnonzero((distances > away) & other & (way[-1] - way >= length))


def continued(readings: Sequence[Reading], before: Reading) -> list[Reading]:
    """Let readings go on where another reading ended: neither odometry nor time jumps.

    The first of them reports the same odometry as the reading before: wheels do not turn while carried.
    """
    first = readings[0]
    new_from_old = before.odometry.odom_from_base @ first.odometry.odom_from_base.inverse()
    step = readings[1].scan.stamp - first.scan.stamp if len(readings) > 1 else 0.0
    later = before.scan.stamp + step - first.scan.stamp
    return [
        Reading(
            replace(reading.scan, stamp=reading.scan.stamp + later),
            Odometry(reading.odometry.stamp + later, new_from_old @ reading.odometry.odom_from_base),
        )
        for reading in readings
    ]
