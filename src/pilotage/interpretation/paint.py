"""What can be seen of each mark once all is painted: what later paint hides is not there."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Polyline
from pilotage.interpretation.paper import FAINT, difference
from pilotage.interpretation.sheet import Color, Mark, Sheet

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

    @cached_property
    def shape(self) -> shapely.Geometry:
        """Line and area together."""
        return united(self.line, self.area)


def look_at(sheet: Sheet, numbers: Sequence[int], ground: Color, diagonal: float) -> list[Seen]:
    """Find what is seen of the marks with these numbers; a mark of which nothing is seen is left out."""
    marks = [sheet.marks[number] for number in numbers]
    areas = [area_of(mark) if mark.fill is not None else NOTHING for mark in marks]
    inked = [mark.pen is not None and difference(mark.pen.color, ground) >= FAINT for mark in marks]
    lines = [line_of(mark) if shown else NOTHING for mark, shown in zip(marks, inked, strict=True)]
    covers = shapely.buffer(np.array(areas, dtype=object), -EDGE * diagonal, join_style="mitre")
    tracks = tracks_of(marks, ground)
    hidden = overlaps([united(*pair) for pair in zip(lines, areas, strict=True)], covers, tracks)
    seen = []
    for place, (number, mark) in enumerate(zip(numbers, marks, strict=True)):
        line, area = lines[place], areas[place]
        if mark.fill is not None and difference(mark.fill, ground) < FAINT:
            area = NOTHING
        above = hidden.get(place, [])
        if above:
            erasers = [later for later in above if not inked[later]]
            area = without(area, [*covers[above], *tracks[erasers]])
            colored = [(marks[later], tracks[later]) for later in above if inked[later]]
            wide = [tracks[later] for later in erasers if covers_line(marks[later], mark)]
            over = hidden_by(colored, mark, line)
            line = without(without(line, [*covers[above], *wide]), over)
        if not (line.is_empty and area.is_empty):
            whole = not above or bool(np.isclose(line.length, lines[place].length, rtol=1e-6))
            seen.append(Seen(number, line, area, whole))
    return seen


def overlaps(
    shapes: Sequence[shapely.Geometry], covers: NDArray[np.object_], tracks: NDArray[np.object_]
) -> dict[int, list[int]]:
    """List for each mark, given what it paints, the later ones that may hide it by a fill or a line."""
    tree = shapely.STRtree(np.array(shapes))
    hidden: dict[int, list[int]] = {}
    for later, pair in enumerate(zip(covers, tracks, strict=True)):
        if not (cover := united(*pair)).is_empty:
            for earlier in tree.query(cover, predicate="intersects").tolist():
                if earlier < later:
                    hidden.setdefault(earlier, []).append(later)
    return hidden


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


def tracks_of(marks: Sequence[Mark], ground: Color) -> NDArray[np.object_]:
    """Return where lines lie that hide what is below: those that cannot be seen, and those in a color."""
    hiding = [
        number
        for number, mark in enumerate(marks)
        if mark.pen is not None
        and mark.pen.width > 0.0
        and (
            max(mark.pen.color) - min(mark.pen.color) >= UNLIKE or difference(mark.pen.color, ground) < FAINT
        )
    ]
    tracks = np.full(len(marks), NOTHING, dtype=object)
    lines = np.array([line_of(marks[number]) for number in hiding], dtype=object)
    widths = np.array([pen.width for number in hiding if (pen := marks[number].pen) is not None])
    tracks[hiding] = shapely.buffer(lines, widths / 2.0, cap_style="flat", join_style="mitre")
    return tracks


def without(shape: shapely.Geometry, covers: Sequence[shapely.Geometry]) -> shapely.Geometry:
    """Take away what is covered, if anything covers."""
    if shape.is_empty:
        return shape
    covering = [cover for cover in covers if not cover.is_empty]
    return shapely.difference(shape, shapely.union_all(covering)) if covering else shape


def covers_line(later: Mark, earlier: Mark) -> bool:
    """Tell whether a line is wide enough to hide another that runs below it."""
    return (
        later.pen is not None and earlier.pen is not None and later.pen.width >= AS_WIDE * earlier.pen.width
    )


def hidden_by(
    later: Sequence[tuple[Mark, shapely.Geometry]], earlier: Mark, line: shapely.Geometry
) -> list[shapely.Geometry]:
    """Return what lines in a color hide of a line: where they run along it, and not where they cross it."""
    found: list[shapely.Geometry] = []
    pen, length = earlier.pen, line.length
    if pen is None:
        return found
    wide = [
        (mark.pen.width, track)
        for mark, track in later
        if mark.pen is not None
        and length > ALONG * mark.pen.width
        and not track.is_empty
        and covers_line(mark, earlier)
        and difference(mark.pen.color, pen.color) >= UNLIKE
    ]
    if not wide:
        return found
    widths = np.array([width for width, _ in wide])
    common = shapely.intersection(line, np.array([track for _, track in wide], dtype=object))
    along = np.flatnonzero(shapely.length(common) > ALONG * widths)
    for merged, width in zip(shapely.line_merge(common[along]), widths[along], strict=True):
        pieces = parts_of(merged)
        long = pieces[shapely.length(pieces) > ALONG * width]
        if len(long):
            found.append(shapely.buffer(shapely.union_all(long), width / 2.0, cap_style="flat"))
    return found


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
