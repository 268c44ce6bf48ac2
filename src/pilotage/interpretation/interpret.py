"""From a sheet to a drawing of a building: give each mark a role, and build walls and openings from them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
import shapely

from pilotage.geometry import Polyline
from pilotage.interpretation.bars import written_upon
from pilotage.interpretation.dashed import opened_dashed
from pilotage.interpretation.drawn import Walls
from pilotage.interpretation.floors import is_floor
from pilotage.interpretation.hatching import opened_shut
from pilotage.interpretation.meanings import Evidence, Meaning, find_meanings
from pilotage.interpretation.names import guessed_role, told_role
from pilotage.interpretation.origin import moved_sheet, moved_sketch, origin_of
from pilotage.interpretation.paint import Seen, polylines_of
from pilotage.interpretation.painted import find_painted_rooms, outlined
from pilotage.interpretation.paper import area_of, bounds_of
from pilotage.interpretation.parts import Parts, take_apart
from pilotage.interpretation.sheet import Color, Mark, Role, Sheet, Text
from pilotage.interpretation.solids import rings_of
from pilotage.interpretation.view import View, common_names, view_of
from pilotage.interpretation.words import find_names, is_measure, role_of_words
from pilotage.interpretation.written import smaller_words
from pilotage.interpretation.zones import find_zones
from pilotage.maps import Label, SchematicMap

NAMELESS = (Role.DOOR, Role.WINDOW, Role.FURNITURE, Role.IGNORE)
"""What is written on layers of these names no place."""

GRAIN = 0.0005
"""A fill of less area than the square of this share of the drawing's diagonal cannot be seen."""


class NoWallsError(ValueError):
    """A sheet shows nothing that could be a wall."""


@dataclass(frozen=True, slots=True)
class Interpretation:
    """What was understood of a sheet."""

    sketch: SchematicMap
    sheet: Sheet
    meanings: tuple[Meaning, ...]  # one for each mark of the sheet
    text_meanings: tuple[Meaning, ...] = ()  # one for each text of the sheet


def interpret(sheet: Sheet, layers: Mapping[str, Role] = MappingProxyType({})) -> Interpretation:
    """Tell walls from all else.

    `layers` tells the roles of layers, classes, ids, blocks and colors where guessing fails. Raises
    NoWallsError if nothing on the sheet can be a wall.
    """
    origin = origin_of(sheet)
    with np.errstate(divide="ignore", invalid="ignore"):  # corners that nearly coincide: GEOS sorts them out
        if not origin.any():
            return interpret_near(sheet, layers)
        found = interpret_near(moved_sheet(sheet, -origin), layers)
    return replace(found, sketch=moved_sketch(found.sketch, origin), sheet=sheet)


def interpret_near(sheet: Sheet, layers: Mapping[str, Role]) -> Interpretation:
    """Tell walls from all else on a sheet that is near the origin, as `interpret` does."""
    view = view_of(sheet, layers)
    painted = find_painted_rooms(view)
    if painted:
        view = view_of(outlined(sheet, painted), layers)
    parts = take_apart(view)
    text_roles = roles_of_texts(view, parts, layers)
    return Interpretation(
        sketch_of(view, parts, text_roles),
        sheet,
        find_meanings(sheet, evidence_of(view, parts, painted)),
        tuple(Meaning(*role) for role in text_roles),
    )


def roles_of_texts(view: View, parts: Parts, layers: Mapping[str, Role]) -> list[tuple[Role, str]]:
    """Tell for each text whether it names a place, and why.

    What is written on layers of furniture, doors or dimensions names none, if anything is written elsewhere.
    """
    texts = view.sheet.texts
    told = told_of_texts(texts, layers)
    things = {
        **dict.fromkeys(smaller_words(texts), "a word for furniture in small letters"),
        **dict.fromkeys(parts.aside.lengths, "the length of a dimension line"),
        **dict.fromkeys(view.written, "the name of the furniture around it"),
        **dict.fromkeys(written_upon(parts.openings.bars, texts), "the name of a door or a window"),
        **dict.fromkeys(parts.aside.written, "the north of a compass, or a number in a disc"),
        **dict.fromkeys(parts.aside.notes, "written beside the building"),
    }
    plain = [
        (Role.IGNORE, things[number]) if number in things else role_of_words(text.text)
        for number, text in enumerate(texts)
    ]
    own = common_names(view.sheet, view.drawn)
    of_marks = {name for mark in view.sheet.marks for name in mark.names} - own
    called = [
        guessed_role(
            [
                name
                for name in text.names
                if (name in of_marks or (name not in own and not is_of_words(name, text.text)))
                and not says_text(name)
            ]
        )
        for text in texts
    ]
    called = [role if role is not None and role[0] in NAMELESS else None for role in called]
    if not any(
        by_name is None and by_words[0] is Role.LABEL and not is_measure(text.text)
        for text, by_name, by_words in zip(texts, called, plain, strict=True)
    ):
        called = [None] * len(texts)
    return [a or b or c for a, b, c in zip(told, called, plain, strict=True)]


def told_of_texts(texts: Sequence[Text], layers: Mapping[str, Role]) -> list[tuple[Role, str] | None]:
    """Return the role that a person gave to each text, None where there is none.

    A sheet that calls at least half of its words labels says only that they are words, not that each names
    a place: so what is written at a door still names none.
    """
    told = [told_role(text.names, layers) for text in texts]
    labels = {
        number
        for number, role in enumerate(told)
        if role is not None and role[0] is Role.LABEL and layers.keys().isdisjoint(texts[number].names)
    }
    if 2 * len(labels) < sum(not is_measure(text.text) for text in texts):
        return told
    return [None if number in labels else role for number, role in enumerate(told)]


