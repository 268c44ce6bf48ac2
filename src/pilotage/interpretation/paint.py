"""What can be seen of each mark once all is painted: what later paint hides is not there."""

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array, Polyline, numbered
from pilotage.interpretation.paper import FAINT, SAME
from pilotage.interpretation.sheet import Color, Mark, Sheet

EDGE = 0.0005
"""Paint hides nothing this near its border, as a share of the drawing's diagonal: neighbors share edges."""

UNLIKE = 0.3
"""A line in a color hides a line below it if they differ so much in a channel: a door drawn over a wall."""

AS_WIDE = 0.8
"""A line hides one that runs below it if it is so wide, as a share; else the edges of that one are seen."""

ALONG = 3.0
"""What a line in a color hides is longer than this many of its widths; it crosses other lines."""

MOSTLY = 0.5
"""A line in the color of a floor erases if it lies on it by so much of its length, as a share."""

NOTHING = shapely.GeometryCollection()


@dataclass(frozen=True, eq=False, slots=True)
class Seen:
    """What is left of a mark."""

    number: int  # of the mark in its sheet
    line: shapely.Geometry  # where its pen is seen, a line without width
    area: shapely.Geometry  # where its fill is seen
    whole: bool  # whether all of its line is seen


def shapes_of(seen: Sequence[Seen]) -> NDArray[np.object_]:
    """Return the lines and the areas of marks, (2, n)."""
    return np.array([[mark.line for mark in seen], [mark.area for mark in seen]], dtype=object)


def look_at(sheet: Sheet, numbers: Sequence[int], ground: Color, diagonal: float) -> list[Seen]:
    """Find what is seen of the marks with these numbers; a mark of which nothing is seen is left out."""
    marks = [sheet.marks[number] for number in numbers]
    inks = channels([None if mark.pen is None else mark.pen.color for mark in marks])
    fills = channels([mark.fill for mark in marks])
    widths = np.array([np.nan if mark.pen is None else mark.pen.width for mark in marks])
    lines, areas = lines_of(marks), areas_of(marks)
    pale = contrast(inks, ground) < UNLIKE
    inked = (contrast(inks, ground) >= FAINT) & ~of_floor(lines, areas, (inks, fills), widths, pale)
    hiding = ~inked | (np.ptp(inks, axis=1) >= UNLIKE)
    tracks = tracks_of(lines, np.where(hiding, widths, 0.0))
    covers = shapely.buffer(areas, -EDGE * diagonal, join_style="mitre")
    lines[~inked] = NOTHING
    earlier, later = overlaps(lines, areas, covers, tracks)
    areas[contrast(fills, ground) < FAINT] = NOTHING
    as_wide = widths[later] >= AS_WIDE * widths[earlier]
    unlike = inked[later] & (contrast(inks[later], inks[earlier]) >= UNLIKE)
    runs = as_wide & unlike & (shapely.length(lines)[earlier] > ALONG * widths[later])
    over = hidden_along(lines, tracks, widths, earlier[runs], later[runs])
    whole = np.ones(len(marks), dtype=bool)
    for place in np.unique(earlier).tolist():
        own = slice(*np.searchsorted(earlier, (place, place + 1)))
        line, above, erasing = lines[place], later[own], ~inked[later[own]]
        lines[place] = without(line, [*covers[above], *tracks[above[erasing & as_wide[own]]]])
        lines[place] = without(lines[place], over.get(place, []))
        areas[place] = without(areas[place], [*covers[above], *tracks[above[erasing]]])
        whole[place] = math.isclose(lines[place].length, line.length, rel_tol=1e-6)
    is_left = ~(shapely.is_empty(lines) & shapely.is_empty(areas))
    found = zip(numbers, lines, areas, whole.tolist(), strict=True)
    return [Seen(*mark) for mark, is_seen in zip(found, is_left, strict=True) if is_seen]


