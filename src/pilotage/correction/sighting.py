"""What is kept of a scan until a drawing is corrected: surface points, and where the localizer was then."""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Affine2, Array, Pose2, frozen_array
from pilotage.localization import Estimate, Localizer, Status
from pilotage.perception import LaserScan

STEP, TURN = 0.5, math.radians(20.0)
"""[m, rad] A sighting is kept after so much motion since the one before, as keyframes are."""
POINTS = 60
"""Surface points of a sighting, evenly spaced, at most."""
ENDS = 180
"""Ends of beams of a sighting, evenly spaced, at most."""
FARTHEST = 15.0
"""[m] Beams that end farther off tell little about where a surface lies."""
JUMP, JUMP_SHARE = 0.4, 0.1
"""[m, share of the range] by which the next return is farther off where a surface ends."""
FARTHEST_EDGE = 8.0
"""[m] Farther off, beams are too far apart to tell where a surface ends."""
RETURNS = 5
"""Neighboring returns that show a straight surface: two to either side of the one whose normal is sought."""
ROUGH, ROUGH_SHARE = 0.05, 0.02
"""[m, share of their length] by which these may lie off a straight line; they are longer than the former."""
GAP, GAP_SHARE = 0.3, 0.12
"""[m, share of the range] Neighboring returns farther apart lie on different surfaces."""
LONGEST_GAP = 0.7
"""Largest share of their length between two of these: most of it must not be one gap."""


@dataclass(frozen=True, eq=False)
class Sighting:
    """One scan where it was taken: in metres by scan matching, and on the drawing by the localizer."""

    odom_from_base: Pose2  # of scan matching: exact over some metres, drifts along the way
    travel: float  # [m] along the way, never falling from sighting to sighting
    points: Array  # (n, 2) on straight surfaces, in the base frame [m]
    normals: Array  # (n, 2) unit normals of the surfaces there, towards the laser
    edges: Array  # (k, 2) where straight surfaces end before something farther off, in the base frame [m]
    ends: Array  # (m, 2) where beams ended, in the base frame [m]
    laser: tuple[float, float]  # where they began, in the base frame [m]
    sketch_from_base: Affine2  # the estimate
    probability: float  # [0..1] of the estimate; 0 if the robot was lost or doubted the drawing

    def __post_init__(self) -> None:
        """Freeze the arrays; reject points without normals and a probability that is none."""
        for name in ("points", "normals", "edges", "ends"):
            values = np.asarray(getattr(self, name), dtype=np.float64)
            if values.ndim != 2 or values.shape[1] != 2 or not np.isfinite(values).all():
                raise ValueError(f"{name} must be finite and have shape (n, 2), got {values.shape}")
            object.__setattr__(self, name, frozen_array(values))
        if len(self.points) != len(self.normals):
            raise ValueError(
                f"each point needs a normal, got {len(self.points)} points and {len(self.normals)} normals"
            )
        if not 0.0 <= self.probability <= 1.0:
            raise ValueError(f"probability must be in [0, 1], got {self.probability}")

    @classmethod
    def of(cls, scan: LaserScan, odom_from_base: Pose2, travel: float, estimate: Estimate) -> Self:
        """Keep what a scan shows, and what was estimated then."""
        returns = scan.points_in_base
        laser = scan.base_from_laser.position
        normals, straight = surface_normals(returns, laser)
        distances = np.hypot(*(returns - laser).T)
        chosen = thinned(np.flatnonzero(straight & (distances < FARTHEST)), POINTS)
        ends = thinned(np.arange(len(returns)), ENDS)
        return cls(
            odom_from_base,
            travel,
            returns[chosen],
            normals[chosen],
            returns[find_edges(returns, straight, laser)],
            returns[ends],
            (float(laser[0]), float(laser[1])),
            estimate.sketch_from_base,
            estimate.probability if estimate.status is Status.LOCATED else 0.0,
        )


def append_sighting(sightings: list[Sighting], localizer: Localizer, scan: LaserScan) -> None:
    """Append what the localizer's last scan shows if the robot has moved far enough since the last sighting.

    Call it after each `localizer.update(scan, odometry)`.
    """
    odom_from_base = localizer.scan_matcher.odom_from_base
    travel = 0.0
    if sightings:
        motion = sightings[-1].odom_from_base.inverse() @ odom_from_base
        distance = math.hypot(motion.x, motion.y)
        if distance < STEP and abs(motion.theta) < TURN:
            return
        travel = sightings[-1].travel + distance
    sightings.append(Sighting.of(scan, odom_from_base, travel, localizer.estimate))


def surface_normals(returns: Array, laser: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Find the unit normal towards the laser at each return (n, 2) in order of beams, and where it counts.

    It counts, (n,), where the returns around lie on one straight surface; elsewhere it means nothing, (n, 2).
    """
    count = len(returns)
    normals, straight = np.zeros((count, 2)), np.zeros(count, dtype=bool)
    if count < RETURNS:
        return normals, straight
    around = RETURNS // 2
    windows = np.stack([returns[k : count - 2 * around + k] for k in range(RETURNS)])  # (5, n - 4, 2)
    along = windows[-1] - windows[0]
    length = np.hypot(*along.T)
    across = np.column_stack([-along[:, 1], along[:, 0]]) / np.maximum(length, 1e-9)[:, np.newaxis]
    off = np.abs(((windows[1:-1] - windows[0]) * across).sum(axis=-1)).max(axis=0)
    gaps = np.hypot(*np.moveaxis(np.diff(windows, axis=0), -1, 0)).max(axis=0)
    middle = windows[around] - laser
    ranges = np.hypot(*middle.T)
    facing = np.where((across * middle).sum(axis=1) > 0.0, -1.0, 1.0)
    normals[around:-around] = across * facing[:, np.newaxis]
    straight[around:-around] = (
        (length > ROUGH)
        & (off < ROUGH + ROUGH_SHARE * length)
        & (gaps < LONGEST_GAP * length)
        & (gaps < np.maximum(GAP, GAP_SHARE * ranges))
    )
    return normals, straight


def find_edges(returns: Array, straight: NDArray[np.bool_], laser: Array) -> NDArray[np.intp]:
    """Find returns (n, 2) where a straight surface ends and the next return is farther off, as at a post."""
    ranges = np.hypot(*(returns - laser).T)
    jump = np.diff(ranges)
    step = np.maximum(JUMP, JUMP_SHARE * np.minimum(ranges[:-1], ranges[1:]))
    first, last = np.flatnonzero(jump > step), np.flatnonzero(jump < -step) + 1
    around = RETURNS // 2
    first, last = first[first >= around], last[last < len(returns) - around]
    found = np.concatenate([first[straight[first - around]], last[straight[last + around]]])
    return np.asarray(found[ranges[found] < FARTHEST_EDGE])


def thinned(indices: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """Keep at most so many indices, evenly spaced."""
    if len(indices) <= count:
        return indices
    return np.asarray(indices[np.linspace(0, len(indices) - 1, count).astype(np.intp)])
