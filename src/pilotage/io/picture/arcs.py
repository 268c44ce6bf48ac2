"""Find the arcs of doors in traced lines, and the leaf that each belongs to."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, fit_circle

CORNER = np.deg2rad(48.0)
"""A line that turns by more than this within a few pixels [rad] has a corner; no door is so tight."""

LOOK = 1.6
"""Directions are taken over this many widths of the pen, and over LEAST_LOOK pixels."""

LEAST_LOOK = 5

SWEEP = np.deg2rad([55.0, 125.0])
"""An arc of a door covers so much of a circle [rad]."""

BOW = 3.0
"""The middle of an arc lies at least so many pixels off its chord: less is a crooked line."""

ROUND = 0.04
"""No pixel of an arc lies farther from its circle than this share of the radius, and half the pen's width."""

TRIMS = (0.0, 0.12, 0.25)
"""A line may run into an arc and out of it: these shares of its ends are left off in turn."""

OPEN = np.deg2rad(97.0)
"""A door is drawn open by no more than this [rad]; an arc may stop at the side of its leaf."""

SWING = np.deg2rad(12.0)
"""A leaf may lie so far within the end of its arc [rad]: hands are not exact."""

LEAF = 0.75
"""A leaf is ink along so much of its length."""

THICK = 0.06
"""A leaf may lie beside its spoke by this share of its length: it is drawn with two lines."""

CHORDS = 9
"""An arc is drawn with so many chords."""


@dataclass(frozen=True, slots=True)
class Arc:
    """A part of a circle in a picture, y down."""

    center: tuple[float, float]  # [pixels]
    radius: float  # [pixels]
    first: float  # angle of one end [rad]
    last: float  # angle of the other [rad]
    has_leaf: bool = False  # whether there is a leaf from its center to its last end

    def at(self, angles: Array) -> Array:
        """Return points on the circle, (n, 2)."""
        return np.asarray(self.center + self.radius * np.column_stack([np.cos(angles), np.sin(angles)]))

    @property
    def lines(self) -> list[Array]:
        """The arc and its leaf as lines (n, 2)."""
        arc = self.at(np.linspace(self.first, self.last, CHORDS + 1))
        return [arc, np.array([self.center, arc[-1]])] if self.has_leaf else [arc]


def part_arcs(run: Array, pen_width: float, radii: tuple[float, float]) -> tuple[list[Array], list[Arc]]:
    """Cut a run of pixels (n, 2) at its corners if a part is an arc of a radius between two [pixels].

    Returns what is no arc, as runs, and the arcs.
    """
    rest: list[Array] = []
    arcs: list[Arc] = []
    for piece in split_at_corners(run, max(LEAST_LOOK, round(LOOK * pen_width))):
        found = find_arc(piece, pen_width, radii)
        if found is None:
            rest.append(piece)
            continue
        arc, begin, end = found
        arcs.append(arc)
        rest += [part for part in (piece[: begin + 1], piece[end - 1 :]) if len(part) > LEAST_LOOK]
    return (rest, arcs) if arcs else ([run], [])


def split_at_corners(run: Array, look: int) -> list[Array]:
    """Cut a run of pixels where it turns sharply; the parts share the corner."""
    if len(run) < 2 * look + 1:
        return [run]
    back = run[look:-look] - run[: -2 * look]
    ahead = run[2 * look :] - run[look:-look]
    cross = back[:, 0] * ahead[:, 1] - back[:, 1] * ahead[:, 0]
    turns = np.abs(np.arctan2(cross, (back * ahead).sum(axis=1)))
    cuts: list[int] = []
    while turns.max(initial=0.0) > CORNER:
        sharpest = int(turns.argmax())
        cuts.append(sharpest + look)
        turns[max(0, sharpest - look) : sharpest + look + 1] = 0.0
    bounds = [0, *sorted(cuts), len(run) - 1]
    return [run[first : last + 1] for first, last in pairwise(bounds)]


def find_arc(piece: Array, pen_width: float, radii: tuple[float, float]) -> tuple[Arc, int, int] | None:
    """Find the longest arc in pixels (n, 2), all but their ends; with where it begins and ends."""
    chord = piece[-1] - piece[0]
    beside = np.abs((piece - piece[0]) @ (-chord[1], chord[0])).max(initial=0.0)
    if beside < BOW * float(np.hypot(*chord)) or len(piece) < 2 * LEAST_LOOK:
        return None
    for left in sorted((a + b, a, b) for a in TRIMS for b in TRIMS):
        begin, end = round(left[1] * len(piece)), len(piece) - round(left[2] * len(piece))
        arc = fit_arc(piece[begin:end], pen_width, radii)
        if arc is not None:
            return arc, begin, end
    return None


def fit_arc(pixels: Array, pen_width: float, radii: tuple[float, float]) -> Arc | None:
    """Fit a circle to pixels (n, 2); None if they are not the arc of a door."""
    center, radius = fit_circle(pixels)
    spokes = pixels - center
    angles = np.unwrap(np.arctan2(spokes[:, 1], spokes[:, 0]))
    sweep = abs(float(angles[-1] - angles[0]))
    strays = np.abs(np.hypot(*spokes.T) - radius)
    if (
        not radii[0] <= radius <= radii[1]
        or not SWEEP[0] <= sweep <= SWEEP[1]
        or radius * (1.0 - np.cos(sweep / 2.0)) < BOW
        or strays.max() > ROUND * radius + pen_width / 2.0
    ):
        return None
    x, y = center.tolist()
    return Arc((x, y), radius, float(angles[0]), float(angles[-1]))


def with_leaf(arc: Arc, ink: NDArray[np.bool_]) -> Arc:
    """Find the leaf of an arc in ink (height, width), and let the arc end at it."""
    sweep = arc.last - arc.first
    turns = np.sign(sweep) * np.linspace(-SWING, max(OPEN - abs(sweep), 0.0), 24)
    ends = np.concatenate([arc.last + turns, arc.first - turns])
    shares = ink_along(arc, ends, ink)
    best = int(shares.argmax())
    if shares[best] < LEAF:
        return arc
    first = arc.first if best < len(turns) else arc.last
    return replace(arc, first=first, last=float(ends[best]), has_leaf=True)


def ink_along(arc: Arc, angles: Array, ink: NDArray[np.bool_]) -> Array:
    """Measure how much of the spokes at some angles is ink, on them or a little to a side, 0 to 1, (n,)."""
    along = np.linspace(0.15, 0.9, 40) * arc.radius
    sides = np.linspace(-1.0, 1.0, 5)[:, np.newaxis] * max(1.0, THICK * arc.radius)
    cos, sin = np.cos(angles)[:, np.newaxis, np.newaxis], np.sin(angles)[:, np.newaxis, np.newaxis]
    columns = np.floor(arc.center[0] + along * cos - sides * sin).astype(np.int64)
    rows = np.floor(arc.center[1] + along * sin + sides * cos).astype(np.int64)
    inside = (rows >= 0) & (rows < ink.shape[0]) & (columns >= 0) & (columns < ink.shape[1])
    inked = inside & ink[np.where(inside, rows, 0), np.where(inside, columns, 0)]
    return np.asarray(inked.mean(axis=2).max(axis=1))
