"""Find plates: small boxes painted around the words that name a room, which stand free in it."""

from collections.abc import Sequence

import numpy as np
import shapely

from pilotage.interpretation.paint import Seen
from pilotage.interpretation.paper import bounds_of, holds, is_box, is_closed
from pilotage.interpretation.sheet import Sheet

LINES = 3.0
"""A plate is no higher than so many heights of its words; a room is."""


def find_plates(sheet: Sheet, seen: Sequence[Seen]) -> set[int]:
    """Find the marks that are plates: with words in them, and all that has words in the room.

    Several boxes in a room, of which each stands for itself, are booths.
    """
    words = [(text.height, (*text.position, *text.position)) for text in sheet.texts]
    boxes = {}
    for mark in seen:
        drawn = sheet.marks[mark.number]
        if drawn.fill is not None and is_box(drawn):
            bounds = bounds_of(drawn)
            heights = [height for height, place in words if holds(bounds, place)]
            if heights and bounds[3] - bounds[1] <= LINES * max(heights):
                boxes[mark.number] = shapely.box(*bounds)
    rooms = [
        shapely.make_valid(shapely.Polygon(drawn.outlines[0].vertices))
        for mark in seen
        if mark.number not in boxes and is_closed(drawn := sheet.marks[mark.number])
    ]
    if not (boxes and rooms):
        return set()
    numbers, shapes = np.array(list(boxes)), np.array(list(boxes.values()))
    rooms.sort(key=lambda room: float(room.area))
    free = shapely.contains_properly(np.array(rooms)[:, None], shapes)
    within = np.where(free.any(axis=0), free.argmax(axis=0), -1)
    written = shapely.points([text.position for text in sheet.texts])
    found: set[int] = set()
    for place in np.unique(within[within >= 0]).tolist():
        own = shapely.union_all(shapes[within == place])
        inside = written[shapely.contains(rooms[place], written)]
        if own.geom_type == "Polygon" and shapely.covers(own, inside).all():
            found |= set(numbers[within == place].tolist())
    return found