def of_floor(
    lines: NDArray[np.object_],
    areas: NDArray[np.object_],
    colors: tuple[Array, Array],
    widths: Array,
    pale: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Tell which of the pale lines (n,) are in the color of a floor below that they lie on, and erase.

    `colors` are those of lines and of areas, (n, 3) each, and `widths` (n,) those of lines.
    """
    inks, fills = colors
    found = np.zeros(len(lines), dtype=bool)
    chosen = np.flatnonzero(pale)
    floors = np.flatnonzero(~shapely.is_empty(areas))
    later, earlier = shapely.STRtree(areas[floors]).query(lines[chosen], predicate="intersects")
    later, earlier = chosen[later], floors[earlier]
    same = (earlier < later) & (contrast(inks[later], fills[earlier]) < SAME)
    later, earlier = later[same], earlier[same]
    if len(later):
        below = shapely.buffer(areas[earlier], widths[later] / 2.0)
        on_floor = shapely.length(shapely.intersection(lines[later], below))
        found[later[on_floor >= MOSTLY * shapely.length(lines[later])]] = True
    return found


def channels(colors: Sequence[Color | None]) -> Array:
    """Put colors into an array (n, 3); what has none differs from every color by nan."""
    return np.array([(np.nan,) * 3 if color is None else color for color in colors]).reshape(-1, 3)


def contrast(first: Array, second: Array | Color) -> Array:
    """Return the largest difference of colors (n, 3) in a channel, (n,)."""
    return np.asarray(np.abs(first - second).max(axis=1))


def overlaps(
    lines: NDArray[np.object_],
    areas: NDArray[np.object_],
    covers: NDArray[np.object_],
    tracks: NDArray[np.object_],
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """List marks, given what they paint, each with the later ones that may hide it by a fill or a line."""
    count = len(lines)
    tree = shapely.STRtree(np.concatenate([lines, areas]))
    later, earlier = tree.query(np.concatenate([covers, tracks]), predicate="intersects") % max(count, 1)
    pairs = np.unique((earlier * count + later)[earlier < later])
    return pairs // count, pairs % count


def lines_of(marks: Sequence[Mark]) -> NDArray[np.object_]:
    """Return the middles of the lines of marks, (n,); of those without a pen nothing."""
    lines = np.full(len(marks), NOTHING, dtype=object)
    drawn = [
        (place, outline.ring)
        for place, mark in enumerate(marks)
        if mark.pen is not None
        for outline in mark.outlines
    ]
    if drawn:
        places, rings = zip(*drawn, strict=True)
        points, owners = numbered(rings)
        shapely.multilinestrings(shapely.linestrings(points, indices=owners), indices=places, out=lines)
    return lines


def areas_of(marks: Sequence[Mark]) -> NDArray[np.object_]:
    """Return the areas of marks, (n,), by the even-odd rule; of those without a fill nothing."""
    areas = np.full(len(marks), NOTHING, dtype=object)
    drawn = [
        (place, outline.vertices)
        for place, mark in enumerate(marks)
        if mark.fill is not None
        for outline in mark.outlines
        if len(outline) > 2
    ]
    if drawn:
        places, rings = zip(*drawn, strict=True)
        points, owners = numbered(rings)
        polygons = shapely.polygons(shapely.linearrings(points, indices=owners))
        shapely.multipolygons(polygons, indices=places, out=areas)
        tangled = ~shapely.is_valid(areas)
        areas[tangled] = even_odd(*shapely.get_parts(areas[tangled], return_index=True))
    return areas


def even_odd(rings: NDArray[np.object_], owners: NDArray[np.intp]) -> NDArray[np.object_]:
    """Put areas of rings together by the even-odd rule, those that follow each other with one owner."""
    count = len(np.unique(owners))
    areas = shapely.make_valid(rings, method="linework")
    while len(areas) > count:  # pairs, then pairs of pairs: far faster than one after the other
        is_first = (np.arange(len(owners)) - np.searchsorted(owners, owners)) % 2 == 0
        pairs = np.flatnonzero(is_first[:-1] & (owners[:-1] == owners[1:]))
        areas[pairs] = shapely.symmetric_difference(areas[pairs], areas[pairs + 1])
        areas, owners = areas[is_first], owners[is_first]
    parts, owners = numbered_parts(areas)
    is_area = shapely.get_type_id(parts) == shapely.GeometryType.POLYGON
    found = np.full(count, NOTHING, dtype=object)
    shapely.multipolygons(parts[is_area], indices=owners[is_area], out=found)
    return found


def tracks_of(lines: NDArray[np.object_], widths: Array) -> NDArray[np.object_]:
    """Return where lines (n,) lie that hide what is below, (n,); those of no width hide nothing."""
    tracks = np.full(len(lines), NOTHING, dtype=object)
    wide = widths > 0.0
    tracks[wide] = shapely.buffer(lines[wide], widths[wide] / 2.0, cap_style="flat", join_style="mitre")
    return tracks


def without(shape: shapely.Geometry, covers: Sequence[shapely.Geometry]) -> shapely.Geometry:
    """Take away what is covered, if anything covers."""
    if shape.is_empty:
        return shape
    covering = [cover for cover in covers if not cover.is_empty]
    return shapely.difference(shape, shapely.union_all(covering)) if covering else shape


def hidden_along(
    lines: NDArray[np.object_],
    tracks: NDArray[np.object_],
    widths: Array,
    earlier: NDArray[np.intp],
    later: NDArray[np.intp],
) -> dict[int, list[shapely.Geometry]]:
    """Return what later lines hide of earlier ones: where they run along these, and not where they cross."""
    common = shapely.intersection(lines[earlier], tracks[later])
    along = shapely.length(common) > ALONG * widths[later]
    earlier, later = earlier[along], later[along]
    pieces, pairs = numbered_parts(shapely.line_merge(common[along]))
    long = shapely.length(pieces) > ALONG * widths[later[pairs]]
    pairs, owners = np.unique(pairs[long], return_inverse=True)
    runs = shapely.multilinestrings(pieces[long], indices=owners)
    over = shapely.buffer(
        shapely.union_all(runs[:, None], axis=1), widths[later[pairs]] / 2.0, cap_style="flat"
    )
    found: defaultdict[int, list[shapely.Geometry]] = defaultdict(list)
    for place, hidden in zip(earlier[pairs].tolist(), over, strict=True):
        found[place].append(hidden)
    return found


def parts_of(shape: shapely.Geometry | NDArray[np.object_]) -> NDArray[np.object_]:
    """List all simple parts of nested collections."""
    return numbered_parts(shape)[0]


def numbered_parts(
    shape: shapely.Geometry | NDArray[np.object_],
) -> tuple[NDArray[np.object_], NDArray[np.intp]]:
    """List all simple parts of nested collections, and the number of the shape that each is a part of."""
    parts, owners = shapely.get_parts(shape, return_index=True)
    while (shapely.get_type_id(parts) >= shapely.GeometryType.MULTIPOINT).any():
        parts, inner = shapely.get_parts(parts, return_index=True)
        owners = owners[inner]
    return parts, owners


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
