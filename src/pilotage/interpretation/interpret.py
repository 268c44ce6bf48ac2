"""From a sheet to a drawing of a building: give each mark a role, and build walls and openings from them."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from pilotage.interpretation.sheet import Role, Sheet
from pilotage.maps import Label, SchematicMap


class NoWallsError(ValueError):
    """A sheet shows nothing that could be a wall."""


@dataclass(frozen=True, slots=True)
class Hints:
    """What a person says about a drawing where guessing fails."""

    layers: Mapping[str, Role] = field(default_factory=dict)  # a layer, class, id or block name -> its role
    labels: tuple[Label, ...] = ()  # names of rooms, y up [drawing units]


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a mark was taken for, and why."""

    role: Role
    reason: str  # a few words, as in "leaf and quarter arc" or "its layer is named 'A-FURN'"


@dataclass(frozen=True, slots=True)
class Interpretation:
    """What was understood of a sheet."""

    sketch: SchematicMap
    sheet: Sheet
    meanings: tuple[Meaning, ...]  # one for each mark of the sheet
    text_meanings: tuple[Meaning, ...] = ()  # one for each text of the sheet
    assumptions: tuple[str, ...] = ()  # what was assumed of the whole, in words a user understands


def interpret(sheet: Sheet, hints: Hints | None = None) -> Interpretation:
    """Tell walls from all else.

    Raises NoWallsError if nothing on the sheet can be a wall.
    """
    hints = hints or Hints()
    strokes = tuple(outline for mark in sheet.marks for outline in mark.outlines)
    if not strokes:
        raise NoWallsError("a drawing needs at least one visible stroke, found none")
    labels = tuple(Label(text.text, text.position) for text in sheet.texts)
    sketch = SchematicMap(
        strokes,
        labels=labels + hints.labels,
        source=sheet.source,
        y_down=sheet.y_down,
        metres_per_unit=sheet.metres_per_unit,
        photo_from_sketch=sheet.photo_from_sheet,
    )
    meanings = tuple(Meaning(Role.WALL, "every stroke is a wall") for _ in sheet.marks)
    return Interpretation(sketch, sheet, meanings, tuple(Meaning(Role.LABEL, "") for _ in sheet.texts))
