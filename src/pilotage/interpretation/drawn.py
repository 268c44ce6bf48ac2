"""What is left of a drawing once doors are taken out: where walls are looked for."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from pilotage.geometry import Polyline
from pilotage.interpretation.doors import Door
from pilotage.interpretation.floors import floor_edges
from pilotage.interpretation.paint import NOTHING, parts_of
from pilotage.interpretation.partitions import find_partitions
from pilotage.interpretation.sheet import Color
from pilotage.interpretation.solids import enclosed

GAP = 1.3
"""Openings up to this many door widths are closed to see what solids enclose."""

USUAL_GAP, WIDE_GAP = 0.04, 0.08
"""The same where no door is drawn, as shares of the drawing's diagonal: of painted walls, and of lines."""

HALVED = 3
"""So many times these are halved at most."""

WIDEST = 2.3
"""Doors that are drawn shut are up to this many door widths wide: double and sliding doors."""

USUAL_DOOR = 0.03
"""Width of a door where none is drawn, as a share of the drawing's diagonal."""

FURNISHED = 0.4
"""Things are furniture if they cover less than this share of what all lines enclose together, else rooms."""

GRAIN = 0.1
"""Their outlines are closed up to this share of a gap."""

AT_DOOR = 0.25
"""A wall is beside a door if it is this near to its hinge, as a share of its width."""


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
    loose: shapely.Geometry  # lines in a color, dashed and thin ones, likewise
    things: shapely.Geometry  # such lines around a fill without a name, and those both dashed and thin
    panels: shapely.Geometry  # what of the solid is painted thinly, in a color of its own
    glass: shapely.Geometry  # lines and areas that are named windows, or painted as such
    named: shapely.Geometry  # lines that are named walls or windows; none where no wall is named
    floors: shapely.Geometry  # areas painted in a color near to that of the ground
    doors: Sequence[Door]
    told: Sequence[Polyline]  # doors that the file itself tells
    pen: float  # width of the pen that draws the middle of all ink
    diagonal: float

    @cached_property
    def lines(self) -> shapely.Geometry:
        """All lines."""
        return put_together(self.main, self.loose, self.things)

    def may_part(self, gap: float) -> shapely.Geometry:
        """Return the lines in a color, dashed and thin ones that may part rooms: furniture does not.

        Closing wide gaps fills narrow rooms, and closing narrow ones leaves some open: the larger counts.
        """
        covered = enclosed(NOTHING, self.things, GRAIN * gap)
        is_furniture = any(
            covered < FURNISHED * enclosed(self.solid, self.lines, closed) for closed in (gap, GRAIN * gap)
        )
        return self.loose if is_furniture else put_together(self.loose, self.things)

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
        lines = put_together(self.main, self.may_part(gap), edges)
        parting = find_partitions(lines, walls, self.closing, self.door_width or gap)
        return shapely.union(parting, edges)


def put_together(*lines: shapely.Geometry) -> shapely.Geometry:
    """Put lines together as they are."""
    return shapely.multilinestrings(np.concatenate([parts_of(some) for some in lines]))
