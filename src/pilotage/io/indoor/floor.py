"""From the features of an indoor map to the sheet of one level."""

import math
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import shapely
from shapely.ops import substring

from pilotage.errors import FileError
from pilotage.geometry import Array
from pilotage.interpretation.paint import parts_of
from pilotage.interpretation.sheet import BLACK, Pen, Sheet, Text
from pilotage.io.indoor.features import Feature, Kind
from pilotage.io.pages import choose_page, other_pages
from pilotage.io.sheet_builder import MOST_MARKS, SheetBuilder, outline_through, outlines_of_area

EARTH = 6_371_008.8
"""Mean radius of the earth [m]."""

LARGEST_SPAN = 0.1
"""Coordinates that span less than this and could be degrees are degrees: 11 km; no drawing is so small."""

FARTHEST = 100.0
"""Coordinates that lie so many of their spans from the origin are metres of a country's grid."""

WIDEST, USUAL = 300.0, 25.0
"""Coordinates of a plane that span no more than the first are metres; others span the second [m]."""

DOOR_WIDTH = 0.9
"""Width of a door whose width is not told [m]."""

REACH = 0.3
"""A door opens the walls that are at most this far from it [m]."""

GRID = 0.001
"""Coordinates are rounded to this [m], so that the walls of neighbors coincide."""

WALL_GRID = 0.02
"""The walls of neighbors that are no farther apart than this are one wall [m]."""

THICKEST = 0.5
"""What lies between rooms that are no farther apart than this is a wall [m]."""

CAPITAL = 0.3
"""Height of a room's name [m]."""

ROOMS = (Kind.ROOM, Kind.CORRIDOR)
STEPPED = (Kind.STAIRS, Kind.ELEVATOR)
WALLED = (Kind.ROOM, Kind.CORRIDOR, Kind.STAIRS, Kind.ELEVATOR, Kind.WALL)
OPEN = (Kind.CORRIDOR, Kind.AREA)
NAMELESS = (Kind.OPENING, Kind.WALL, Kind.COLUMN, Kind.FURNITURE, Kind.BUILDING)
SPACES = (Kind.ROOM, Kind.CORRIDOR, Kind.AREA, Kind.STAIRS, Kind.ELEVATOR, Kind.WALL)


def floor_sheet(features: Sequence[Feature], path: Path, level: str | None) -> Sheet:
    """Draw one level: the one that is given, else the one with most rooms.

    Degrees become metres from the lower left corner of the map. Raises FileError if the level is empty.
    """
    if len(features) > MOST_MARKS:
        raise FileError(f"an indoor map must have at most {MOST_MARKS:,} features", path)
    if not features:
        raise FileError("an indoor map needs at least one room, wall or line, found none", path)
    shapes, metres_per_unit = projected([feature.shape for feature in features])
    names = level_names(features)
    chosen = choose_page(names, level, path, kind="level") if names else 0
    shown = [
        (feature, shape)
        for feature, shape in zip(features, shapes, strict=True)
        if not names or not feature.levels or names[chosen] in feature.levels
    ]
    builder = SheetBuilder(path)
    metre = 1.0 / metres_per_unit if metres_per_unit else guess_metre(shapes)
    openings = [opening_of(feature, shape, metre) for feature, shape in shown if feature.kind is Kind.OPENING]
    draw_walls(builder, shown, openings, metre)
    doors = shapely.STRtree(openings)
    for feature, shape in shown:
        with builder.surviving("damaged features"):
            is_entered = feature.kind in STEPPED and len(doors.query(shape, predicate="intersects")) > 0
            draw(builder, feature, shape, metre, is_room=is_entered)
    return builder.build(
        metres_per_unit=metres_per_unit,
        remarks=other_pages(names, chosen, path, kind="level") if names else (),
    )


def level_names(features: Sequence[Feature]) -> list[str]:
    """List the levels, the one with most rooms first."""
    rooms = Counter(level for feature in features for level in feature.levels if feature.kind in ROOMS)
    all_of = Counter(level for feature in features for level in feature.levels)
    return sorted(all_of, key=lambda level: (-rooms[level], -all_of[level], level))


def projected(shapes: Sequence[shapely.Geometry]) -> tuple[list[shapely.Geometry], float | None]:
    """Carry longitudes and latitudes [deg] to a plane [m]; other coordinates stay as they are.

    Returns the metres per unit as well, None if these are not known.
    """
    left, bottom, right, top = shapely.total_bounds(shapes)
    span = max(right - left, top - bottom)
    if not (abs(left) <= 180.0 and abs(right) <= 180.0 and abs(bottom) <= 90.0 and abs(top) <= 90.0):
        is_far = 0.0 < FARTHEST * span < math.hypot(left, bottom)
        return list(shapes), 1.0 if is_far else None
    if not span < LARGEST_SPAN:
        return list(shapes), None
    north = math.radians(1.0) * EARTH
    scale = np.array([north * math.cos(math.radians((bottom + top) / 2.0)), north])

    def plane(points: Array) -> Array:
        return np.asarray((points - (left, bottom)) * scale)

    moved = [shapely.set_precision(shapely.transform(shape, plane), GRID) for shape in shapes]
    return moved, 1.0


def guess_metre(shapes: Sequence[shapely.Geometry]) -> float:
    """Guess how many units of a map make a metre: one, or many where they are pixels or millimetres."""
    left, bottom, right, top = shapely.total_bounds(shapes)
    span = float(max(right - left, top - bottom))
    return 1.0 if span <= WIDEST else span / USUAL


