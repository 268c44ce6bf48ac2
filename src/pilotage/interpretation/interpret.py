"""From a sheet to a drawing of a building: give each mark a role, and build walls and openings from them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
import shapely

from pilotage.geometry import Polyline
from pilotage.interpretation.bars import find_bars, opened_bars, without_bars
from pilotage.interpretation.dashed import find_dashed, opened_dashed
from pilotage.interpretation.dimensions import find_dimensions
from pilotage.interpretation.doors import find_doors, without_doors
from pilotage.interpretation.floors import find_floors, is_floor
from pilotage.interpretation.glyphs import find_glyphs
from pilotage.interpretation.halves import find_halves, opened_halves, without_halves
from pilotage.interpretation.meanings import Evidence, Meaning, find_meanings
from pilotage.interpretation.names import guessed_role, told_role
from pilotage.interpretation.origin import moved_sheet, moved_sketch, origin_of
from pilotage.interpretation.paint import Seen, look_at, polylines_of
from pilotage.interpretation.paper import area_of, bounds_of, find_paper
from pilotage.interpretation.sheet import Color, Mark, Role, Sheet
from pilotage.interpretation.signs import find_signs
from pilotage.interpretation.stairs import find_stairs
from pilotage.interpretation.walls import Walls, find_walls, rings_of
from pilotage.interpretation.words import find_names, role_of_words
from pilotage.interpretation.zones import find_zones
from pilotage.maps import Label, SchematicMap

GRAIN = 0.0005
"""A fill of less area than the square of this share of the drawing's diagonal cannot be seen."""


NO_WALLS = (Role.DOOR, Role.STAIRS, Role.FURNITURE, Role.LABEL, Role.IGNORE)
"""What a name makes one of these is no wall; windows close rooms as walls do, stairs by their outline."""

NO_DOORS = (Role.FURNITURE, Role.LABEL, Role.IGNORE)
"""Arcs of these are of cupboards and trees."""

CLOSING = (Role.WALL, Role.DOOR, Role.WINDOW, Role.STAIRS)
"""What a person makes one of these stays a part of the building."""

