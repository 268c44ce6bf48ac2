"""Join traced lines that go on straight across a fork or a small gap of the pen."""

import numpy as np

from pilotage.geometry import Array

REACH = 1.2
"""Ends up to so many widths of the pen apart may be one line."""

STRAIGHT = np.deg2rad(25.0)
"""A line that goes on turns by at most this [rad]."""

LOOK_BACK = 4.0
"""The direction of an end is that of its last so many widths of the pen."""


def join_straight(lines: list[Array], pen_width: float) -> list[Array]:
    """Join lines (n, 2) end to end where they go on, the straightest first; all vertices stay."""
    from scipy.spatial import cKDTree

    if len(lines) < 2:
        return lines
    oriented = [side for line in lines for side in (line[::-1], line)]  # end 2 i + 1 is the last of line i
    ends = np.array([line[-1] for line in oriented])
    directions = np.array([direction_of(line, LOOK_BACK * pen_width) for line in oriented])
    pairs = cKDTree(ends).query_pairs(REACH * pen_width, output_type="ndarray")
    pairs = pairs[pairs[:, 0] // 2 != pairs[:, 1] // 2]
    turns = turns_between(ends, directions, pairs)
    partner: dict[int, int] = {}
    for index in np.lexsort((pairs[:, 1], pairs[:, 0], turns)):
        one, other = pairs[index].tolist()
        if turns[index] <= STRAIGHT and one not in partner and other not in partner:
            partner[one], partner[other] = other, one
    return chains(oriented, partner)


def direction_of(line: Array, length: float) -> Array:
    """Return the unit direction in which a line (n, 2) ends, (2,)."""
    away = np.hypot(*(line - line[-1]).T)
    before = line[max(int(np.argmax(away[::-1] >= min(length, away.max()))), 1) * -1 - 1]
    step = line[-1] - before
    return np.asarray(step / max(float(np.hypot(*step)), 1e-9))


def turns_between(ends: Array, directions: Array, pairs: Array) -> Array:
    """Measure how much each pair of ends (n, 2) turns, over the gap, too, (n,) [rad]."""
    one, other = pairs.T
    gap = ends[other] - ends[one]
    width = np.hypot(*gap.T)
    turn = angle(directions[one], -directions[other])
    over_gap = angle(directions[one], gap) + angle(gap, -directions[other])
    return np.where(width > 1.5, np.maximum(turn, over_gap / 2.0), turn)


def angle(one: Array, other: Array) -> Array:
    """Measure between directions (n, 2) and others, (n,) [rad]."""
    cross = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    return np.asarray(np.abs(np.arctan2(cross, (one * other).sum(axis=1))))


def chains(oriented: list[Array], partner: dict[int, int]) -> list[Array]:
    """Follow partners from line to line; end 2 i and 2 i + 1 are those of line i."""
    joined = []
    left = set(range(len(oriented) // 2))
    starts = [end for end in range(len(oriented)) if end not in partner]
    for start in [*starts, *range(0, len(oriented), 2)]:  # rings have no end to begin at
        if start // 2 not in left:
            continue
        parts, end = [], start
        while end // 2 in left:
            left.remove(end // 2)
            parts.append(oriented[end ^ 1])  # from this end to the other
            end = partner.get(end ^ 1, -1)
            if end < 0:
                break
        ring = end >= 0 and end == start
        points = np.vstack([*parts, parts[0][:1]] if ring else parts)
        joined.append(without_repeats(points))
    return joined


def without_repeats(points: Array) -> Array:
    """Drop points (n, 2) that repeat the one before."""
    moved = np.any(np.diff(points, axis=0) != 0.0, axis=1)
    return np.asarray(points[np.concatenate([[True], moved])])
