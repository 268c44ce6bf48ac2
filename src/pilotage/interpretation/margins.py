"""Find what stands beside the building on its sheet: the frame, boxes of notes, and the bubbles of a grid."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import rustworkx
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.interpretation.paint import Seen
from pilotage.interpretation.paper import boxes_of, holds, is_box
from pilotage.interpretation.sheet import Bounds, Sheet
from pilotage.interpretation.signs import is_circle
from pilotage.interpretation.touching import among

EDGE = 0.02
"""A frame is this near to the edge of the page on all sides, as a share of the page's diagonal."""

BUILDING = 0.25
"""The building is at least so large, as a share of all that is drawn: else several stand side by side."""

LETTERS = 40
"""Notes, a legend or a title block have at least so many letters in one box; names of rooms have fewer."""

THIN = 0.5
"""A frame with a title block is drawn in pens at most so wide, as a share of that of the building."""

BUBBLE = 0.04
"""The bubble of a grid line is no wider than this share of the drawing's diagonal."""

BUBBLES = 4
"""A grid has at least so many bubbles beside the building."""

SHORT = 3
"""A grid line is called by at most so many letters."""


@dataclass(frozen=True, eq=False)
class Group:
    """Marks that touch each other, and what holds them."""

    numbers: list[int]  # of the marks, in their sheet
    bounds: Bounds

    @property
    def area(self) -> float:
        """Of what holds the marks."""
        left, bottom, right, top = self.bounds
        return (right - left) * (top - bottom)


def find_margins(
    sheet: Sheet, seen: Sequence[Seen], touching: NDArray[np.intp], diagonal: float
) -> tuple[set[int], set[int]]:
    """Find the marks that stand beside the building and explain it, and the texts in them, by number.

    `touching` (2, n) are the places of marks that touch. The building is the largest group of marks that
    touch each other. A box along the edge of the page is a frame if the building stands free in it; so is a
    thin one with a title block.
    """
    groups = sorted(groups_of(sheet, seen, touching), key=lambda group: group.area, reverse=True)
    frames = set()
    places = [(*text.position, *text.position) for text in sheet.texts]
    if len(groups) > 1 and groups[1].area >= BUILDING * groups[0].area:
        outer, inner = groups[:2]
        if is_frame(sheet, outer) or is_form(sheet, outer, inner, places):
            frames, groups = set(outer.numbers), groups[1:]
    if len(groups) < 2:
        return frames, set()
    whole = np.array([group.bounds for group in groups])
    all_drawn = Group([], (*whole[:, :2].min(axis=0).tolist(), *whole[:, 2:].max(axis=0).tolist()))
    if groups[0].area < BUILDING * all_drawn.area:
        return frames, set()
    beside = [group for group in groups[1:] if not meet(group.bounds, groups[0].bounds)]
    boxes = [group.bounds for group in beside if is_note(sheet, group, places)]
    bubbles = bubbles_among(sheet, beside, places, diagonal)
    boxes += bubbles if len(bubbles) >= BUBBLES else []
    found = {n for group in beside if any(holds(box, group.bounds) for box in boxes) for n in group.numbers}
    texts = {number for number, place in enumerate(places) if any(holds(box, place) for box in boxes)}
    return frames | found, texts


def groups_of(sheet: Sheet, seen: Sequence[Seen], touching: NDArray[np.intp]) -> list[Group]:
    """Group the marks that touch each other; dashed lines join nothing, and are in no group."""
    marks = [sheet.marks[mark.number] for mark in seen]
    joins = np.array([mark.pen is None or not mark.pen.dashed for mark in marks], dtype=bool)
    network = rustworkx.PyGraph(multigraph=False)
    network.add_nodes_from(range(len(seen)))
    network.add_edges_from_no_data(list(zip(*among(touching, joins).tolist(), strict=True)))
    boxes: Array = boxes_of(marks)
    found = []
    for part in rustworkx.connected_components(network):
        if not joins[min(part)]:
            continue
        own = boxes[sorted(part)]
        (left, bottom), (right, top) = own[:, :2].min(axis=0).tolist(), own[:, 2:].max(axis=0).tolist()
        found.append(Group([seen[place].number for place in sorted(part)], (left, bottom, right, top)))
    return found


def is_frame(sheet: Sheet, group: Group) -> bool:
    """Tell whether a group is one box along the edge of the page."""
    if sheet.page is None or len(group.numbers) != 1 or not is_box(sheet.marks[group.numbers[0]]):
        return False
    left, bottom, right, top = sheet.page
    reach = EDGE * float(np.hypot(right - left, top - bottom))
    return bool(np.abs(np.subtract(group.bounds, sheet.page)).max() <= reach)


def is_form(sheet: Sheet, outer: Group, inner: Group, places: Sequence[Bounds]) -> bool:
    """Tell whether a group is a thin frame around a building with a title block, in which much is written."""
    thin, heavy = (max(widths_of(sheet, group), default=0.0) for group in (outer, inner))
    if not holds(outer.bounds, inner.bounds) or not 0.0 < thin <= THIN * heavy:
        return False
    within = [number for number, place in enumerate(places) if holds(outer.bounds, place)]
    beside = [number for number in within if not holds(inner.bounds, places[number])]
    return letters_of(sheet, beside) >= LETTERS


def widths_of(sheet: Sheet, group: Group) -> list[float]:
    """List the widths of the pens of a group."""
    return [pen.width for number in group.numbers if (pen := sheet.marks[number].pen) is not None]


def letters_of(sheet: Sheet, numbers: Sequence[int]) -> int:
    """Count the letters of texts."""
    return sum(len(sheet.texts[number].text) for number in numbers)


def is_note(sheet: Sheet, group: Group, places: Sequence[Bounds]) -> bool:
    """Tell whether a group is a box, maybe with lines in it, in which much is written."""
    boxes = [number for number in group.numbers if is_box(sheet.marks[number])]
    if len(boxes) != 1:
        return False
    written = [number for number, place in enumerate(places) if holds(group.bounds, place)]
    return letters_of(sheet, written) >= LETTERS


def bubbles_among(
    sheet: Sheet, groups: Sequence[Group], places: Sequence[Bounds], diagonal: float
) -> list[Bounds]:
    """List what holds the circles around a letter or a number."""
    found = []
    for group in groups:
        if len(group.numbers) == 1 and is_circle(sheet.marks[group.numbers[0]], BUBBLE * diagonal):
            within = [number for number, place in enumerate(places) if holds(group.bounds, place)]
            if len(within) == 1 and len(sheet.texts[within[0]].text.strip()) <= SHORT:
                found.append(group.bounds)
    return found


def meet(first: Bounds, second: Bounds) -> bool:
    """Tell whether two boxes have a point in common.

    >>> meet((0.0, 0.0, 2.0, 2.0), (1.0, 1.0, 3.0, 3.0)), meet((0.0, 0.0, 2.0, 2.0), (3.0, 0.0, 4.0, 2.0))
    (True, False)
    """
    return first[0] <= second[2] and second[0] <= first[2] and first[1] <= second[3] and second[1] <= first[3]
