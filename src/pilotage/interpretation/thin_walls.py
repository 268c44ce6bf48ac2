"""Walls that are single lines, beside lines in other pens."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.interpretation.drawn import USUAL_DOOR, WIDE_GAP, WIDEST, Drawn, Walls, put_together
from pilotage.interpretation.paint import NOTHING, parts_of
from pilotage.interpretation.partitions import TOUCHING, find_partitions
from pilotage.interpretation.solids import enclosed, extent
from pilotage.interpretation.windows import building

NEARLY_ALL = 0.9
"""Black lines, with the panes of windows in them, are the walls if they enclose this share of what all do."""

GLAZED = (2.0, 0.85)
"""Windows may be in a color: with gaps so many times as wide closed, too, this share of it is enough."""

LONG = 0.15
"""A line in a color or dashed that is longer than this share of the drawing's diagonal is no furniture."""

EDGE = 0.0005
"""Lines that are nearer than this share of the drawing's diagonal are one."""


def black_lines(drawn: Drawn) -> Walls | None:
    """Take black lines for walls, and of the others what parts rooms or is long; None if all are needed.

    What leads across a gap of a door's width within the building is a threshold, and parts nothing; on its
    border it is a window, if it lies there with most of its length: a shelf stands inside.
    """
    marginal = put_together(drawn.loose, drawn.things)
    if drawn.main.is_empty or marginal.is_empty:
        return None
    gap = drawn.gap(WIDE_GAP)
    everything = enclosed(NOTHING, drawn.lines, gap)
    if everything == 0.0:
        return None
    edge = EDGE * drawn.diagonal
    main = shapely.union_all(drawn.main)
    body = shapely.union_all(shapely.buffer(parts_of(main), edge))  # all at once is far slower
    others = shapely.difference(shapely.union_all(marginal), body)
    width = drawn.door_width or USUAL_DOOR * drawn.diagonal
    jamb = max(TOUCHING * width, drawn.pen)  # panes lie along the faces of a wall, or amid it
    near = shapely.buffer(body, jamb)
    lines = [part for part in parts_of(shapely.line_merge(others)) if part.geom_type == "LineString"]
    bridges = [part for part in lines if near.covers(shapely.boundary(part))]
    glazed = shapely.union_all([main, *(part for part in bridges if not part.is_closed)])
    ways = ((drawn.main, 1.0, NEARLY_ALL), (drawn.main, *GLAZED), (glazed, 1.0, NEARLY_ALL))
    if not any(
        enclosed(NOTHING, enclosing, wide * gap) >= share * everything for enclosing, wide, share in ways
    ):
        return None
    whole = shapely.difference(parts_of(drawn.may_part(gap)), body)  # as drawn: what touches a line cuts none
    apart = shapely.union_all(whole)
    parting = find_partitions(apart, body, drawn.closing, width)
    widest = max(WIDEST * width, gap)
    within = shapely.buffer(building(shapely.union_all([body, *bridges]), widest), -TOUCHING * width)
    shapely.prepare(within)
    least = LONG * drawn.diagonal
    outer = [
        part
        for part in bridges
        if not (part.is_closed or within.contains(part))
        if is_mostly(part, shapely.difference(part, within))
        or (extent(part) >= least and is_mostly(part, shapely.intersection(part, apart)))
    ]
    parting = shapely.union_all(
        [
            part
            for part in parts_of(shapely.line_merge(parting))
            if extent(part) > widest or not within.contains(part)
        ]
    )
    rest = without_islands(whole, body, edge)
    long = [part for part in parts_of(rest) if extent(part) >= least]
    beside = without_twins(outer, long, 2.0 * jamb)
    return Walls(drawn.solid, shapely.union_all([main, parting, *beside]), drawn.colors)


def named_lines(drawn: Drawn, others: Callable[[], tuple[shapely.Geometry, ...]]) -> Walls | None:
    """Take lines that are named walls or windows as black ones, and the others as if in a color.

    `others` parts these into black ones, those in a color, and outlines of things. What stands free of walls
    is none. None if there are no others, or what is named encloses less than nearly all that all lines do.
    """
    black, loose, things = others()
    if drawn.named.is_empty or (black.is_empty and loose.is_empty and things.is_empty):
        return None
    gap = drawn.gap(WIDE_GAP)
    if enclosed(NOTHING, drawn.named, gap) < NEARLY_ALL * enclosed(NOTHING, drawn.lines, gap):
        return None
    edge = EDGE * drawn.diagonal
    body = shapely.union_all(shapely.buffer(parts_of(drawn.named), edge))
    left = without_islands(parts_of(put_together(black, loose)), body, edge)
    loose = shapely.multilinestrings(parts_of(left))
    if loose.is_empty and things.is_empty:
        return Walls(drawn.solid, drawn.named, drawn.colors)
    return black_lines(replace(drawn, main=drawn.named, loose=loose, things=things))


def without_twins(
    panes: Sequence[shapely.LineString], others: Sequence[shapely.Geometry], reach: float
) -> list[shapely.Geometry]:
    """Keep one of the panes that lie side by side in an opening, and of the other lines those beside none."""
    kept: list[shapely.Geometry] = []
    strips: list[shapely.Geometry] = []
    for pane, strip in zip(panes, shapely.buffer(panes, reach), strict=True):
        if not any(other.covers(pane) for other in strips):
            kept.append(pane)
            strips.append(strip)
    around = shapely.union_all(strips)
    return [*kept, *(line for line in others if not around.covers(line))]


def is_mostly(line: shapely.Geometry, share: shapely.Geometry) -> bool:
    """Tell whether a share of a line is most of it."""
    return bool(share.length > line.length / 2.0)


def without_islands(lines: NDArray[np.object_], body: shapely.Geometry, edge: float) -> NDArray[np.object_]:
    """Leave out lines that stand free of walls and close on themselves: beds, tables and legends."""
    groups = parts_of(shapely.union_all(shapely.buffer(parts_of(lines), edge)))
    free = [group for group in groups if not group.intersects(body)]
    return np.asarray(shapely.difference(lines, shapely.union_all([one for one in free if one.interiors])))
