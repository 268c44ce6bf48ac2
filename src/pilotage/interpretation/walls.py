"""Choose what is a wall: by the first way of drawing walls that encloses the rooms."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain

import shapely

from pilotage.interpretation.doors import Door
from pilotage.interpretation.drawn import Drawn, Walls
from pilotage.interpretation.paint import NOTHING, Seen
from pilotage.interpretation.pens import THIN, by_style, usual_pen
from pilotage.interpretation.sheet import Color, Role, Sheet
from pilotage.interpretation.solids import dark_areas
from pilotage.interpretation.thick_walls import faced_walls, named_walls, painted_walls
from pilotage.interpretation.thin_walls import black_lines, named_lines
from pilotage.interpretation.windows import is_glass


def find_walls(
    seen: Sequence[Seen],
    sheet: Sheet,
    named: Mapping[int, Role],
    doors: Sequence[Door],
    *,
    floors: shapely.Geometry = NOTHING,
    ground: Color,
    diagonal: float,
) -> Walls:
    """Find walls among what is seen once doors are taken out.

    Walls are painted, or have two faces, or are black lines: the first of these that encloses the rooms.
    """
    fills = [
        (mark, color)
        for mark in seen
        if not mark.area.is_empty and (color := sheet.marks[mark.number].fill) is not None
    ]
    colors, thin = dark_areas([(mark.area, color) for mark, color in fills], ground, diagonal)
    solid = shapely.union_all(
        [mark.area for mark, color in fills if color in colors or named.get(mark.number) is Role.WALL]
    )
    styled = partial(by_style, sheet=sheet, named=named, solid=solid, diagonal=diagonal)
    styles = (styled(seen, share=share) for share in THIN)
    drawn = Drawn(
        solid,
        frozenset(colors),
        *next(styles),
        panels=shapely.union_all([mark.area for mark, color in fills if color in thin]),
        glass=glass_among(seen, named, [(mark, color) for mark, color in fills if color not in colors]),
        named=closing_lines(seen, named),
        floors=floors,
        doors=doors,
        told=sheet.openings,
        pen=usual_pen(seen, sheet).width,
        diagonal=diagonal,
    )
    others = [mark for mark in seen if named.get(mark.number) not in (Role.WALL, Role.WINDOW)]
    among_named = partial(named_lines, others=lambda: styled(others, share=THIN[0]))
    tried = chain(
        (way(drawn) for way in (named_walls, painted_walls, faced_walls, among_named, black_lines)),
        (
            black_lines(replace(drawn, main=main, loose=loose, things=things))
            for main, loose, things in styles
        ),
    )
    return next((walls for walls in tried if walls is not None), Walls(solid, None, drawn.colors))


def glass_among(
    seen: Sequence[Seen], named: Mapping[int, Role], fills: Sequence[tuple[Seen, Color]]
) -> shapely.Geometry:
    """Join what is named a window with those fills, in no color of walls, that are painted as glass."""
    windows = [mark for mark in seen if named.get(mark.number) is Role.WINDOW]
    painted = [mark.area for mark, color in fills if mark.line.is_empty and is_glass(mark.area, color)]
    return shapely.union_all([*(shape for mark in windows for shape in (mark.line, mark.area)), *painted])


def closing_lines(seen: Sequence[Seen], named: Mapping[int, Role]) -> shapely.Geometry:
    """Join the lines that are named walls with those named windows; none where no wall is named."""
    walls, windows = (
        shapely.union_all([mark.line for mark in seen if named.get(mark.number) is role])
        for role in (Role.WALL, Role.WINDOW)
    )
    return walls if walls.is_empty else shapely.union(walls, windows)