NOT_NAMED = (Role.WALL, "")


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

    `layers` tells the roles of layers, classes, ids and blocks where guessing fails. Raises NoWallsError if
    nothing on the sheet can be a wall.
    """
    origin = origin_of(sheet)
    with np.errstate(divide="ignore", invalid="ignore"):  # corners that nearly coincide: GEOS sorts them out
        if not origin.any():
            return interpret_near(sheet, layers)
        found = interpret_near(moved_sheet(sheet, -origin), layers)
    return replace(found, sketch=moved_sketch(found.sketch, origin), sheet=sheet)


def interpret_near(sheet: Sheet, layers: Mapping[str, Role]) -> Interpretation:
    """Tell walls from all else on a sheet that is near the origin, as `interpret` does."""
    told = [told_role(mark.names, layers) for mark in sheet.marks]
    closing = {number: role for number, role in enumerate(told) if role is not None and role[0] in CLOSING}
    open_to_guess = [number for number, role in enumerate(told) if role is None or number in closing]
    paper = find_paper(sheet, open_to_guess)
    drawn = [number for number in open_to_guess if number not in paper.sheets]
    diagonal = diagonal_of(sheet, drawn)
    unsaid = [number for number in drawn if number not in closing]
    glyphs = find_glyphs([sheet.marks[number] for number in unsaid], diagonal)
    letters = {number for place, number in enumerate(unsaid) if place in glyphs}
    visible = look_at(sheet, [number for number in drawn if number not in letters], paper.ground, diagonal)
    called = names_inside(sheet, drawn)
    guessed = {
        mark.number: role
        for mark in visible
        if (role := closing.get(mark.number) or guessed_role(called[mark.number]))
    }
    named = {number: Meaning(*guess) for number, guess in guessed.items() if guess[0] is not Role.WALL}
    built = [mark for mark in visible if guessed.get(mark.number, NOT_NAMED)[0] not in NO_DOORS]
    measuring = find_dimensions(sheet, built, guessed, diagonal)
    signs, written = find_signs(sheet, [mark for mark in built if mark.number not in guessed], diagonal)
    built = [mark for mark in built if mark.number not in measuring | signs]
    doors = find_doors(sheet, built, diagonal)
    called_doors = {number for number, (role, _) in guessed.items() if role is Role.DOOR}
    bars = [] if doors else find_bars(sheet, built, called_doors, diagonal)
    halves = find_halves(sheet, drawn, built, paper.ground, diagonal)
    left = without_halves(without_bars(without_doors(built, doors), bars, diagonal), halves, diagonal)
    seen = [mark for mark in left if guessed.get(mark.number, NOT_NAMED)[0] not in NO_WALLS]
    painted = [
        number
        for number in unsaid
        if number not in letters and (guessed_role(called[number]) or NOT_NAMED)[0] not in NO_WALLS
    ]  # not only what is seen: a floor may be too faint for that
    dashed = find_dashed(sheet, seen, guessed, diagonal)
    seen = [mark for mark in seen if mark.number not in dashed]
    walls = find_walls(
        seen,
        sheet,
        {number: role for number, (role, _) in guessed.items()},
        doors,
        floors=find_floors([sheet.marks[number] for number in painted], paper.ground),
        ground=paper.ground,
        diagonal=diagonal,
    )
    stairs = find_stairs(
        [mark for mark in left if guessed.get(mark.number, NOT_NAMED)[0] is Role.STAIRS], sheet, diagonal
    )
    sure = [mark for mark in seen if mark.number in closing]
    strokes = (
        *wall_strokes(sheet, seen, walls, paper.ground, (GRAIN * diagonal) ** 2),
        *(line for mark in sure for line in beside_walls(mark, walls)),
        *(line for ring in rings_of(stairs) for line in polylines_of(ring)),
    )
    if not strokes:
        raise NoWallsError("a drawing needs at least one visible stroke, found none")
    text_roles = [
        told_role(text.names, layers)
        or ((Role.IGNORE, "the north of a compass") if number in written else role_of_words(text.text))
        for number, text in enumerate(sheet.texts)
    ]
    spoken = [number for number, (role, _) in enumerate(text_roles) if role in (Role.LABEL, Role.WALL)]
    names = find_names([(number, sheet.texts[number]) for number in spoken])
    labels = tuple(Label(name.words, name.position) for name in names)
    start, goal = (marked(role, sheet, told, text_roles) for role in (Role.START, Role.GOAL))
    solid = walls.solid if walls.solid.is_empty else shapely.union(walls.solid, stairs)
    sketch = SchematicMap(
        strokes,
        start=start,
        goal=goal,
        labels=labels,
        unread=sheet.unread,
        solids=tuple(polyline for ring in rings_of(solid) for polyline in polylines_of(ring)),
        source=sheet.source,
        y_down=sheet.y_down,
        metres_per_unit=sheet.metres_per_unit,
        zones=find_zones(sheet, told),
        photo_from_sketch=sheet.photo_from_sheet,
        doors=(
            *(Polyline(np.array([door.hinge, door.latch])) for door in doors),
            *opened_bars(bars),
            *opened_halves(halves),
            *opened_dashed(sheet, sorted(dashed)),
        ),
        openings=sheet.openings,
    )
    meanings = find_meanings(
        sheet,
        Evidence(
            {number: Meaning(*role) for number, role in enumerate(told) if role is not None},
            set(paper.sheets),
            letters,
            {
                **dict.fromkeys(dashed, Meaning(Role.DOOR, "a dashed line from wall to wall")),
                **{half.number: Meaning(Role.DOOR, "a gap in one of two lines") for half in halves},
                **dict.fromkeys(measuring, Meaning(Role.IGNORE, "a dimension line")),
                **dict.fromkeys(signs, Meaning(Role.IGNORE, "a disc in a color of its own, or a compass")),
                **named,
            },
            built,
            left,
            doors,
            walls,
            paper.ground,
            diagonal,
        ),
    )
    return Interpretation(sketch, sheet, meanings, tuple(Meaning(*role) for role in text_roles))


def names_inside(sheet: Sheet, drawn: Sequence[int]) -> dict[int, list[str]]:
    """List the names of marks but for those that all of them bear: such a name is the drawing's own.

    Programs name what holds a whole drawing "Frame 1" or "axes_1".
    """
    names = {number: sheet.marks[number].names for number in drawn}
    common = set.intersection(*map(set, names.values())) if names else set()
    common = {name for name in common if (guessed_role([name]) or NOT_NAMED)[0] is not Role.WALL}
    return {number: [name for name in own if name not in common] for number, own in names.items()}


def diagonal_of(sheet: Sheet, drawn: Sequence[int]) -> float:
    """Measure the diagonal of some marks."""
    if not drawn:
        return 0.0
    boxes = np.array([bounds_of(sheet.marks[number]) for number in drawn])
    return float(np.hypot(*(boxes[:, 2:].max(axis=0) - boxes[:, :2].min(axis=0))))


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
    return list(polylines_of(shapely.difference(mark.line, shapely.union(walls.solid, walls.lines))))


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
