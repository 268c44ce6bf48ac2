"""Bring scans and odometry together by their stamps, whatever a recording did to them."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Pose2, wrap_angle

CLOCK_JUMP = 1.0
"""[s] A stamp that is so much earlier than the one before means that the clock was set back."""

GAP = 1.0
"""[s] A longer time between two scans is told."""

REACH = 0.2
"""[s] Scans so soon before the first or after the last odometry take its pose."""

LONGEST_INTERPOLATION = 1.0
"""[s] Between readings of odometry that are farther apart nothing is known of the motion."""


@dataclass(frozen=True, eq=False)
class Order:
    """Which messages of a stream count, and what is odd about their stamps."""

    kept: NDArray[np.bool_]  # (n,)
    epochs: NDArray[np.int64]  # (n,) how often the clock was set back before
    duplicates: int
    late: int  # stamps a little earlier than one before
    gaps: int
    longest_gap: float  # [s]

    @property
    def clock_jumps(self) -> int:
        """How often the clock was set back."""
        return int(self.epochs[-1]) if len(self.epochs) else 0

    @property
    def remarks(self) -> list[str]:
        """What a user should know."""
        told = (
            (self.duplicates, "with the stamp of the one before, left out"),
            (self.late, "out of order, left out"),
        )
        remarks = [f"{counted(count, 'scan')} {what}" for count, what in told if count]
        if self.clock_jumps:
            remarks.append(f"the clock was set back {counted(self.clock_jumps, 'time')}")
        if self.gaps:
            remarks.append(
                f"{counted(self.gaps, 'gap')} without scans, the longest of {self.longest_gap:.1f} s"
            )
        return remarks


def counted(count: int, noun: str) -> str:
    """Return a count and its noun.

    >>> counted(1, "scan"), counted(2, "scan")
    ('1 scan', '2 scans')
    """
    return f"{count} {noun}{'' if count == 1 else 's'}"


def put_in_order(stamps: Array) -> Order:
    """Keep stamps that rise, and start anew where the clock was set back; `stamps` (n,) [s]."""
    kept = np.zeros(len(stamps), dtype=bool)
    epochs = np.zeros(len(stamps), dtype=np.int64)
    duplicates = late = gaps = epoch = 0
    longest, last = 0.0, -math.inf
    for index, stamp in enumerate(stamps.tolist()):
        step = stamp - last
        if step <= -CLOCK_JUMP:
            epoch += 1
        epochs[index] = epoch
        duplicates += step == 0.0
        late += -CLOCK_JUMP < step < 0.0
        if -CLOCK_JUMP < step <= 0.0:
            continue
        kept[index] = True
        if GAP < step < math.inf:
            gaps, longest = gaps + 1, max(longest, step)
        last = stamp
    return Order(kept, epochs, duplicates, late, gaps, longest)


@dataclass(frozen=True, eq=False)
class OdometryTrack:
    """Odometry in the order of its recording."""

    stamps: Array  # (n,) [s]
    poses: Array  # (n, 3) x [m], y [m], theta [rad]
    epochs: NDArray[np.int64]  # (n,)

    @classmethod
    def of(cls, stamps: Array, poses: Array) -> "OdometryTrack":
        """Keep readings whose stamps rise."""
        order = put_in_order(stamps)
        return cls(stamps[order.kept], poses[order.kept], order.epochs[order.kept])

    def at(self, stamps: Array, epochs: NDArray[np.int64]) -> tuple[Array, NDArray[np.bool_]]:
        """Interpolate at these stamps; return poses (m, 3), and where they are known (m,)."""
        poses, known = np.zeros((len(stamps), 3)), np.zeros(len(stamps), dtype=bool)
        for epoch in np.unique(epochs).tolist():
            mine, asked = self.epochs == epoch, epochs == epoch
            if mine.any():
                poses[asked], known[asked] = interpolated(self.stamps[mine], self.poses[mine], stamps[asked])
        return poses, known


def interpolated(times: Array, poses: Array, stamps: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Interpolate poses (n, 3) at rising times (n,); a stamp that is a time gets the very pose."""
    after = np.clip(np.searchsorted(times, stamps), 0, len(times) - 1)
    exact = times[after] == stamps
    before = np.where(exact, after, np.clip(after - 1, 0, None))
    span = times[after] - times[before]
    inside = (stamps >= times[before]) & (stamps <= times[after])
    share = np.where(inside & (span > 0.0), (stamps - times[before]) / np.where(span > 0.0, span, 1.0), 0.0)
    share = np.where(stamps > times[after], 1.0, share)
    turn = poses[after, 2] - poses[before, 2]
    turn = np.where(np.abs(turn) > math.pi, np.arctan2(np.sin(turn), np.cos(turn)), turn)
    found = poses[before] + share[:, np.newaxis] * np.column_stack(
        [poses[after, :2] - poses[before, :2], turn]
    )
    found = np.where(exact[:, np.newaxis], poses[after], found)
    beyond = np.maximum(times[0] - stamps, stamps - times[-1])
    known = exact | np.where(inside, span <= LONGEST_INTERPOLATION, beyond <= REACH)
    return found, known


def pose_of(row: Array) -> Pose2:
    """Return a row as a pose."""
    x, y, theta = row.tolist()
    return Pose2(x, y, wrap_angle(theta))
