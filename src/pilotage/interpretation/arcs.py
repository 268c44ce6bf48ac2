"""Find arcs of a quarter circle, more or less, in drawn lines."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from pilotage.geometry import Array, Polyline, fit_circle, numbered

LEAST_CHORDS = 3
"""An arc is cut into at least so many chords; fewer are corners of a shape."""

STEEPEST = np.radians(40.0)
"""Two chords of one arc turn by less than this: a quarter circle is at least LEAST_CHORDS long."""

SWEEP = np.radians([10.0, 130.0])
"""An open door is drawn open by so much: mostly a quarter circle, sometimes ajar."""

ROUNDNESS = 0.04
"""No vertex of an arc lies farther off its circle than this share of the radius."""

BOW = 2.56
"""Neighboring chords of an arc differ in length by no more than this factor."""

AJAR = np.radians(50.0)
"""An arc that sweeps less must be even: a wall drawn by hand is never straight, and is no such arc."""

EVEN = 1.2
"""The chords of an even arc differ in length by no more than this factor."""

SHARE = 0.25
"""A door's arc is at least this share of the line that draws it; a notch or a rounded corner is less."""

UPRIGHT = 0.1
"""A parabola stands for a quarter circle if its legs are as long as each other and upright, to this share."""


@dataclass(frozen=True, slots=True)
class Arc:
    """A part of a circle."""

    center: Array  # (2,)
    radius: float
    ends: Array  # (2, 2)
    vertices: Array  # (n, 2) of the line that draws it, its ends first and last
    sweep: float  # [rad] between its ends
    is_part: bool = False  # of a much longer line: a notch for a door in an outline, or a rounded corner


def find_arcs(lines: Sequence[Polyline]) -> Iterator[tuple[Arc, int]]:
    """Find the arcs of lines, and the number of the line that each is a part of."""
    if not lines:
        return
    points, owners = numbered([line.ring for line in lines])
    moves = np.append(True, (np.diff(points, axis=0) != 0.0).any(axis=1) | (np.diff(owners) != 0))
    points, owners = points[moves], owners[moves]
    steps = np.diff(points, axis=0)
    lengths = np.where(owners[:-1] == owners[1:], np.hypot(*steps.T), 0.0)
    whole = np.bincount(owners[:-1], weights=lengths, minlength=len(lines))
    for first, last in bows(steps, lengths):
        chords, line = lengths[first : last + 1], int(owners[first])
        is_part = bool(chords.sum() < SHARE * whole[line])
        arc = fitted(points[first : last + 2], is_part=is_part)
        if arc is not None and (arc.sweep >= AJAR or chords.max() <= EVEN * chords.min()):
            yield arc, line


def bows(steps: Array, lengths: Array) -> Iterator[tuple[int, int]]:
    """Find runs of chords (n, 2) that turn gently to one side: the first and last chord of each.

    Between two lines is a step without a length.
    """
    directions = np.arctan2(steps[:, 1], steps[:, 0])
    turns = (np.diff(directions) + np.pi) % (2.0 * np.pi) - np.pi
    even = np.maximum(lengths[1:], lengths[:-1]) < BOW * np.minimum(lengths[1:], lengths[:-1])
    is_gentle = even & (np.abs(turns) < STEEPEST) & (np.abs(turns) > 1e-4)
    sides = np.where(is_gentle, np.sign(turns), 0.0)
    edges = np.flatnonzero(np.diff(sides, prepend=np.nan, append=np.nan))
    for first, last in pairwise(edges.tolist()):
        if sides[first] != 0.0 and last - first + 1 >= LEAST_CHORDS:
            yield first, last


def fitted(points: Array, *, is_part: bool) -> Arc | None:
    """Fit a circle to vertices (n, 2); None if they do not lie on a door's arc."""
    if (parabola := quarter(points, is_part=is_part)) is not None:
        return parabola
    center, radius = fit_circle(points)
    spokes = points - center
    strays = np.abs(np.hypot(*spokes.T) - radius)
    if radius == 0.0 or strays.max() > ROUNDNESS * radius:
        return None
    angles = np.unwrap(np.arctan2(spokes[:, 1], spokes[:, 0]))
    sweep = float(abs(angles[-1] - angles[0]))
    if not SWEEP[0] <= sweep <= SWEEP[1]:
        return None
    return Arc(center, radius, points[[0, -1]], points, sweep, is_part)


def quarter(points: Array, *, is_part: bool) -> Arc | None:
    """Take a quadratic curve whose control point is a corner for the quarter circle that it stands for.

    `points` (n, 2) are equal steps of its parameter. A circle through them would have its center elsewhere.
    """
    bends = np.diff(points, n=2, axis=0)
    first, last, count = points[0], points[-1], len(points) - 1
    if np.abs(bends - bends.mean(axis=0)).max() > ROUNDNESS * np.hypot(*bends.mean(axis=0)):
        return None
    corner = (first + last) / 2.0 - bends.mean(axis=0) * count**2 / 4.0
    legs = np.stack([first - corner, last - corner])
    lengths = np.hypot(*legs.T)
    if lengths.min() < (1.0 - UPRIGHT) * lengths.max() or abs(legs[0] @ legs[1]) > UPRIGHT * lengths.prod():
        return None
    return Arc(first + last - corner, float(lengths.mean()), points[[0, -1]], points, np.pi / 2.0, is_part)
