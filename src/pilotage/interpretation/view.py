"""What can be seen of a sheet, and what names say of its marks, before any is understood by its shape."""

import math
from collections.abc import Container, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pilotage.interpretation.glyphs import TALLEST, find_glyphs
from pilotage.interpretation.names import colors_of, guessed_role, told_role
from pilotage.interpretation.paint import Seen, look_at
from pilotage.interpretation.paper import Paper, boxes_of, find_paper
from pilotage.interpretation.sheet import Role, Sheet, Text
from pilotage.interpretation.written import find_written

CLOSING = (Role.WALL, Role.DOOR, Role.WINDOW, Role.STAIRS)
"""What a person makes one of these stays a part of the building."""

NEVER_ALL = (Role.FURNITURE, Role.IGNORE)
"""Names that make all that is visible one of these mean something else."""

AROUND = 0.5
"""Walls stand around furniture: they reach over at least this share of the drawing's diagonal."""


@dataclass(frozen=True, eq=False)
class View:
    """The visible marks of a sheet, and the roles that names give; marks by their number in the sheet."""

    sheet: Sheet
    told: Sequence[tuple[Role, str] | None]  # role of each mark by a person, or by the words of this program
    closing: Mapping[int, tuple[Role, str]]  # of these, those that stay a part of the building
    guessed: Mapping[int, tuple[Role, str]]  # role of visible marks by `closing`, or by what people call them
    paper: Paper
    drawn: Sequence[int]  # marks that may be of the building, and are no paper
    letters: AbstractSet[int]  # letters that were turned into outlines
    called: Mapping[int, tuple[Role, str] | None]  # role of each drawn mark by what people call it
    written: AbstractSet[int]  # texts that name the furniture they stand in
    visible: Sequence[Seen]
    diagonal: float  # [drawing units]

    @cached_property
    def lettering(self) -> list[Text]:
        """What is written in outlines of letters: texts without words, each in the middle of a letter.

        In which direction it reads is not known; the angle is not a number.
        """
        named = {mark.number for mark in self.visible if self.role(mark) is Role.LABEL}
        marks = [self.sheet.marks[number] for number in sorted(self.letters | named)]
        boxes = boxes_of([mark for mark in marks if mark.fill is not None])
        return [
            Text("", ((left + right) / 2.0, (bottom + top) / 2.0), height, math.nan)
            for left, bottom, right, top in boxes.tolist()
            if (height := min(right - left, top - bottom)) <= TALLEST * self.diagonal
        ]

    def role(self, mark: Seen) -> Role:
        """Return the role that a name gives to a mark; what has none may be a wall."""
        return self.guessed[mark.number][0] if mark.number in self.guessed else Role.WALL

    def all_but(self, roles: Container[Role], marks: Sequence[Seen]) -> list[Seen]:
        """Leave out marks to which a name gives one of these roles."""
        return [mark for mark in marks if self.role(mark) not in roles]


def view_of(sheet: Sheet, layers: Mapping[str, Role]) -> View:
    """Look at a sheet; `layers` tells the roles of layers, classes, ids, blocks and colors."""
    by_color = any(name.startswith("#") for name in layers)
    told = [
        told_role((*colors_of(mark), *mark.names) if by_color else mark.names, layers) for mark in sheet.marks
    ]
    closing = {number: role for number, role in enumerate(told) if role is not None and role[0] in CLOSING}
    open_to_guess = [number for number, role in enumerate(told) if role is None or number in closing]
    paper = find_paper(sheet, open_to_guess)
    drawn = [number for number in open_to_guess if number not in paper.sheets]
    diagonal = diagonal_of(sheet, drawn)
    unsaid = [number for number in drawn if number not in closing]
    glyphs = find_glyphs([sheet.marks[number] for number in unsaid], diagonal)
    letters = {number for place, number in enumerate(unsaid) if place in glyphs}
    visible = look_at(sheet, [number for number in drawn if number not in letters], paper.ground, diagonal)
    called = {number: guessed_role(names) for number, names in names_inside(sheet, drawn).items()}
    things = {number for number, role in called.items() if is_furniture(role)}
    written = find_written(sheet, drawn, things, diagonal)
    for number in [number for number in written if called[number] is None]:
        called[number] = Role.FURNITURE, f"in it is written {sheet.texts[written[number]].text!r}"
    others = [number for number in drawn if number not in letters and not is_furniture(called[number])]
    if diagonal_of(sheet, others) < AROUND * diagonal:  # rooms are called by what stands in them
        called = {number: None if is_furniture(role) else role for number, role in called.items()}
    if all(role is not None and role[0] in NEVER_ALL for role in (called[mark.number] for mark in visible)):
        called = dict.fromkeys(called)  # the "border" of a school is its walls
    guessed = {
        mark.number: role for mark in visible if (role := closing.get(mark.number) or called[mark.number])
    }
    words = set(written.values())
    return View(sheet, told, closing, guessed, paper, drawn, letters, called, words, visible, diagonal)


def is_furniture(named: tuple[Role, str] | None) -> bool:
    """Tell whether a mark has a name of furniture."""
    return named is not None and named[0] is Role.FURNITURE


def names_inside(sheet: Sheet, drawn: Sequence[int]) -> dict[int, list[str]]:
    """List the names of marks but for those that all of them bear."""
    common = common_names(sheet, drawn)
    return {number: [name for name in sheet.marks[number].names if name not in common] for number in drawn}


def common_names(sheet: Sheet, drawn: Sequence[int]) -> set[str]:
    """Return the names that all marks bear and that would make them no walls: they are the drawing's own.

    Programs name what holds a whole drawing "Frame 1" or "axes_1".
    """
    common = set.intersection(*(set(sheet.marks[number].names) for number in drawn)) if drawn else set()
    return {name for name in common if (role := guessed_role([name])) and role[0] is not Role.WALL}


def diagonal_of(sheet: Sheet, drawn: Sequence[int]) -> float:
    """Measure the diagonal of some marks."""
    if not drawn:
        return 0.0
    boxes = boxes_of([sheet.marks[number] for number in drawn])
    return float(np.hypot(*(boxes[:, 2:].max(axis=0) - boxes[:, :2].min(axis=0))))
