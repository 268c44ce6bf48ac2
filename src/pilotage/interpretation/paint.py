"""What can be seen of each mark once all is painted: what later paint hides is not there."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Polyline
from pilotage.interpretation.paper import difference
from pilotage.interpretation.sheet import Color, Mark, Sheet

FAINT = 0.1
"""Paint that differs less than this from the ground in every channel cannot be seen: it erases."""

EDGE = 0.0005
"""Paint hides nothing this near its border, as a share of the drawing's diagonal: neighbors share edges."""

UNLIKE = 0.3
"""A line in a color hides a line below it if they differ so much in a channel: a door drawn over a wall."""

AS_WIDE = 0.8
"""A line hides one that runs below it if it is so wide, as a share; else the edges of that one are seen."""

ALONG = 3.0
"""What a line in a color hides is longer than this many of its widths; it crosses other lines."""

NOTHING = shapely.GeometryCollection()


@dataclass(frozen=True, eq=False)
class Seen:
    """What is left of a mark."""

    number: int  # of the mark in its sheet
    line: shapely.Geometry  # where its pen is seen, a line without width
    area: shapely.Geometry  # where its fill is seen
    whole: bool  # whether all of its line is seen


def look_at(sheet: Sheet, numbers: Sequence[int], ground: Color, diagonal: float) -> list[Seen]:
    """Find what is seen of the marks with these numbers; a mark of which nothing is seen is left out."""
    marks = [sheet.marks[number] for number in numbers]
    areas = [area_of(mark) if mark.fill is not None else NOTHING for mark in marks]
    inked = [mark.pen is not None and difference(mark.pen.color, ground) >= FAINT for mark in marks]
    lines = [line_of(mark) if shown else NOTHING for mark, shown in zip(marks, inked, strict=True)]
    covers = [cover_of(area, EDGE * diagonal) for area in areas]
    tracks = [track_of(mark, ground) for mark in marks]
    tree = shapely.STRtree(np.array([united(*pair) for pair in zip(lines, areas, strict=True)]))
    hidden: dict[int, list[int]] = {}
    for later, pair in enumerate(zip(covers, tracks, strict=True)):
        if not (cover := united(*pair)).is_empty:
            for earlier in tree.query(cover, predicate="intersects").tolist():
                if earlier < later:
                    hidden.setdefault(earlier, []).append(later)
    seen = []
    for place, (number, mark) in enumerate(zip(numbers, marks, strict=True)):
        line, area = lines[place], areas[place]
        if mark.fill is not None and difference(mark.fill, ground) < FAINT:
            area = NOTHING
        above = hidden.get(place, [])
        if above:
            cover = shapely.union_all([covers[later] for later in above])
            erased = shapely.union_all([tracks[later] for later in above if not inked[later]])
            area = shapely.difference(area, shapely.union(cover, erased))
            over = [hidden_by(marks[later], tracks[later], mark, line) for later in above if inked[later]]
            wide = [tracks[later] for later in above if not inked[later] and covers_line(marks[later], mark)]
            line = shapely.difference(line, shapely.union_all([cover, *wide]))
            line = shapely.difference(line, shapely.union_all(over)) if over else line
        if not (line.is_empty and area.is_empty):
            whole = not above or bool(np.isclose(line.length, lines[place].length, rtol=1e-6))
            seen.append(Seen(number, line, area, whole))
    return seen


def united(first: shapely.Geometry, second: shapely.Geometry) -> shapely.Geometry:
    """Put two shapes together; of the line and the area of most marks one is empty, and needs no union."""
    return first if second.is_empty else second if first.is_empty else shapely.union(first, second)


def line_of(mark: Mark) -> shapely.Geometry:
    """Return the middle of a mark's line."""
    return shapely.multilinestrings([shapely.linestrings(outline.ring) for outline in mark.outlines])


def area_of(mark: Mark) -> shapely.Geometry:
    """Return the area that a mark's outlines enclose, by the even-odd rule."""
    rings = [shapely.polygons(outline.vertices) for outline in mark.outlines if len(outline) > 2]
    if not rings:
        return NOTHING
    whole = shapely.multipolygons(rings)
    if shapely.is_valid(whole):
        return whole
    areas = shapely.make_valid(rings, method="linework")
    while len(areas) > 1:  # pairs, then pairs of pairs: far faster than one after the other
        last = areas[len(areas) // 2 * 2 :]
        areas = np.append(
            shapely.symmetric_difference(areas[: len(areas) - len(last) : 2], areas[1::2]), last
        )
    return polygons_of(areas[0])


def cover_of(area: shapely.Geometry, edge: float) -> shapely.Geometry:
    """Return what a mark's fill hides: its area up to its edge."""
    return shapely.buffer(area, -edge, join_style="mitre") if not area.is_empty else NOTHING


def track_of(mark: Mark, ground: Color) -> shapely.Geometry:
    """Return where a line lies that hides what is below: one that cannot be seen, or one in a color."""
    if mark.pen is None or mark.pen.width == 0.0:
        return NOTHING
    is_colored = max(mark.pen.color) - min(mark.pen.color) >= UNLIKE
    if not is_colored and difference(mark.pen.color, ground) >= FAINT:
        return NOTHING
    return shapely.buffer(line_of(mark), mark.pen.width / 2.0, cap_style="flat", join_style="mitre")


def covers_line(later: Mark, earlier: Mark) -> bool:
    """Tell whether a line is wide enough to hide another that runs below it."""
    return (
        later.pen is not None and earlier.pen is not None and later.pen.width >= AS_WIDE * earlier.pen.width
    )


def hidden_by(
    later: Mark, track: shapely.Geometry, earlier: Mark, line: shapely.Geometry
) -> shapely.Geometry:
    """Return what a line in a color hides of a line: where it runs along it, and not where it crosses it."""
    if later.pen is None or earlier.pen is None or track.is_empty or not covers_line(later, earlier):
        return NOTHING
    if difference(later.pen.color, earlier.pen.color) < UNLIKE:
        return NOTHING
    pieces = parts_of(shapely.line_merge(shapely.intersection(line, track)))
    long = pieces[shapely.length(pieces) > ALONG * later.pen.width]
    if not len(long):
        return NOTHING
    return shapely.buffer(shapely.union_all(long), later.pen.width / 2.0, cap_style="flat")


def polygons_of(shape: shapely.Geometry) -> shapely.Geometry:
    """Keep the areas of a collection."""
    parts = [part for part in parts_of(shape) if part.geom_type == "Polygon"]
    return shapely.multipolygons(parts) if parts else NOTHING


def parts_of(shape: shapely.Geometry | NDArray[np.object_]) -> NDArray[np.object_]:
    """List all simple parts of nested collections."""
    parts = np.atleast_1d(shapely.get_parts(shape))
    while (shapely.get_type_id(parts) >= shapely.GeometryType.MULTIPOINT).any():
        parts = shapely.get_parts(parts)
    return parts


def polylines_of(shape: shapely.Geometry) -> list[Polyline]:
    """List the lines of a shape."""
    lines = shapely.line_merge(shape) if shape.geom_type.startswith("Multi") else shape
    return [
        Polyline(coordinates[:-1], closed=True) if is_ring(coordinates) else Polyline(coordinates)
        for line in parts_of(lines)
        if line.geom_type in ("LineString", "LinearRing")
        and len(coordinates := shapely.get_coordinates(line)) > 1
    ]


def is_ring(coordinates: NDArray[np.float64]) -> bool:
    """Tell whether a line of vertices (n, 2) ends where it began."""
    return len(coordinates) > 3 and bool((coordinates[0] == coordinates[-1]).all())
