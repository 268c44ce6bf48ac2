"""Say what each mark was taken for, and why."""

from collections.abc import Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.interpretation.doors import Door
from pilotage.interpretation.drawn import Walls
from pilotage.interpretation.floors import is_floor
from pilotage.interpretation.paint import Seen, parts_of, shapes_of
from pilotage.interpretation.sheet import Color, Role, Sheet

ALONG = 0.001
"""A mark that comes this near to a wall is part of it, as a share of the drawing's diagonal."""


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a mark was taken for, and why."""

    role: Role
    reason: str  # a few words, as in "leaf and quarter arc" or "its layer is named 'A-FURN'"


@dataclass(frozen=True, eq=False)
class Evidence:
    """What the steps of the interpretation found; marks by their number in the sheet."""

    told: Mapping[int, Meaning]  # by a person, or by the words of this program
    papers: AbstractSet[int]  # sheets of paper
    letters: AbstractSet[int]  # letters that were turned into outlines
    named: Mapping[int, Meaning]  # by what people call their layers, all but walls
    visible: Sequence[Seen]  # before doors were taken out
    left: Sequence[Seen]  # after
    doors: Sequence[Door]
    walls: Walls
    ground: Color
    diagonal: float  # [drawing units]


def find_meanings(sheet: Sheet, found: Evidence) -> tuple[Meaning, ...]:
    """Give each mark of a sheet its meaning."""
    meanings = {
        **dict.fromkeys(range(len(sheet.marks)), Meaning(Role.IGNORE, "painted over")),
        **dict.fromkeys(found.papers, Meaning(Role.IGNORE, "the sheet below the drawing")),
        **dict.fromkeys(found.letters, Meaning(Role.LABEL, "letters as outlines")),
        **dict(meanings_of_visible(sheet, found)),
        **found.named,
        **found.told,
    }
    return tuple(meanings[number] for number in range(len(sheet.marks)))


def meanings_of_visible(sheet: Sheet, found: Evidence) -> Iterator[tuple[int, Meaning]]:
    """Tell what the marks are that can be seen."""
    arcs = {found.visible[place].number for door in found.doors for place in door.marks}
    left = {mark.number for mark in found.left if not (mark.line.is_empty and mark.area.is_empty)}
    walls = found.walls
    shapes = shapes_of(found.visible)
    in_thick = near(shapes, walls.solid, ALONG * found.diagonal)
    in_thin = near(shapes, walls.lines, ALONG * found.diagonal)
    for mark, is_thick, is_thin in zip(found.visible, in_thick.tolist(), in_thin.tolist(), strict=True):
        drawn = sheet.marks[mark.number]
        if mark.number in arcs:
            yield mark.number, Meaning(Role.DOOR, "the arc of a door")
        elif mark.number not in left:
            yield mark.number, Meaning(Role.DOOR, "the leaf or threshold of a door")
        elif drawn.fill is not None and not mark.area.is_empty and drawn.fill in walls.colors:
            yield mark.number, Meaning(Role.WALL, "painted in the color of walls")
        elif drawn.fill is not None and drawn.pen is None and is_floor(drawn.fill, found.ground):
            yield mark.number, Meaning(Role.FLOOR, "a pale fill without a line")
        elif walls.lines is None:
            yield mark.number, Meaning(Role.WALL, "a stroke")
        elif is_thick:
            yield mark.number, Meaning(Role.WALL, "a face of a thick wall, or within it")
        elif is_thin:
            yield mark.number, Meaning(Role.WALL, "a line that parts rooms")
        else:
            yield mark.number, Meaning(Role.FURNITURE, "beside the walls, and parts no rooms")


def near(shapes: NDArray[np.object_], walls: shapely.Geometry | None, distance: float) -> NDArray[np.bool_]:
    """Tell of which marks the lines or the areas, (2, n), come near to walls, (n,)."""
    found = np.zeros(shapes.shape[1], dtype=bool)
    if walls is not None and len(found):
        tree = shapely.STRtree(parts_of(walls))
        close, _ = tree.query(shapes.ravel(), predicate="dwithin", distance=distance)
        found[close % len(found)] = True
    return found
