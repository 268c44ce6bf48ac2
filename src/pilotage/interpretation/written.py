"""Find furniture that is told by what is written in it, as "Sofa" in a box is."""

from collections.abc import Sequence
from collections.abc import Set as AbstractSet

import numpy as np
import shapely

from pilotage.interpretation.names import meaning_of, name_words, thing_called
from pilotage.interpretation.paper import is_closed
from pilotage.interpretation.pens import names_place
from pilotage.interpretation.sheet import Role, Sheet, Text
from pilotage.interpretation.words import GLYPH_WIDTH

FILLING = 0.25
"""The word is at least so long, as a share of the thing: in a room it would be shorter."""

LARGEST = 0.2
"""A thing is no longer than this share of the drawing's diagonal."""

SMALLER = 0.9
"""Letters are smaller than others if they are at most so high, as a share of these."""

CLOSETS = frozenset(("wardrobe", "wardrobes", "cabinet", "cabinets", "cupboard", "cupboards"))
"""Small rooms are called so, too."""


def find_written(
    sheet: Sheet, drawn: Sequence[int], things: AbstractSet[int], diagonal: float
) -> dict[int, int]:
    """Find the closed marks in which the name of a piece of furniture is written: the mark, and the text.

    It is the smallest shape around the word, and nothing else is written in it. The word fills it, or it is
    one of the `things` that are called furniture.
    """
    spoken = [number for number, text in enumerate(sheet.texts) if names_thing(text.text)]
    closed = [number for number in drawn if is_closed(sheet.marks[number])]
    if not spoken or not closed:
        return {}
    rings = [sheet.marks[number].outlines[0].vertices for number in closed]
    areas = np.array([shapely.make_valid(shapely.Polygon(ring)) for ring in rings], dtype=object)
    lengths = np.array([np.ptp(ring, axis=0).max() for ring in rings])
    places = shapely.points([text.position for text in sheet.texts])
    written, around = shapely.STRtree(areas).query(places, predicate="within")
    found = {}
    for number in spoken:
        text = sheet.texts[number]
        holding = around[written == number]
        if not len(holding):
            continue
        place = int(holding[np.argmin(shapely.area(areas[holding]))])
        least = GLYPH_WIDTH * text.height * len(text.text)
        is_filled = closed[place] in things or FILLING * lengths[place] <= least
        if is_filled and lengths[place] <= LARGEST * diagonal and (around == place).sum() == 1:
            found[closed[place]] = number
    return found


def smaller_words(texts: Sequence[Text]) -> list[int]:
    """List the texts that name furniture in smaller letters than those of most places."""
    things = [number for number, text in enumerate(texts) if names_thing(text.text)]
    heights = [text.height for text in texts if text.height > 0.0 and names_place(text)]
    usual = float(np.median(heights)) if heights else 0.0
    return [number for number in things if 0.0 < texts[number].height < SMALLER * usual]


def names_thing(words: str) -> bool:
    """Tell whether words name a piece of furniture, and no room.

    >>> [names_thing(words) for words in ("Coffee table", "Bed", "Bed 2", "Toilet", "Wardrobe", "Door")]
    [True, True, False, False, False, False]
    """
    *_, head = name_words(thing_called(words)) or [""]
    return meaning_of(head) is Role.FURNITURE and head not in CLOSETS
