"""Set aside what is drawn but is no part of a building: dimension lines, signs and axes."""

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass

import numpy as np

from pilotage.interpretation.dashed import find_axes
from pilotage.interpretation.dimensions import find_dimensions
from pilotage.interpretation.margins import find_margins
from pilotage.interpretation.meanings import Meaning
from pilotage.interpretation.paint import Seen
from pilotage.interpretation.plates import find_plates
from pilotage.interpretation.rows import find_rows
from pilotage.interpretation.sheet import Role
from pilotage.interpretation.signs import find_signs
from pilotage.interpretation.touching import among, find_touching
from pilotage.interpretation.view import View


@dataclass(frozen=True, eq=False)
class Aside:
    """Marks that measure, point or explain; numbers are those of the sheet."""

    measuring: AbstractSet[int]  # dimension lines
    lengths: AbstractSet[int]  # texts of these
    signs: AbstractSet[int]  # discs, compasses and plates
    written: AbstractSet[int]  # texts of these
    axes: AbstractSet[int]  # dashed lines through the building and beyond
    margins: AbstractSet[int]  # what stands beside the building on its sheet
    notes: AbstractSet[int]  # texts of these
    rows: AbstractSet[int]  # lines alike that touch nothing

    @property
    def meanings(self) -> dict[int, Meaning]:
        """What these marks are."""
        return {
            **dict.fromkeys(self.measuring, Meaning(Role.IGNORE, "a dimension line")),
            **dict.fromkeys(self.axes, Meaning(Role.IGNORE, "an axis or a section through the building")),
            **dict.fromkeys(
                self.margins, Meaning(Role.IGNORE, "beside the building: a frame, notes or a grid")
            ),
            **dict.fromkeys(self.rows, Meaning(Role.FURNITURE, "a row of lines alike: steps or shelves")),
            **dict.fromkeys(
                self.signs, Meaning(Role.IGNORE, "a disc in a color of its own, a compass or a plate")
            ),
        }


def set_aside(view: View, seen: Sequence[Seen]) -> tuple[Aside, list[Seen]]:
    """Part what explains a plan from what is seen of the building."""
    sheet, diagonal = view.sheet, view.diagonal
    measuring, lengths = find_dimensions(sheet, seen, view.guessed, view.lettering, diagonal)
    unnamed = [mark for mark in seen if mark.number not in view.guessed]
    signs, written = find_signs(sheet, unnamed, diagonal)
    signs |= find_plates(sheet, unnamed)
    axes = find_axes(sheet, [mark for mark in unnamed if mark.number not in measuring | signs], diagonal)
    left = [mark for mark in seen if mark.number not in measuring | signs | axes]
    touching = find_touching(left, diagonal)
    margins, notes = find_margins(sheet, left, touching, diagonal)
    margins -= view.guessed.keys()
    within = np.array([mark.number not in margins for mark in left], dtype=bool)
    rows = find_rows(left, among(touching, within)) - view.guessed.keys()
    left = [mark for mark in left if mark.number not in margins | rows]
    return Aside(measuring, lengths, signs, written, axes, margins, notes, rows), left
