"""Choose what is a wall: solids and lines, or lines alone."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain

import numpy as np
import shapely

from pilotage.geometry import Polyline
from pilotage.interpretation.doors import Door
from pilotage.interpretation.floors import floor_edges
from pilotage.interpretation.hatching import shut_doors
from pilotage.interpretation.paint import NOTHING, Seen, parts_of
from pilotage.interpretation.partitions import TOUCHING, find_partitions
from pilotage.interpretation.pens import THIN, by_style
from pilotage.interpretation.sheet import Color, Role, Sheet
from pilotage.interpretation.solids import (
    ENCLOSING,
    are_walls,
    dark_areas,
    enclosed,
    extent,
    filled_between,
    greatest_thickness,
    painted_thickness,
    without_crumbs,
)
from pilotage.interpretation.windows import (
    building,
    is_glass,
    painted_glass,
    panes,
    windows,
    without_slivers,
)

GAP = 1.3
"""Openings up to this many door widths are closed to see what solids enclose."""

WIDEST = 2.3
"""Doors that are drawn shut are up to this many door widths wide: double and sliding doors."""

USUAL_GAP, WIDE_GAP = 0.04, 0.08
"""The same where no door is drawn, as shares of the drawing's diagonal: of painted walls, and of lines."""

HALVED = 3
"""So many times these are halved at most."""

USUAL_DOOR = 0.03
"""Width of a door where none is drawn, as a share of the drawing's diagonal."""

NEARLY_ALL = 0.9
"""Black lines, with the panes of windows in them, are the walls if they enclose this share of what all do."""

SHUT = 0.25
"""What is drawn in place of a door is thicker than what it encloses by this share of a wall's thickness."""

GLAZED = (2.0, 0.85)
"""Windows may be in a color: with gaps so many times as wide closed, too, this share of it is enough."""

HOLDING = 0.75
"""What is named wall is all walls if so many of the doors stand in it, as a share."""

AT_DOOR = 0.25
"""A wall is beside a door if it is this near to its hinge, as a share of its width."""

LONG = 0.15
"""A line in a color or dashed that is longer than this share of the drawing's diagonal is no furniture."""

EDGE = 0.0005
"""Lines that are nearer than this share of the drawing's diagonal are one."""

SLIVER = 0.21
"""Walls are thicker than this share of the thickest; a leaf that is drawn shut is not."""

FACED = 0.5
"""Where no door is drawn, two faces are of walls if these enclose this share of what all lines do, not of a
corridor."""


@dataclass(frozen=True, eq=False)
class Walls:
    """The walls of a plan."""

    solid: shapely.Geometry  # walls that have a thickness
    lines: shapely.Geometry | None  # thin walls beside them; None: every line that is left is a wall
    colors: frozenset[Color]  # in which walls are painted
    shut: shapely.Geometry = NOTHING  # openings that are drawn shut


