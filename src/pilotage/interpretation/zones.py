"""Zones that a person drew for the robot: areas by their outline, arrows by their longest line."""

from collections.abc import Iterator, Sequence

import numpy as np

from pilotage.geometry import Polyline
from pilotage.interpretation.sheet import Mark, Role, Sheet
from pilotage.maps import Zones

ZONE_ROLES = (Role.KEEP_OUT, Role.SLOW, Role.ONE_WAY)
"""The roles of the kinds of zones, in the order of `Zones.lines`."""


def find_zones(sheet: Sheet, told: Sequence[tuple[Role, str] | None]) -> Zones:
    """Gather keep-out and slow areas, and one-way arrows; `told` is the role that a person gave each mark."""
    roles = [(mark, role[0]) for mark, role in zip(sheet.marks, told, strict=True) if role is not None]
    return Zones(
        tuple(ring for mark, role in roles if role is Role.KEEP_OUT for ring in rings_of(mark)),
        tuple(ring for mark, role in roles if role is Role.SLOW for ring in rings_of(mark)),
        tuple(longest_of(mark) for mark, role in roles if role is Role.ONE_WAY),
    )


def rings_of(mark: Mark) -> Iterator[Polyline]:
    """Close the outlines of a mark; a line of two points encloses nothing."""
    for outline in mark.outlines:
        if len(outline.vertices) >= 3:
            yield Polyline(outline.vertices, closed=True)


def longest_of(mark: Mark) -> Polyline:
    """Return the longest outline of a mark: the shaft of an arrow, not its head."""
    return max(mark.outlines, key=lambda one: float(np.hypot(*np.diff(one.vertices, axis=0).T).sum()))
