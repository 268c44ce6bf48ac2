"""What the marks on a drawing mean: walls, openings, furniture, words, or nothing.

A reader of `io` turns a file of any format into a `Sheet`: what was painted, in order, with names and colors,
and no opinion. `interpret` turns a sheet into a `SchematicMap`, and says for each mark what it was taken for
and why.
"""

from pilotage.interpretation.interpret import Interpretation, NoWallsError, interpret
from pilotage.interpretation.meanings import Meaning
from pilotage.interpretation.names import role_named, words_of
from pilotage.interpretation.sheet import BLACK, GAP, WHITE, Bounds, Color, Mark, Pen, Role, Sheet, Text
from pilotage.interpretation.zones import ZONE_ROLES

__all__ = [
    "BLACK",
    "GAP",
    "WHITE",
    "ZONE_ROLES",
    "Bounds",
    "Color",
    "Interpretation",
    "Mark",
    "Meaning",
    "NoWallsError",
    "Pen",
    "Role",
    "Sheet",
    "Text",
    "interpret",
    "role_named",
    "words_of",
]