@dataclass(frozen=True, eq=False)
class Drawn:
    """What is left of a drawing once doors are taken out; lengths in drawing units."""

    solid: shapely.Geometry  # areas in the colors of walls
    colors: frozenset[Color]
    main: shapely.Geometry  # lines in black or gray, as they were drawn: they may cross and overlap
    marginal: shapely.Geometry  # lines in a color, dashed and thin ones, likewise
    panels: shapely.Geometry  # what of the solid is painted thinly, in a color of its own
    glass: shapely.Geometry  # lines and areas that are named windows, or painted as such
    named: shapely.Geometry  # lines that are named walls or windows; none where no wall is named
    floors: shapely.Geometry  # areas painted in a color near to that of the ground
    doors: Sequence[Door]
    told: Sequence[Polyline]  # doors that the file itself tells
    diagonal: float

    @cached_property
    def lines(self) -> shapely.Geometry:
        """All lines."""
        return shapely.multilinestrings(np.concatenate([parts_of(self.main), parts_of(self.marginal)]))

    @cached_property
    def openings(self) -> shapely.Geometry:
        """What doors cut out of walls."""
        return shapely.union_all([door.opening for door in self.doors])

    @cached_property
    def door_width(self) -> float | None:
        """Median over the doors; None if none is drawn."""
        return float(np.median([door.width for door in self.doors])) if self.doors else None

    def gap(self, usual: float) -> float:
        """Width of the openings to close: by the doors, else a usual share of the diagonal.

        A building may be small on a large sheet: the share is halved until anything is enclosed.
        """
        if self.door_width is not None:
            return GAP * self.door_width
        gaps = [usual * self.diagonal / 2.0**halved for halved in range(HALVED + 1)]
        return next((gap for gap in gaps[:-1] if enclosed(self.solid, self.lines, gap) > 0.0), gaps[-1])

    @cached_property
    def closing(self) -> list[shapely.LineString]:
        """All doors, from jamb to jamb."""
        told = [shapely.LineString(door.vertices) for door in self.told]
        return [shapely.LineString([door.hinge, door.latch]) for door in self.doors] + told

    @property
    def widest(self) -> float:
        """Width of the widest doors."""
        return WIDEST * (self.door_width or USUAL_DOOR * self.diagonal)

    def share_of_doors(self, walls: shapely.Geometry) -> float:
        """Tell how many of the doors have a wall at their hinge, as a share; none if there are no doors."""
        if not self.doors:
            return 0.0
        hinges = shapely.points([door.hinge for door in self.doors])
        reach = np.array([AT_DOOR * door.width for door in self.doors])
        return float((shapely.distance(hinges, walls) <= reach).mean())

    def thin_beside(self, walls: shapely.Geometry, gap: float, thickness: float) -> shapely.Geometry:
        """Return the lines beside walls that part rooms, and the edges of floors that walls leave open."""
        edges = floor_edges(self.floors, walls, thickness, gap)
        lines = shapely.multilinestrings(np.concatenate([parts_of(self.lines), parts_of(edges)]))
        parting = find_partitions(lines, walls, self.closing, self.door_width or gap)
        return shapely.union(parting, edges)


def find_walls(
    seen: Sequence[Seen],
    sheet: Sheet,
    named: Mapping[int, Role],
    doors: Sequence[Door],
    *,
    floors: shapely.Geometry = NOTHING,
    ground: Color,
    diagonal: float,
) -> Walls:
    """Find walls among what is seen once doors are taken out.

    Walls are painted, or have two faces, or are black lines: the first of these that encloses the rooms.
    """
    fills = [
        (mark, color)
        for mark in seen
        if not mark.area.is_empty and (color := sheet.marks[mark.number].fill) is not None
    ]
    colors, thin = dark_areas([(mark.area, color) for mark, color in fills], ground, diagonal)
    solid = shapely.union_all(
        [mark.area for mark, color in fills if color in colors or named.get(mark.number) is Role.WALL]
    )
    panels = shapely.union_all([mark.area for mark, color in fills if color in thin])
    panes = [mark for mark in seen if named.get(mark.number) is Role.WINDOW]
    blue = [
        mark.area
        for mark, color in fills
        if color not in colors and mark.line.is_empty and is_glass(mark.area, color)
    ]
    glass = shapely.union_all([*(shape for mark in panes for shape in (mark.line, mark.area)), *blue])
    called = shapely.union_all([mark.line for mark in seen if named.get(mark.number) is Role.WALL])
    called = called if called.is_empty else shapely.union(called, shapely.union_all([p.line for p in panes]))
    styles = (by_style(seen, sheet, named, solid, diagonal, share=share) for share in THIN)
    drawn = Drawn(
        solid,
        frozenset(colors),
        *next(styles),
        panels,
        glass,
        called,
        floors,
        doors,
        sheet.openings,
        diagonal,
    )
    tried = chain(
        (way(drawn) for way in (named_walls, painted_walls, faced_walls, black_lines)),
        (black_lines(replace(drawn, main=main, marginal=marginal)) for main, marginal in styles),
    )
    return next((walls for walls in tried if walls is not None), Walls(solid, None, drawn.colors))


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
    ):
        return None
    shut = shut_doors(drawn.lines, walls, thickness, max(drawn.widest, WIDEST * USUAL_DOOR * drawn.diagonal))
    cut = shapely.buffer(shut, SHUT * thickness, join_style="mitre")
    drawn = replace(drawn, main=shapely.difference(drawn.main, cut))
    walls = shapely.difference(walls, cut)
    return Walls(walls, drawn.thin_beside(walls, gap, thickness), drawn.colors, shut)


