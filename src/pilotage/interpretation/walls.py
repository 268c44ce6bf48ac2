"""Choose what is a wall: solids and lines, or lines alone."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.interpretation.doors import Door
from pilotage.interpretation.paint import NOTHING, Seen, parts_of
from pilotage.interpretation.partitions import find_partitions
from pilotage.interpretation.sheet import Color, Role, Sheet
from pilotage.interpretation.solids import (
    HAIR,
    are_walls,
    dark_areas,
    enclosed,
    extent,
    filled_between,
    greatest_thickness,
    lightness,
    painted_thickness,
    without_crumbs,
)

GAP = 1.3
"""Openings up to this many door widths are closed to see what solids enclose."""

USUAL_GAP, WIDE_GAP = 0.04, 0.08
"""The same where no door is drawn, as shares of the drawing's diagonal: of painted walls, and of lines."""

USUAL_DOOR = 0.03
"""Width of a door where none is drawn, as a share of the drawing's diagonal."""

SLIVER = 0.21
"""Walls are thicker than this share of the thickest; a leaf that is drawn shut is not."""

NEARLY_ALL = 0.9
"""Black lines alone are the walls if they enclose this share of what all lines enclose."""

COLORFUL = 0.5
"""A line is in a color if its channels differ by this much; ink in a photo is paler."""

LONG = 0.15
"""A line in a color or dashed that is longer than this share of the drawing's diagonal is no furniture."""

EDGE = 0.0005
"""Lines that are nearer than this share of the drawing's diagonal are one."""

PALE = 0.4
"""A fill that differs less than this from the ground in lightness is a floor if it has no line around it."""


@dataclass(frozen=True, eq=False)
class Walls:
    """The walls of a plan."""

    solid: shapely.Geometry  # walls that have a thickness
    lines: shapely.Geometry | None  # thin walls beside them; None: every line that is left is a wall
    colors: frozenset[Color]  # in which walls are painted
    thickness: float | None  # of the thickest [drawing units]; None: unknown


def find_walls(
    seen: Sequence[Seen],
    sheet: Sheet,
    named: Mapping[int, Role],
    doors: Sequence[Door],
    *,
    ground: Color,
    diagonal: float,
) -> Walls:
    """Find walls among what is seen once doors are taken out."""
    fills = [
        (mark, color)
        for mark in seen
        if not mark.area.is_empty and (color := sheet.marks[mark.number].fill) is not None
    ]
    colors = dark_areas([(mark.area, color) for mark, color in fills], ground, diagonal)
    solid = shapely.union_all(
        [mark.area for mark, color in fills if color in colors or named.get(mark.number) is Role.WALL]
    )
    lines = shapely.union_all([mark.line for mark in seen if not mark.line.is_empty])
    width = float(np.median([door.width for door in doors])) if doors else None
    gap = USUAL_GAP * diagonal if width is None else GAP * width
    openings = shapely.union_all([door.opening for door in doors])
    if not solid.is_empty:
        thickness = painted_thickness(solid)
        walls = shapely.difference(filled_between(lines, solid, thickness), openings)
        body = without_slivers(solid, SLIVER * thickness)
        walls = shapely.union(walls, shapely.difference(solid, openings))
        glazed = windows(walls, body, thickness, GAP * (width or USUAL_DOOR * diagonal))
        walls = shapely.union(glazed, shapely.difference(body, openings))
        if are_walls(walls, lines, gap):
            return Walls(
                walls, find_partitions(lines, walls, doors, width or gap), frozenset(colors), thickness
            )
    if width is None:
        gap = WIDE_GAP * diagonal
    faced = greatest_thickness(lines, width, diagonal)
    if faced is not None:
        walls = shapely.difference(filled_between(lines, solid, faced), openings)
        walls = without_crumbs(walls, faced)
        if are_walls(walls, lines, gap):
            return Walls(walls, find_partitions(lines, walls, doors, width or gap), frozenset(colors), faced)
    main, marginal = by_style(seen, sheet)
    everything = 0.0 if main.is_empty or marginal.is_empty else enclosed(lines, gap)
    if everything > 0.0 and enclosed(main, gap) >= NEARLY_ALL * everything:
        body = shapely.union_all(shapely.buffer(parts_of(main), EDGE * diagonal))  # all at once is far slower
        others = shapely.difference(marginal, body)
        parting = find_partitions(others, body, doors, width or USUAL_DOOR * diagonal)
        long = [part for part in parts_of(others) if extent(part) >= LONG * diagonal]
        return Walls(solid, shapely.union_all([main, parting, *long]), frozenset(colors), None)
    return Walls(solid, None, frozenset(colors), None)


def by_style(seen: Sequence[Seen], sheet: Sheet) -> tuple[shapely.Geometry, shapely.Geometry]:
    """Part lines in black or gray from those in a color and from dashed ones."""
    main: list[shapely.Geometry] = []
    marginal: list[shapely.Geometry] = []
    for mark in seen:
        pen = sheet.marks[mark.number].pen
        if pen is not None and not mark.line.is_empty:
            is_marginal = pen.dashed or max(pen.color) - min(pen.color) >= COLORFUL
            (marginal if is_marginal else main).append(mark.line)
    return shapely.union_all(main), shapely.union_all(marginal)


def without_slivers(solid: shapely.Geometry, width: float) -> shapely.Geometry:
    """Leave out what is thinner than a width: leaves of doors that are painted like walls."""
    inner = shapely.buffer(solid, -width / 2.0, join_style="mitre")
    return shapely.intersection(shapely.buffer(inner, 0.51 * width, join_style="mitre"), solid)


def windows(
    filled: shapely.Geometry, solid: shapely.Geometry, thickness: float, widest: float
) -> shapely.Geometry:
    """Keep what leads from wall to wall, is as thin, and has a room on one side only.

    What has rooms on both sides is a door that is drawn shut, if it is not wider than any, and what stands at
    a wall is furniture.
    """
    hair = HAIR * thickness
    reach, grown = (shapely.buffer(solid, share * hair, join_style="mitre") for share in (1.0, 2.0))
    bridges = []
    for part in parts_of(shapely.difference(filled, reach)):
        if part.geom_type == "Polygon" and part.area <= thickness * part.length / 2.0:
            contact = shapely.line_merge(shapely.intersection(shapely.boundary(part), grown))
            if shapely.get_num_geometries(contact) > 1:
                bridges.append(shapely.buffer(part, 2.0 * hair, join_style="mitre"))
    rooms = [
        shapely.Polygon(ring)
        for part in parts_of(shapely.union_all([solid, *bridges]))
        if part.geom_type == "Polygon"
        for ring in part.interiors
    ]
    if not (rooms and bridges):
        return NOTHING
    owners, _ = shapely.STRtree(rooms).query(bridges, predicate="dwithin", distance=hair)
    beside = np.bincount(owners, minlength=len(bridges))
    return shapely.union_all(
        [part for part, count in zip(bridges, beside, strict=True) if count < 2 or extent(part) > widest]
    )


def is_floor(color: Color, ground: Color) -> bool:
    """Tell whether a fill without a line is the color of a floor."""
    return abs(lightness(color) - lightness(ground)) < PALE


def rings_of(solid: shapely.Geometry) -> list[shapely.LinearRing]:
    """List the outlines of solids, holes too."""
    parts = [part for part in parts_of(solid) if part.geom_type == "Polygon"] if solid is not NOTHING else []
    return [ring for part in parts for ring in (part.exterior, *part.interiors)]
