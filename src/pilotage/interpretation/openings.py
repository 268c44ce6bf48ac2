"""Find the openings that marks show: doors with arcs, bars, patches, and gaps in one of two lines."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Polyline
from pilotage.interpretation.bars import Bar, find_bars, find_fronts, opened_bars, without_bars
from pilotage.interpretation.doors import Door, without_doors
from pilotage.interpretation.halves import Half, find_halves, opened_halves, without_halves
from pilotage.interpretation.meanings import Meaning
from pilotage.interpretation.paint import Seen
from pilotage.interpretation.patches import (
    Bridge,
    find_bridges,
    find_passages,
    find_patched,
    opened_bridges,
    without_bridges,
)
from pilotage.interpretation.sheet import Role
from pilotage.interpretation.view import View


@dataclass(frozen=True, eq=False)
class Openings:
    """Where a wall is open."""

    doors: Sequence[Door]  # leaf and arc
    bars: Sequence[Bar]  # patches across a wall
    fronts: Sequence[Bar]  # named doors in gaps of outer walls
    halves: Sequence[Half]  # gaps in one of two lines
    bridges: Sequence[Bridge]  # lines upon patches, from one box to the next

    @property
    def lines(self) -> tuple[Polyline, ...]:
        """Each from jamb to jamb."""
        return (
            *(Polyline(np.array([door.hinge, door.latch])) for door in self.doors),
            *opened_bars([*self.bars, *self.fronts]),
            *opened_halves(self.halves),
            *opened_bridges(self.bridges),
        )

    @property
    def meanings(self) -> dict[int, Meaning]:
        """What marks are that show no door by their shape, but an opening by where they lie."""
        return {
            **{half.number: Meaning(Role.DOOR, "a gap in one of two lines") for half in self.halves},
            **{bridge.number: Meaning(Role.DOOR, "a patch from box to box") for bridge in self.bridges},
        }


def find_openings(view: View, built: Sequence[Seen], doors: Sequence[Door]) -> tuple[Openings, list[Seen]]:
    """Find all openings beside the doors with arcs, and take them out of what is built.

    Where there are such doors, other marks are doors only if they are called so.
    """
    sheet, ground, diagonal = view.sheet, view.paper.ground, view.diagonal
    opened = without_doors(built, doors)
    called = {number for number, (role, _) in view.guessed.items() if role is Role.DOOR}
    waiting = called - {mark.number for mark, left in zip(built, opened, strict=True) if mark is not left}
    uncut = [left if mark.number in called else mark for mark, left in zip(built, opened, strict=True)]
    patched = find_patched(sheet, view.drawn, built, ground, diagonal)
    named = waiting if doors else waiting | patched.keys()
    bars = find_bars(sheet, uncut, named, diagonal, only_named=bool(doors))
    fronts = find_fronts(sheet, uncut, waiting, bars, diagonal)
    bridges = find_bridges(sheet, built, patched, diagonal)
    if not doors:
        marked = {built[bar.place].number for bar in (*bars, *fronts)}
        bridges += find_passages(sheet, built, called - marked, diagonal)
    halves = find_halves(sheet, view.drawn, built, ground, diagonal)
    left = without_halves(without_bars(opened, bars, diagonal), halves, diagonal)
    return Openings(doors, bars, fronts, halves, bridges), without_bridges(left, bridges, diagonal)
