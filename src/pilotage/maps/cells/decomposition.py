"""Divide a drawing into cells (Wolter 2001, section 4.1)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps.cells.enclosure import drop_outdoors
from pilotage.maps.cells.free_space import (
    DecompositionSettings,
    FreeSpace,
    NotEnclosedError,
    free_space,
    thickness_of,
)
from pilotage.maps.cells.graph import Cell, CellGraph, CellSize, Gateway
from pilotage.maps.cells.identity import identify
from pilotage.maps.cells.joining import drop_small, join_corridors, join_niches, join_thresholds
from pilotage.maps.cells.merging import merge_pieces
from pilotage.maps.cells.tessellation import Tessellation
from pilotage.maps.schematic import Label, SchematicMap, diameter_of

SMALL, LARGE = 0.7, 1.4
"""A cell is small or large if its outline is shorter or longer than these shares of the median outline."""

LEAST_ROOMS, SEVERAL = 3, 2
"""So many rooms at least have a name in words, and most of them so many bare numbers: these are lengths."""

NO_DOORS = "a drawing must show rooms with doors, this one has none: a door is a gap in a wall"


class NoDoorsError(NotEnclosedError):
    """A drawing encloses rooms, but none has a door."""


@dataclass(frozen=True, eq=False)
class Division:
    """A drawing's free space, and the cells that it was divided into."""

    space: FreeSpace
    graph: CellGraph


def decompose(sketch: SchematicMap, settings: DecompositionSettings) -> CellGraph:
    """Divide the free space of a drawing into cells, the largest first.

    Raises NotEnclosedError if nothing is enclosed.
    """
    return divide(sketch, settings).graph


def divide(sketch: SchematicMap, settings: DecompositionSettings) -> Division:
    """Find the free space of a drawing and divide it into cells, the largest first.

    Free space is cut wherever clearance has a minimum along its Voronoi diagram, or begins to widen; the
    pieces are merged across all openings that do not separate them. Cells do not overlap; what they leave
    out is too small, open to the outside or solid. Raises NotEnclosedError if nothing is enclosed.
    """
    space = free_space(sketch, settings)
    written = [label.position for label in sketch.labels]
    named = holds_any(space.tessellation, written if sketch.solids else [])
    regions = merge_pieces(  # section 4.1: merging
        space.tessellation,
        space.inside,
        named,
        space.drawn,
        settings.min_cell_area,
        solids_known=bool(sketch.solids),
    )
    if sketch.solids:
        regions = join_thresholds(space.tessellation, regions, named)
        regions = join_corridors(space.tessellation, regions, named, space.drawn)
        thickness = thickness_of(sketch.solids)
        regions = join_niches(space.tessellation, regions, named, space.drawn, thickness)
    titled = holds_any(space.tessellation, [*written, *sketch.unread])
    regions = drop_outdoors(space, regions, titled, solids_known=bool(sketch.solids))
    regions = drop_small(space.tessellation, regions, named, settings.min_cell_area)
    if not (regions >= 0).any():
        raise NoDoorsError(NO_DOORS)
    numbers, polygons = outlines(space.tessellation, regions)
    diameter = diameter_of(np.vstack([stroke.vertices for stroke in sketch.strokes]))
    words = words_in(polygons, sketch.labels)
    ids = identify(polygons, words, diameter, sketch.file_axes)
    gateways = find_gateways(space.tessellation, regions, dict(zip(numbers, ids, strict=True)))
    return Division(space, CellGraph(new_cells(polygons, ids, words), gateways, diameter))


def holds_any(tessellation: Tessellation, places: Sequence[tuple[float, float]]) -> NDArray[np.bool_]:
    """Tell which pieces hold one of some places, (p,)."""
    found = np.zeros(len(tessellation.pieces), dtype=bool)
    if places:
        points = shapely.points(places)
        found[shapely.STRtree(tessellation.pieces).query(points, predicate="intersects")[1]] = True
    return found