def says_text(name: str) -> bool:
    """Tell whether a name of words says but that they are words: what holds them tells more."""
    role = guessed_role([name])
    return role is not None and role[0] is Role.LABEL


def is_of_words(name: str, words: str) -> bool:
    """Tell whether a program called words by what they say.

    >>> is_of_words("201-Cabinet", "201"), is_of_words("Open-Space---Com", "Open Space - Com")
    (True, True)
    """
    spoken, said = ("".join(filter(str.isalnum, text.casefold())) for text in (name, words))
    return said in spoken


def sketch_of(view: View, parts: Parts, text_roles: Sequence[tuple[Role, str]]) -> SchematicMap:
    """Build the drawing of walls, openings and names; raises NoWallsError if it would have no stroke."""
    sheet = view.sheet
    strokes = tuple(building_strokes(view, parts))
    if not strokes:
        raise NoWallsError("a drawing needs at least one visible stroke, found none")
    spoken = [number for number, (role, _) in enumerate(text_roles) if role in (Role.LABEL, Role.WALL)]
    names = find_names([(number, sheet.texts[number]) for number in spoken], strokes)
    start, goal = (marked(role, sheet, view.told, text_roles) for role in (Role.START, Role.GOAL))
    solid = parts.walls.solid
    solid = solid if solid.is_empty else shapely.union(solid, parts.stairs)
    return SchematicMap(
        strokes,
        start=start,
        goal=goal,
        labels=tuple(Label(name.words, name.position) for name in names),
        unread=(*sheet.unread, *(text.position for text in view.lettering)),
        solids=tuple(polyline for ring in rings_of(solid) for polyline in polylines_of(ring)),
        source=sheet.source,
        y_down=sheet.y_down,
        metres_per_unit=sheet.metres_per_unit,
        zones=find_zones(sheet, view.told),
        photo_from_sketch=sheet.photo_from_sheet,
        doors=(
            *parts.openings.lines,
            *opened_dashed(sheet, sorted(parts.dashed)),
            *opened_shut(parts.walls.shut),
        ),
        openings=sheet.openings,
    )


def evidence_of(view: View, parts: Parts, painted: Sequence[int]) -> Evidence:
    """Gather what tells the meaning of each mark."""
    named = {number: Meaning(*role) for number, role in view.guessed.items() if role[0] is not Role.WALL}
    return Evidence(
        {number: Meaning(*role) for number, role in enumerate(view.told) if role is not None},
        set(view.paper.sheets),
        view.letters,
        {
            **dict.fromkeys(painted, Meaning(Role.WALL, "painted as a room; its edge is the wall")),
            **dict.fromkeys(parts.dashed, Meaning(Role.DOOR, "a dashed line from wall to wall")),
            **parts.openings.meanings,
            **dict.fromkeys(parts.areas, Meaning(Role.IGNORE, "the outline of a room, along its walls")),
            **parts.aside.meanings,
            **named,
        },
        parts.built,
        parts.left,
        parts.openings.doors,
        parts.walls,
        view.paper.ground,
        view.diagonal,
    )


def building_strokes(view: View, parts: Parts) -> Iterator[Polyline]:
    """List the strokes of walls as found, of what a person calls walls, and the outlines of stairs."""
    yield from wall_strokes(
        view.sheet, parts.lines, parts.walls, view.paper.ground, (GRAIN * view.diagonal) ** 2
    )
    for mark in parts.lines:
        if mark.number in view.closing:
            yield from beside_walls(mark, parts.walls)
    for ring in rings_of(parts.stairs):
        yield from polylines_of(ring)


def wall_strokes(
    sheet: Sheet, seen: Sequence[Seen], walls: Walls, ground: Color, grain: float
) -> Iterator[Polyline]:
    """List the strokes of all walls: as they were drawn where nothing was taken away from them."""
    for ring in rings_of(walls.solid):
        yield from polylines_of(ring)
    if walls.lines is not None:
        yield from polylines_of(walls.lines)
        return
    for mark in seen:
        drawn = sheet.marks[mark.number]
        if drawn.pen is not None:
            yield from strokes_of(drawn, grain) if mark.whole else polylines_of(mark.line)
        elif drawn.fill is not None and drawn.fill not in walls.colors and not is_floor(drawn.fill, ground):
            yield from strokes_of(drawn, grain)


def beside_walls(mark: Seen, walls: Walls) -> list[Polyline]:
    """List the lines of a mark that is told to be a wall, where no wall was found."""
    if walls.lines is None:
        return []  # every line is a wall
    if mark.line.is_empty:
        return []  # only painted: its area is among the solids
    beside = shapely.difference(mark.line, walls.solid)  # one by one: GEOS knows no areas and lines in one
    return list(polylines_of(shapely.difference(beside, walls.lines)))


def strokes_of(mark: Mark, grain: float) -> Iterator[Polyline]:
    """List the lines of a mark; one that has none is seen by the border of its area."""
    for outline in mark.outlines:
        if mark.pen is not None:
            yield outline
        elif area_of(outline) > grain:
            yield Polyline(outline.vertices, closed=True)


def marked(
    role: Role,
    sheet: Sheet,
    told: Sequence[tuple[Role, str] | None],
    text_roles: Sequence[tuple[Role, str]],
) -> tuple[float, float] | None:
    """Find the center of what marks a start or a goal: the first such mark, else the first text."""
    for mark, found in zip(sheet.marks, told, strict=True):
        if found is not None and found[0] is role:
            left, bottom, right, top = bounds_of(mark)
            return (left + right) / 2.0, (bottom + top) / 2.0
    texts = zip(sheet.texts, text_roles, strict=True)
    return next((text.position for text, (found, _) in texts if found is role), None)