def black_lines(drawn: Drawn) -> Walls | None:
    """Take black lines for walls, and of the others what parts rooms or is long; None if all are needed.

    What leads across a gap of a door's width within the building is a threshold, and parts nothing; on its
    border it is a window.
    """
    if drawn.main.is_empty or drawn.marginal.is_empty:
        return None
    gap = drawn.gap(WIDE_GAP)
    everything = enclosed(NOTHING, drawn.lines, gap)
    if everything == 0.0:
        return None
    edge = EDGE * drawn.diagonal
    main = shapely.union_all(drawn.main)
    body = shapely.union_all(shapely.buffer(parts_of(main), edge))  # all at once is far slower
    others = shapely.difference(shapely.union_all(drawn.marginal), body)
    width = drawn.door_width or USUAL_DOOR * drawn.diagonal
    near = shapely.buffer(body, TOUCHING * width)
    lines = [part for part in parts_of(shapely.line_merge(others)) if part.geom_type == "LineString"]
    bridges = [part for part in lines if near.covers(shapely.boundary(part))]
    glazed = shapely.union_all([main, *(part for part in bridges if not part.is_closed)])
    ways = ((drawn.main, 1.0, NEARLY_ALL), (drawn.main, *GLAZED), (glazed, 1.0, NEARLY_ALL))
    if not any(
        enclosed(NOTHING, enclosing, wide * gap) >= share * everything for enclosing, wide, share in ways
    ):
        return None
    parting = find_partitions(others, body, drawn.closing, width)
    widest = max(WIDEST * width, gap)
    within = shapely.buffer(building(shapely.union_all([body, *bridges]), widest), -TOUCHING * width)
    shapely.prepare(within)
    outer = [part for part in bridges if not part.is_closed and not within.contains(part)]
    parting = shapely.union_all(
        [
            part
            for part in parts_of(shapely.line_merge(parting))
            if extent(part) > widest or not within.contains(part)
        ]
    )
    rest = without_islands(others, body, within, edge)
    long = [part for part in parts_of(rest) if extent(part) >= LONG * drawn.diagonal]
    return Walls(drawn.solid, shapely.union_all([main, parting, *outer, *long]), drawn.colors)


def without_islands(
    lines: shapely.Geometry, body: shapely.Geometry, within: shapely.Geometry, edge: float
) -> shapely.Geometry:
    """Leave out lines that stand free within a building and close on themselves: beds and tables."""
    groups = parts_of(shapely.union_all(shapely.buffer(parts_of(lines), edge)))
    free = [group for group in groups if within.contains(group) and not group.intersects(body)]
    return shapely.difference(lines, shapely.union_all([group for group in free if group.interiors]))


def opened_shut(shut: shapely.Geometry) -> tuple[Polyline, ...]:
    """Return the openings that are drawn shut, from jamb to jamb."""
    boxes = [shapely.get_coordinates(shapely.oriented_envelope(part)) for part in parts_of(shut)]
    doors = []
    for box in boxes:
        if len(box) == 5:
            middles = (box[:-1] + box[1:]) / 2.0  # of the sides
            across = np.hypot(*(middles[:2] - middles[2:]).T)
            doors.append(Polyline(middles[0::2] if across[0] > across[1] else middles[1::2]))
    return tuple(doors)


def rings_of(solid: shapely.Geometry) -> list[shapely.LinearRing]:
    """List the outlines of solids, and holes the other way round."""
    parts = [part for part in parts_of(solid) if part.geom_type == "Polygon"] if solid is not NOTHING else []
    return [ring for part in shapely.orient_polygons(parts) for ring in (part.exterior, *part.interiors)]
