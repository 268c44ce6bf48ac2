"""Walls that have a thickness: painted, or with two faces."""

from dataclasses import replace

import shapely

from pilotage.interpretation.drawn import USUAL_DOOR, USUAL_GAP, WIDE_GAP, WIDEST, Drawn, Walls
from pilotage.interpretation.hatching import shut_doors
from pilotage.interpretation.solids import (
    ENCLOSING,
    are_walls,
    filled_between,
    greatest_thickness,
    painted_thickness,
    without_crumbs,
)
from pilotage.interpretation.windows import painted_glass, panes, windows, without_slivers

HOLDING = 0.75
"""What is named wall is all walls if so many of the doors stand in it, as a share."""

SLIVER = 0.21
"""Walls are thicker than this share of the thickest; a leaf that is drawn shut is not."""

SHUT = 0.25
"""What is drawn in place of a door is thicker than what it encloses by this share of a wall's thickness."""

FACED = 0.5
"""Where no door is drawn, two faces are of walls if these enclose this share of what all lines do, not of a
corridor."""

NAMED = 0.5
"""Two faces are of a frame and of no walls if these leave out more than this share of what is named wall."""


def named_walls(drawn: Drawn) -> Walls | None:
    """Fill what lies between two faces that are named walls; None if few doors stand in them."""
    thickness = greatest_thickness(drawn.named, drawn.door_width, drawn.diagonal)
    if drawn.named.is_empty or thickness is None:
        return None
    filled = filled_between(drawn.named, drawn.solid, thickness)
    return painted_walls(replace(drawn, solid=filled)) if drawn.share_of_doors(filled) >= HOLDING else None


def painted_walls(drawn: Drawn) -> Walls | None:
    """Take dark areas for walls, and add windows; None if they do not enclose the rooms."""
    if drawn.solid.is_empty:
        return None
    gap = drawn.gap(USUAL_GAP)
    thickness = painted_thickness(drawn.solid)
    body = without_slivers(drawn.solid, SLIVER * thickness)
    filled = shapely.union(filled_between(drawn.lines, drawn.solid, thickness), drawn.solid)
    thick = shapely.difference(body, drawn.panels)
    between = shapely.difference(filled, drawn.openings)
    glazed, shut = windows(between, thick, drawn.glass, thickness, drawn.widest)
    paned = panes(drawn.lines, thick, thickness, drawn.widest)
    open_ = shapely.union_all([drawn.openings, shapely.intersection(shut, drawn.panels)])
    over = painted_glass(drawn.glass, thick, thickness)
    walls = shapely.union_all([glazed, paned, over, shapely.difference(body, open_)])
    if not are_walls(walls, drawn.lines, gap):
        return None
    return Walls(walls, drawn.thin_beside(walls, gap, thickness), drawn.colors)


def faced_walls(drawn: Drawn) -> Walls | None:
    """Fill what lies between two faces of a wall; None if that does not enclose the rooms."""
    gap = drawn.gap(WIDE_GAP)
    thickness = greatest_thickness(drawn.lines, drawn.door_width, drawn.diagonal)
    if thickness is None:
        return None
    filled = filled_between(drawn.lines, drawn.solid, thickness)
    walls = without_crumbs(shapely.difference(filled, drawn.openings), thickness)
    if not are_walls(
        shapely.union(walls, drawn.openings),
        drawn.lines,
        gap,
        FACED if drawn.door_width is None else ENCLOSING,
    ) or leaves_out(walls, drawn.named, thickness):
        return None
    shut = shut_doors(drawn.lines, walls, thickness, max(drawn.widest, WIDEST * USUAL_DOOR * drawn.diagonal))
    cut = shapely.buffer(shut, SHUT * thickness, join_style="mitre")
    drawn = replace(drawn, main=shapely.difference(drawn.main, cut))
    walls = shapely.difference(walls, cut)
    return Walls(walls, drawn.thin_beside(walls, gap, thickness), drawn.colors, shut)


def leaves_out(walls: shapely.Geometry, named: shapely.Geometry, thickness: float) -> bool:
    """Tell whether most of the lines that are named walls lie elsewhere."""
    left = shapely.difference(named, shapely.buffer(walls, SLIVER * thickness))
    return float(left.length) > NAMED * float(named.length)
