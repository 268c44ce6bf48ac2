"""Lay laser scans at known poses on a grid and clean what comes out into the plan of a building.

A grid is held with row 0 at the bottom, so that pixel [i, j] covers x from `left + j * PIXEL` and y from
`bottom + i * PIXEL`.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy import ndimage
from skimage.morphology import disk, remove_small_holes, remove_small_objects

from pilotage.geometry import Array, Pose2
from pilotage.perception import LaserScan

Mask = NDArray[np.bool_]
Counts = NDArray[np.int32]

PIXEL = 0.05  # [m]
REACH = 25.0  # [m] beams are followed so far: farther away a degree is half a metre wide
JOINED = 0.3  # [m] returns of neighboring beams no farther apart are one surface
MARGIN = 1.0  # [m] of unknown ground around all that was seen
SHORT = 2.0  # [pixels] before its return a beam says nothing: that is where poses and ranges err
OCCUPIED = 0.35  # a pixel is occupied if at least this share of the scans that saw it met something there
ROBOT_RADIUS = 0.3  # [m] of ground that the robot's own path proves free
GAP = 1.5  # [pixels] radius of the closing that mends walls: gaps up to 0.15 m
SLIVER = 3  # [pixels] radius: free ground into which no such disc goes is a slit that single beams cut
SPECK = 3  # [pixels] fewer occupied ones together are no thing
HOLE = 12  # [pixels] up to so many unknown ones together, in the midst of free ground, are free

DISC_OF_GAP = np.hypot(*np.mgrid[-1:2, -1:2]) <= GAP
EIGHT = np.ones((3, 3), dtype=bool)


class Tally(NamedTuple):
    """How many scans say what of each pixel, all (rows, columns)."""

    seen: Mask  # by any beam, or between two
    hits: Counts  # scans that met something there
    crossings: Counts  # scans that looked through
    touched: Counts  # the mark of the last scan that said so


@dataclass(frozen=True, eq=False)
class Plan:
    """What is free and what is occupied; the rest is unknown."""

    free: Mask  # (rows, columns), row 0 at the bottom
    occupied: Mask
    left: float  # [m] x of the left edge
    bottom: float  # [m] y of the bottom edge

    def pixels_of(self, points: Array) -> NDArray[np.int64]:
        """Return the row and column of points (n, 2) [m], (n, 2)."""
        return np.floor((points[:, ::-1] - (self.bottom, self.left)) / PIXEL).astype(np.int64)

    def ranges(self, world_from_laser: Pose2, directions: Array) -> Array:
        """Measure along directions (n,) in the laser's frame until ground is not free, (n,) [m]."""
        start = (world_from_laser.position - (self.left, self.bottom)) / PIXEL
        turned = directions + world_from_laser.theta
        return np.asarray(PIXEL * march(start[0], start[1], turned, self.free, REACH / PIXEL))


def plan_of(scans: Sequence[LaserScan], world_from_base: Sequence[Pose2]) -> Plan:
    """Make the plan of a building from scans and the true poses they were taken at.

    A pixel is occupied that enough of the scans which saw it met something in: people who walked by are not.
    """
    poses = [base @ scan.base_from_laser for scan, base in zip(scans, world_from_base, strict=True)]
    positions = np.array([pose.position for pose in poses])
    low = np.floor((positions.min(axis=0) - REACH - MARGIN) / PIXEL) * PIXEL
    shape = np.ceil((positions.max(axis=0) + REACH + MARGIN - low) / PIXEL).astype(int)[::-1]
    tally = Tally(np.zeros(shape, dtype=np.bool_), *np.zeros((3, *shape), dtype=np.int32))
    for mark, (scan, pose) in enumerate(zip(scans, poses, strict=True), start=1):
        start = (pose.position - low) / PIXEL
        directions, ranges = scan.directions + pose.theta, scan.ranges / PIXEL
        near = scan.returned & (scan.ranges < REACH)
        ends = start + along(directions, np.where(near, ranges, 0.0))
        lay_surfaces(mark, ends, near, tally)
        directions, ranges, counts = with_rays_between(directions, np.where(scan.returned, ranges, 0.0))
        shortened = np.clip(ranges - SHORT, 0.0, REACH / PIXEL)
        lay_beams(mark, start, start + along(directions, shortened), counts, tally)
    occupied = tally.hits >= np.maximum(OCCUPIED * (tally.hits + tally.crossings), 1.0)
    return cropped(cleaned(Plan(tally.seen, occupied, float(low[0]), float(low[1])), positions))


def along(directions: Array, ranges: Array) -> Array:
    """Return the points at ranges (n,) along directions (n,), (n, 2)."""
    return np.column_stack([ranges * np.cos(directions), ranges * np.sin(directions)])


def with_rays_between(directions: Array, ranges: Array) -> tuple[Array, Array, Mask]:
    """Fill the gaps between beams with rays as long as the shorter neighbor, so that no pixel is left out.

    Returns directions and ranges of all, and which of them are beams.
    """
    shorter = np.minimum(ranges[:-1], ranges[1:])
    steps = np.diff(directions)
    copies = np.append(np.minimum(1.5 * shorter, REACH / PIXEL) * np.abs(steps), 0.0).astype(int) + 1
    number = np.arange(copies.sum()) - np.repeat(np.cumsum(copies) - copies, copies)
    counts = number == 0
    turned = np.repeat(directions, copies) + number * np.repeat(np.append(steps, 0.0) / copies, copies)
    return (
        turned,
        np.where(counts, np.repeat(ranges, copies), np.repeat(np.append(shorter, 0.0), copies)),
        counts,
    )


