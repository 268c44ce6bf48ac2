"""What the visible marks of a sheet are: one kind of mark after the other is found and taken out."""

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass

import shapely

from pilotage.interpretation.areas import find_areas
from pilotage.interpretation.bars import Bar, find_bars, find_fronts, without_bars
from pilotage.interpretation.dashed import find_axes, find_dashed
from pilotage.interpretation.dimensions import find_dimensions
from pilotage.interpretation.doors import Door, find_doors, without_doors
from pilotage.interpretation.drawn import Walls
from pilotage.interpretation.floors import find_floors
from pilotage.interpretation.halves import Half, find_halves, without_halves
from pilotage.interpretation.paint import Seen
from pilotage.interpretation.patches import Bridge, find_bridges, find_passages, find_patched, without_bridges
from pilotage.interpretation.plates import find_plates
from pilotage.interpretation.sheet import Mark, Role
from pilotage.interpretation.signs import find_signs
from pilotage.interpretation.stairs import find_stairs
from pilotage.interpretation.view import View
from pilotage.interpretation.walls import find_walls

NO_WALLS = (Role.DOOR, Role.STAIRS, Role.FURNITURE, Role.LABEL, Role.IGNORE)
"""What a name makes one of these is no wall; windows close rooms as walls do, stairs by their outline."""

NO_DOORS = (Role.FURNITURE, Role.LABEL, Role.IGNORE)
"""Arcs of these are of cupboards and trees."""


@dataclass(frozen=True, eq=False)
class Parts:
    """What was found among the visible marks; numbers are those of the sheet."""

    measuring: AbstractSet[int]  # dimension lines
    signs: AbstractSet[int]  # discs, compasses and plates
    written: AbstractSet[int]  # texts of these
    lengths: AbstractSet[int]  # texts of dimension lines
    areas: AbstractSet[int]  # outlines of rooms, along their walls
    built: Sequence[Seen]  # marks that are none of these
    doors: Sequence[Door]  # leaf and arc
    bars: Sequence[Bar]  # patches across a wall
    fronts: Sequence[Bar]  # named doors in gaps of outer walls
    halves: Sequence[Half]  # gaps in one of two lines
    bridges: Sequence[Bridge]  # lines upon patches, from one box to the next
    dashed: AbstractSet[int]  # dashed lines from wall to wall
    axes: AbstractSet[int]  # dashed lines through the building and beyond
    left: Sequence[Seen]  # `built` without doors, bars, halves and bridges
    lines: Sequence[Seen]  # of these, what may be a wall
    walls: Walls
    stairs: shapely.Geometry


def take_apart(view: View) -> Parts:
    """Find doors, signs and stairs among the visible marks, and walls in what is left."""
    sheet, ground, diagonal = view.sheet, view.paper.ground, view.diagonal
    built = view.all_but(NO_DOORS, view.visible)
    measuring, lengths = find_dimensions(sheet, built, view.guessed, view.lettering, diagonal)
    unnamed = [mark for mark in built if mark.number not in view.guessed]
    signs, written = find_signs(sheet, unnamed, diagonal)
    signs |= find_plates(sheet, unnamed)
    built = [mark for mark in built if mark.number not in measuring | signs]
    axes = find_axes(sheet, [mark for mark in built if mark.number not in view.guessed], diagonal)
    built = [mark for mark in built if mark.number not in axes]
    doors = find_doors(sheet, built, diagonal)
    areas = set() if doors else find_areas(sheet, view.called, diagonal)  # a leaf opens these, too
    built = [mark for mark in built if mark.number not in areas]
    roles = {number: role for number, (role, _) in view.guessed.items()}
    called_doors = {number for number, role in roles.items() if role is Role.DOOR}
    patched = find_patched(sheet, view.drawn, built, ground, diagonal)
    opened = without_doors(built, doors)
    spent = {mark.number for mark, other in zip(built, opened, strict=True) if mark is not other}
    uncut = [
        other if mark.number in called_doors else mark for mark, other in zip(built, opened, strict=True)
    ]
    waiting = called_doors - spent
    bars = find_bars(
        sheet, uncut, waiting if doors else waiting | patched.keys(), diagonal, only_named=bool(doors)
    )
    fronts = find_fronts(sheet, uncut, waiting, bars, diagonal)
    bridges = find_bridges(sheet, built, patched, diagonal)
    marked = {built[bar.place].number for bar in (*bars, *fronts)}
    bridges += [] if doors else find_passages(sheet, built, called_doors - marked, diagonal)
    halves = find_halves(sheet, view.drawn, built, ground, diagonal)
    left = without_halves(without_bars(opened, bars, diagonal), halves, diagonal)
    left = without_bridges(left, bridges, diagonal)
    sides = {bridge.number for bridge in bridges}
    lines = [mark for mark in left if mark.number in sides or view.role(mark) not in NO_WALLS]
    dashed = find_dashed(sheet, lines, view.guessed, diagonal)
    lines = [mark for mark in lines if mark.number not in dashed]
    walls = find_walls(
        lines,
        sheet,
        roles,
        doors,
        floors=find_floors(may_be_floors(view), ground),
        ground=ground,
        diagonal=diagonal,
    )
    stairs = find_stairs([mark for mark in left if view.role(mark) is Role.STAIRS], sheet, diagonal)
    return Parts(
        measuring=measuring,
        signs=signs,
        written=written,
        lengths=lengths,
        areas=areas,
        built=built,
        doors=doors,
        bars=bars,
        fronts=fronts,
        halves=halves,
        bridges=bridges,
        dashed=dashed,
        axes=axes,
        left=left,
        lines=lines,
        walls=walls,
        stairs=stairs,
    )


def may_be_floors(view: View) -> list[Mark]:
    """List the marks that a name makes nothing else than a wall, faint ones too: a floor may be one."""
    return [
        view.sheet.marks[number]
        for number in view.drawn
        if number not in view.closing and number not in view.letters
        if (role := view.called[number]) is None or role[0] not in NO_WALLS
    ]
