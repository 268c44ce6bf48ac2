"""What the visible marks of a sheet are: one kind of mark after the other is found and taken out."""

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass

import shapely

from pilotage.interpretation.areas import find_areas
from pilotage.interpretation.aside import Aside, set_aside
from pilotage.interpretation.dashed import find_dashed
from pilotage.interpretation.doors import find_doors
from pilotage.interpretation.drawn import Walls
from pilotage.interpretation.ends import led_on
from pilotage.interpretation.floors import find_floors
from pilotage.interpretation.openings import Openings, find_openings
from pilotage.interpretation.paint import Seen
from pilotage.interpretation.patches import opened_through
from pilotage.interpretation.sheet import Mark, Role
from pilotage.interpretation.stairs import find_stairs
from pilotage.interpretation.view import View
from pilotage.interpretation.walls import find_walls
from pilotage.interpretation.windows import on_single_walls

NO_WALLS = (Role.DOOR, Role.STAIRS, Role.FURNITURE, Role.LABEL, Role.IGNORE)
"""What a name makes one of these is no wall; windows close rooms as walls do, stairs by their outline."""

NO_DOORS = (Role.FURNITURE, Role.LABEL, Role.IGNORE)
"""Arcs of these are of cupboards and trees."""


@dataclass(frozen=True, eq=False)
class Parts:
    """What was found among the visible marks; numbers are those of the sheet."""

    aside: Aside
    areas: AbstractSet[int]  # outlines of rooms, along their walls
    built: Sequence[Seen]  # marks that are none of these
    openings: Openings
    dashed: AbstractSet[int]  # dashed lines from wall to wall
    left: Sequence[Seen]  # `built` without openings
    lines: Sequence[Seen]  # of these, what may be a wall
    walls: Walls
    stairs: shapely.Geometry


def take_apart(view: View) -> Parts:
    """Find what explains the plan, openings and stairs among the visible marks, and walls in what is left."""
    sheet, ground, diagonal = view.sheet, view.paper.ground, view.diagonal
    aside, built = set_aside(view, view.all_but(NO_DOORS, view.visible))
    doors = find_doors(sheet, built, diagonal)
    areas = set() if doors else find_areas(sheet, view.called, diagonal)  # a leaf opens these, too
    named = {number for number, role in view.called.items() if role is not None and role[0] is Role.DOOR}
    built = opened_through(sheet, built, named, ground)
    built = led_on(sheet, [mark for mark in built if mark.number not in areas], diagonal)
    openings, left = find_openings(view, built, doors)
    sides = {bridge.number for bridge in openings.bridges}
    lines = [mark for mark in left if mark.number in sides or view.role(mark) not in NO_WALLS]
    dashed = find_dashed(sheet, lines, view.guessed, diagonal)
    lines = on_single_walls([mark for mark in lines if mark.number not in dashed], view.guessed, diagonal)
    walls = find_walls(
        lines,
        sheet,
        {number: role for number, (role, _) in view.guessed.items()},
        doors,
        floors=find_floors(may_be_floors(view), ground),
        ground=ground,
        diagonal=diagonal,
    )
    stairs = find_stairs([mark for mark in left if view.role(mark) is Role.STAIRS], sheet, diagonal)
    return Parts(aside, areas, built, openings, dashed, left, lines, walls, stairs)


def may_be_floors(view: View) -> list[Mark]:
    """List the marks that a name makes nothing else than a wall, faint ones too: a floor may be one."""
    return [
        view.sheet.marks[number]
        for number in view.drawn
        if number not in view.closing and number not in view.letters
        if (role := view.called[number]) is None or role[0] not in NO_WALLS
    ]
