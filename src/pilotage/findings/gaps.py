"""Gaps that may or may not be doors."""

from collections.abc import Iterator

import numpy as np
import shapely

from pilotage.findings.doors import cut
from pilotage.findings.finding import Finding, Mend, MendKind, Severity, length_in_words, pair
from pilotage.geometry import Array
from pilotage.maps import CellGraph, Division, SchematicMap
from pilotage.maps.routing.forgotten_doors import door_width

NARROW = 0.4
"""A gap of less than this share of the usual door is a slip of the pen, an opening of less is no door."""

SLIP = 0.12
"""Into a room that has no door, a gap of this share of the usual door may be meant as one."""

STEP = 0.6
"""How far beside a gap the rooms are looked for, as a share of the usual door."""

ENOUGH = 3
"""So many gateways tell what width is usual."""


def find_closed_gaps(division: Division) -> Iterator[Finding]:
    """Find gaps between two rooms that were closed because they are narrow, and still wide for a slip."""
    graph, usual = division.graph, door_width(division.graph)
    joined = {frozenset(gateway.cell_ids) for gateway in graph.gateways}
    for gap in division.space.gaps:
        width = float(np.hypot(*(gap[1] - gap[0])))
        rooms = rooms_beside(graph, gap, STEP * usual)
        if len(rooms) < 2 or frozenset(rooms) in joined:
            continue
        is_needed = not all(graph.gateways_of(room) for room in rooms)
        if width < (SLIP if is_needed else NARROW) * usual:
            continue
        joined.add(frozenset(rooms))
        x, y = gap.mean(axis=0).tolist()
        yield Finding(
            "closed-gap",
            Severity.WARNING if is_needed else Severity.NOTE,
            f"a gap of {length_in_words(width)} between {rooms[0]} and {rooms[1]} counts as closed",
            f"it is so narrow: if it is a door, widen it to {length_in_words(usual)}",
            (x, y),
            rooms,
            cut(gap, usual),
        )


def find_odd_gateways(graph: CellGraph) -> Iterator[Finding]:
    """Find gateways that are far narrower than the others."""
    if len(graph.gateways) < ENOUGH:
        return
    usual = door_width(graph)
    for gateway in graph.gateways:
        if gateway.width < NARROW * usual:
            x, y = gateway.middle.tolist()
            (ax, ay), (bx, by) = gateway.segment.tolist()
            first, second = gateway.cell_ids
            yield Finding(
                "narrow-gateway",
                Severity.NOTE,
                f"the gap of {length_in_words(gateway.width)} between {first} and {second} counts as a door,"
                f" though others are {length_in_words(usual)} wide",
                "if it is none, close it",
                (x, y),
                gateway.cell_ids,
                Mend(MendKind.CLOSE, ((ax, ay), (bx, by)), "close this gap?"),
            )


def find_idle_arrows(sketch: SchematicMap, graph: CellGraph) -> Iterator[Finding]:
    """Find one-way arrows that cross no gateway: they change nothing."""
    openings = shapely.union_all([shapely.linestrings(gateway.segment) for gateway in graph.gateways])
    for arrow in sketch.zones.one_way:
        if not openings.intersects(shapely.linestrings(arrow.vertices)):
            yield Finding(
                "idle-arrow",
                Severity.WARNING,
                "a one-way arrow crosses no door",
                "draw it across the door, from the room before it into the room behind it",
                pair(arrow.vertices[0]),
            )


def rooms_beside(graph: CellGraph, gap: Array, step: float) -> tuple[str, ...]:
    """Name the cells on both sides of a gap (2, 2), in order; fewer than two if there are fewer."""
    along = gap[1] - gap[0]
    across = np.array([-along[1], along[0]]) / max(float(np.hypot(*along)), 1e-300) * step
    sides = shapely.points([gap.mean(axis=0) + across, gap.mean(axis=0) - across])
    found = {cell.cell_id for cell in graph.cells if shapely.intersects(cell.polygon, sides).any()}
    return tuple(sorted(found))