def opening_of(feature: Feature, shape: shapely.Geometry, metre: float) -> shapely.Geometry:
    """Return the area within which a door opens walls; `metre` [map units] is how long one is.

    A line opens the wall that it runs along, but not those across its ends.
    """
    if shape.geom_type == "Point":
        return shapely.buffer(shape, (feature.width or DOOR_WIDTH) * metre / 2.0)
    if shape.geom_type == "LineString":
        shape = shapely.set_precision(shape, WALL_GRID * metre, mode="keep_collapsed")
        shape = substring(shape, GRID * metre, -GRID * metre)
    return shapely.buffer(shape, REACH * metre, cap_style="flat")


def draw_walls(
    builder: SheetBuilder,
    shown: Sequence[tuple[Feature, shapely.Geometry]],
    openings: Sequence[shapely.Geometry],
    metre: float,
) -> None:
    """Draw the walls of all rooms, each once, open at doors and between corridors.

    A door leads from jamb to jamb. The outline of a building cuts no room: it often comes of another survey.
    `metre` [map units] is how long one is.
    """
    walls = [lines_of(shape) for feature, shape in shown if feature.kind in WALLED]
    spaces = [shape for feature, shape in shown if feature.kind in SPACES]
    rooms = areas([shape for feature, shape in shown if feature.kind in WALLED])
    outer = [
        shapely.difference(lines_of(shape), rooms)
        for feature, shape in shown
        if feature.kind is Kind.BUILDING
    ]
    if not walls and not outer:
        outer = [lines_of(shape) for shape in spaces]
    passages = [lines_of(shape) for feature, shape in shown if feature.kind in OPEN]
    drawn = shapely.union_all([*walls, *outer], grid_size=WALL_GRID * metre)
    drawn = shapely.difference(drawn, shared(passages))
    lines = np.array([part for part in parts_of(drawn) if part.geom_type == "LineString"], dtype=object)
    tree = shapely.STRtree(lines)
    for opening in openings:
        near = shapely.multilinestrings(lines[np.sort(tree.query(opening, predicate="intersects"))])
        for jambs in shapely.get_parts(shapely.line_merge(shapely.intersection(near, opening))):
            if jambs.geom_type == "LineString":
                builder.add_opening(outline_through(shapely.get_coordinates(jambs)[[0, -1]]))
    doors = shapely.union_all(openings)
    for part in parts_of(shapely.difference(between(spaces, metre), doors)):
        builder.add_mark(outlines_of_area(part), pen=None, fill=BLACK, names=("wall",), source="walls")
    drawn = shapely.difference(drawn, doors)
    for part in shapely.get_parts(shapely.line_merge(drawn)):
        if part.geom_type == "LineString" and part.length > 0.0:
            builder.add_mark(
                [outline_through(shapely.get_coordinates(part))],
                pen=Pen(BLACK),
                names=("wall",),
                source="walls",
            )


def between(spaces: Sequence[shapely.Geometry], metre: float) -> shapely.Geometry:
    """Return what lies between rooms that are drawn by their inner faces: walls that have a thickness."""
    whole = areas(spaces)
    closed = grown(grown(whole, THICKEST * metre / 2.0), -THICKEST * metre / 2.0)
    return grown(grown(shapely.difference(closed, whole), -WALL_GRID * metre / 2.0), WALL_GRID * metre / 2.0)


def areas(shapes: Sequence[shapely.Geometry]) -> shapely.Geometry:
    """Unite the areas among some shapes."""
    return shapely.union_all([shape for shape in shapes if shape.geom_type in ("Polygon", "MultiPolygon")])


def grown(shape: shapely.Geometry, distance: float) -> shapely.Geometry:
    """Move the outline of a shape outwards, its corners sharp."""
    return shapely.buffer(shape, distance, join_style="mitre")


def shared(lines: Sequence[shapely.Geometry]) -> shapely.Geometry:
    """Return what two or more lines have in common."""
    if not lines:
        return shapely.GeometryCollection()
    first, second = shapely.STRtree(lines).query(lines, predicate="intersects")
    pairs = [(a, b) for a, b in zip(first.tolist(), second.tolist(), strict=True) if a < b]
    common = [shapely.intersection(lines[a], lines[b]) for a, b in pairs]
    parts = [part for shape in common for part in shapely.get_parts(shape)]
    return shapely.union_all([part for part in parts if part.length > 0.0])


def lines_of(shape: shapely.Geometry) -> shapely.Geometry:
    """Return the outlines of areas, and lines as they are."""
    return shapely.boundary(shape) if shape.geom_type in ("Polygon", "MultiPolygon") else shape


def draw(
    builder: SheetBuilder, feature: Feature, shape: shapely.Geometry, metre: float, *, is_room: bool
) -> None:
    """Draw what is no wall, and write the name of a feature.

    Stairs and lifts with a door are rooms: all that is drawn of them are their walls, open at the door.
    """
    names = (feature.kind.value, feature.layer)
    group = (builder.new_group(),)
    is_solid = feature.kind is Kind.COLUMN
    if feature.kind in (Kind.COLUMN, Kind.FURNITURE, Kind.OTHER, *STEPPED) and not is_room:
        for part in parts_of(shape):
            is_area = part.geom_type == "Polygon"
            builder.add_mark(
                outlines_of_area(part) if is_area else [outline_through(shapely.get_coordinates(part))],
                pen=Pen(BLACK),
                fill=BLACK if is_solid and is_area else None,
                names=names,
                groups=group,
                source=feature.source,
            )
    if feature.name and feature.kind not in NAMELESS and not shape.is_empty:
        point = shapely.point_on_surface(shape)
        place, height = (point.x, point.y), CAPITAL * metre
        builder.add_text(Text(feature.name, place, height, 0.0, names, group, feature.source))
