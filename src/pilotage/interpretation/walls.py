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
    are_walls,
    dark_areas,
    filled_between,
    greatest_thickness,
    lightness,
    painted_thickness,
    without_crumbs,
)

GAP = 1.3
"""Openings up to this many door widths are closed to see what solids enclose."""

USUAL_GAP = 0.08
"""The same where no door is drawn, as a share of the drawing's diagonal."""

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
        walls = touching(walls, solid)
        if are_walls(walls, lines, gap):
            return Walls(
                walls, find_partitions(lines, walls, doors, width or gap), frozenset(colors), thickness
            )
    faced = greatest_thickness(lines, width, diagonal)
    if faced is not None:
        walls = shapely.difference(filled_between(lines, solid, faced), openings)
        walls = without_crumbs(walls, faced)
        if are_walls(walls, lines, gap):
            return Walls(walls, find_partitions(lines, walls, doors, width or gap), frozenset(colors), faced)
    return Walls(solid, None, frozenset(colors), None)


def touching(filled: shapely.Geometry, solid: shapely.Geometry) -> shapely.Geometry:
    """Keep what hangs together with solids: windows between walls, and no furniture."""
    parts = parts_of(filled)
    return shapely.union_all(parts[shapely.intersects(parts, solid)])


def is_floor(color: Color, ground: Color) -> bool:
    """Tell whether a fill without a line is the color of a floor."""
    return abs(lightness(color) - lightness(ground)) < PALE


def rings_of(solid: shapely.Geometry) -> list[shapely.LinearRing]:
    """List the outlines of solids, holes too."""
    parts = [part for part in parts_of(solid) if part.geom_type == "Polygon"] if solid is not NOTHING else []
    return [ring for part in parts for ring in (part.exterior, *part.interiors)]