def outlines(
    tessellation: Tessellation, regions: NDArray[np.int64]
) -> tuple[list[int], list[shapely.Polygon]]:
    """Unite the pieces of each region; return the regions and their polygons, the largest first."""
    numbers = np.unique(regions[regions >= 0])
    polygons = [shapely.union_all(tessellation.pieces[regions == number]) for number in numbers]
    polygons = [shapely.orient_polygons(largest_part(polygon)) for polygon in polygons]
    order = sorted(range(len(numbers)), key=lambda k: (-polygons[k].area, *polygons[k].bounds))
    return [int(numbers[k]) for k in order], [polygons[k] for k in order]


def largest_part(shape: shapely.Geometry) -> shapely.Polygon:
    """Return the polygon, or of several that only touch the largest."""
    return max(shapely.get_parts(shape), key=lambda part: float(part.area))


def new_cells(
    polygons: Sequence[shapely.Polygon], ids: Sequence[str], words: Sequence[Sequence[str]]
) -> tuple[Cell, ...]:
    """Make cells of polygons, each with its id, size and label."""
    lengths = [float(polygon.exterior.length) for polygon in polygons]
    median = float(np.median(lengths)) if lengths else 0.0
    return tuple(
        Cell(
            ids[number],
            vertices_of(polygon.exterior),
            size_of(lengths[number] / median),
            ", ".join(words[number]),
            tuple(vertices_of(ring) for ring in polygon.interiors),
        )
        for number, polygon in enumerate(polygons)
    )


def words_in(polygons: list[shapely.Polygon], labels: tuple[Label, ...]) -> list[list[str]]:
    """Sort labels by the polygon that each stands in; those outside all are left out.

    Where names are told, what is written in the same polygon is left out, too; so are lengths.
    """
    found: list[list[Label]] = [[] for _ in polygons]
    for label in labels:
        point = shapely.Point(label.position)
        for number, polygon in enumerate(polygons):
            if polygon.covers(point):
                found[number].append(label)
                break
    told = [[label for label in here if label.told] for here in found]
    return without_lengths(
        [[label.text for label in names or here] for names, here in zip(told, found, strict=True)]
    )


def without_lengths(words: list[list[str]]) -> list[list[str]]:
    """Leave out bare numbers beside words, where most rooms have several: one is the number of its room.

    >>> without_lengths([["Kitchen", "3200", "2450"], ["Hall", "1200", "930"], ["Bath", "2100", "880"]])
    [['Kitchen'], ['Hall'], ['Bath']]
    >>> without_lengths([["Office", "201"], ["Hall", "1", "2", "3"], ["Bath"]])
    [['Office', '201'], ['Hall', '1', '2', '3'], ['Bath']]
    """
    spoken = [[text for text in here if not text.replace(" ", "").isdecimal()] for here in words]
    counts = [len(here) - len(names) for here, names in zip(words, spoken, strict=True) if names]
    if len(counts) < LEAST_ROOMS or np.median(counts) < SEVERAL:
        return words
    return [names or here for here, names in zip(words, spoken, strict=True)]


def vertices_of(ring: shapely.LinearRing) -> Array:
    """List the vertices of a ring, the first not repeated."""
    return np.asarray(shapely.get_coordinates(ring)[:-1])


def size_of(share: float) -> CellSize:
    """Class a cell by its outline's length over the median (section 4.2)."""
    if share < SMALL:
        return CellSize.SMALL
    return CellSize.LARGE if share > LARGE else CellSize.MEDIUM


def find_gateways(
    tessellation: Tessellation, regions: NDArray[np.int64], id_of: dict[int, str]
) -> tuple[Gateway, ...]:
    """Keep the chords between different cells, in order of their cells and of their place."""
    found = []
    for chord, (left, right) in zip(tessellation.chords, regions[tessellation.sides].tolist(), strict=True):
        if left < 0 or right < 0 or left == right:
            continue
        ids = (id_of[left], id_of[right])
        segment = chord if ids[0] < ids[1] else chord[::-1]
        found.append((tuple(sorted(ids)), segment))
    found.sort(key=lambda gateway: (gateway[0], *gateway[1].ravel().tolist()))
    digits = len(str(len(found)))
    return tuple(
        Gateway(f"g{number + 1:0{digits}}", segment, (ids[0], ids[1]))
        for number, (ids, segment) in enumerate(found)
    )