def cleaned(raw: Plan, positions: Array) -> Plan:
    """Clean a plan so that what remains could be built, and the path along positions (n, 2) [m] is free."""
    path = path_pixels(raw, positions)
    own = ndimage.distance_transform_edt(~path) * PIXEL <= ROBOT_RADIUS
    walls = ndimage.binary_closing(raw.occupied & ~own, DISC_OF_GAP) & ~own
    walls = remove_small_objects(walls, max_size=SPECK - 1, connectivity=2)
    seen = remove_small_holes(raw.free | walls | own, max_size=HOLE)
    seen = ndimage.binary_opening(seen, disk(SLIVER)) | own
    walls = without_diagonal_leaks(walls & seen, ~own)
    regions, _ = ndimage.label(seen & ~walls)
    free = np.isin(regions, np.unique(regions[path]))
    pieces, _ = ndimage.label(walls, EIGHT)
    beside = np.unique(pieces[ndimage.binary_dilation(free, EIGHT)])
    return Plan(free, walls & np.isin(pieces, beside), raw.left, raw.bottom)


def path_pixels(plan: Plan, positions: Array) -> Mask:
    """Mark the pixels of the straight lines from position to position."""
    steps = np.diff(positions, axis=0)
    counts = np.maximum(np.ceil(np.hypot(*steps.T) / (PIXEL / 2)), 1).astype(int)
    shares = np.concatenate([np.arange(count) / count for count in counts])
    points = np.repeat(positions[:-1], counts, axis=0) + shares[:, None] * np.repeat(steps, counts, axis=0)
    rows, columns = plan.pixels_of(np.vstack([points, positions[-1:]])).T
    marked = np.zeros(plan.free.shape, dtype=bool)
    marked[rows, columns] = True
    return marked


def without_diagonal_leaks(walls: Mask, allowed: Mask) -> Mask:
    """Fill a pixel wherever two pixels of wall touch by a corner only, so that no beam slips through."""
    mended = walls.copy()
    a, b, c, d = walls[:-1, :-1], walls[:-1, 1:], walls[1:, :-1], walls[1:, 1:]
    mended[:-1, 1:] |= a & d & ~b & ~c & allowed[:-1, 1:]
    mended[:-1, :-1] |= b & c & ~a & ~d & allowed[:-1, :-1]
    return mended


def cropped(plan: Plan) -> Plan:
    """Cut off unknown ground that surrounds all else."""
    margin = round(MARGIN / PIXEL)
    known = plan.free | plan.occupied
    rows, columns = np.flatnonzero(known.any(axis=1)), np.flatnonzero(known.any(axis=0))
    bottom, left = max(rows[0] - margin, 0), max(columns[0] - margin, 0)
    window = np.s_[bottom : rows[-1] + margin + 1, left : columns[-1] + margin + 1]
    return Plan(
        plan.free[window],
        plan.occupied[window],
        round(plan.left + PIXEL * float(left), 6),
        round(plan.bottom + PIXEL * float(bottom), 6),
    )


@njit(cache=True)
def lay_surfaces(mark: int, points: Array, returned: Mask, tally: Tally) -> None:
    """Count the pixels of one scan's returns, points (n, 2) [pixels] in order of beams, as hits.

    Neighboring returns on one surface are joined.
    """
    joined = JOINED / PIXEL
    for i in range(len(points) - 1):
        if not (returned[i] and returned[i + 1]):
            continue
        along_x, along_y = points[i + 1, 0] - points[i, 0], points[i + 1, 1] - points[i, 1]
        length = math.hypot(along_x, along_y)
        pieces = int(2.0 * length) + 1 if length <= joined else 1
        for k in range(pieces):
            column = math.floor(points[i, 0] + along_x * k / pieces)
            row = math.floor(points[i, 1] + along_y * k / pieces)
            tally.seen[row, column] = True
            if tally.touched[row, column] != mark:
                tally.touched[row, column] = mark
                tally.hits[row, column] += 1


@njit(cache=True)
def lay_beams(mark: int, start: Array, points: Array, counts: Array, tally: Tally) -> None:
    """Follow the beams of one scan from start (2,) to points (n, 2) [pixels].

    Beam i counts as a crossing where `counts[i]`; the others only show what was seen. Each scan counts once
    for a pixel, and not where it hit.
    """
    for i in range(len(points)):
        along_x, along_y = points[i, 0] - start[0], points[i, 1] - start[1]
        steps = int(2.0 * math.hypot(along_x, along_y)) + 1
        for k in range(steps):
            column = math.floor(start[0] + along_x * k / steps)
            row = math.floor(start[1] + along_y * k / steps)
            tally.seen[row, column] = True
            if counts[i] and tally.touched[row, column] != mark:
                tally.touched[row, column] = mark
                tally.crossings[row, column] += 1


@njit(cache=True)
def march(x: float, y: float, directions: Array, free: Mask, reach: float) -> Array:
    """Walk from pixel to pixel along each direction until one is not free; all lengths in pixels."""
    ranges = np.full(len(directions), np.inf)
    for i in range(len(directions)):
        beam_x, beam_y = math.cos(directions[i]), math.sin(directions[i])
        row, column = math.floor(y), math.floor(x)
        distance = 0.0
        while distance < reach and 0 <= row < free.shape[0] and 0 <= column < free.shape[1]:
            if not free[row, column]:
                ranges[i] = distance
                break
            to_column, to_row = np.inf, np.inf
            if beam_x != 0.0:
                to_column = (column + (beam_x > 0.0) - x) / beam_x
            if beam_y != 0.0:
                to_row = (row + (beam_y > 0.0) - y) / beam_y
            if to_column < to_row:
                distance = to_column
                column += 1 if beam_x > 0.0 else -1
            else:
                distance = to_row
                row += 1 if beam_y > 0.0 else -1
    return ranges
