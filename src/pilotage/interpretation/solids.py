"""Find walls that have a thickness: dark areas, and lines a wall's width apart."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.interpretation.paint import NOTHING, parts_of
from pilotage.interpretation.pieces import joined, on_grid, straight, without_scribble
from pilotage.interpretation.sheet import Color

THICKEST = 0.04
"""No wall is thicker than this share of the drawing's diagonal: half a metre in a small flat."""

SLENDER = 4.0
"""A wall is at least so many times as long as it is thick."""

SECOND = 0.3
"""A second color or thickness is of walls, too, if so much wall has it, as a share of the first one's."""

OPEN = 0.5
"""Of a wall less than this share is thicker than walls are."""

PANEL = 0.5
"""What is painted thinner than this share of most walls, in a color of its own, may be a sliding door."""

CONTRAST = 0.25
"""Walls differ from the ground by at least this much in lightness; floors are paler."""

DOOR_SHARE = 0.6
"""No wall is thicker than this share of a door's width."""

PAIR = (0.001, 0.03)
"""Lines so far apart may be a wall's faces where no door is drawn, as shares of the drawing's diagonal."""

OUTER = 2.5
"""Outer walls are up to so many times as thick as most walls."""

PAIRED = 0.5
"""They are if so much of all that is straight has a partner at one distance, as a share of its length."""

PARALLEL = np.radians(2.0)
"""Faces of a wall are parallel up to this."""

PAINTED = 1.4
"""The thickest painted walls are so many times as thick as the mean."""

HAIR = 0.02
"""What is thinner than this share of the greatest thickness is a line, and no wall with a thickness."""

FINE = 0.125
"""Pieces that are nearer than this share of such a line's thickness lie on one line."""

CRUMB = 2.5
"""Free-standing solids that are smaller than this many thicknesses are letters, handles and the like."""

SCRIBBLE = 0.125
"""Of pieces that are shorter than this share of a wall's thickness, one for each such square is enough."""

COARSE = 0.05
"""Lines and outlines are rounded to this share of a gap or thickness, to see what they enclose or hold."""

ENCLOSING = 0.2
"""Painted solids are the walls of a plan if they enclose this share of what all lines enclose."""


def lightness(color: Color) -> float:
    """Return how light a color looks, 0 to 1 (ITU-R BT.601)."""
    red, green, blue = color
    return 0.299 * red + 0.587 * green + 0.114 * blue


def dark_areas(
    areas: Sequence[tuple[shapely.Geometry, Color]], ground: Color, diagonal: float
) -> tuple[set[Color], set[Color]]:
    """Find the colors in which walls are painted: long and thin, and unlike the ground; and which are thin.

    A lawn is not, though beds and paths leave little of it, nor is a floor between its furniture.
    Thin are those in which walls are painted far thinner than in the color of most: sliding doors and panes
    are painted so, too.
    """
    lengths: dict[Color, float] = {}
    thicknesses: dict[Color, float] = {}
    for color in {color for _, color in areas if abs(lightness(color) - lightness(ground)) >= CONTRAST}:
        same = shapely.union_all([area for area, other in areas if other == color])
        length, thick = measured_walls(same)
        slender = (thick < THICKEST * diagonal) & (length > SLENDER * thick)
        slender[slender] = open_shares(parts_of(same)[slender], THICKEST * diagonal) < OPEN
        lengths[color] = float(length[slender].sum())
        thicknesses[color] = float(thick[slender] @ length[slender]) / max(lengths[color], 1e-12)
    longest = max(lengths.values(), default=0.0)
    if longest == 0.0 or longest < diagonal:
        return set(), set()
    walls = {color for color, length in lengths.items() if length >= SECOND * longest}
    usual = max(thicknesses[color] for color in walls if lengths[color] == longest)
    return walls, {color for color in walls if thicknesses[color] < PANEL * usual}


def measured_walls(solid: shapely.Geometry) -> tuple[Array, Array]:
    """Measure how long and how thick the parts of solids are, each (n,), if they are long and thin."""
    parts = parts_of(solid)
    length = shapely.length(parts) / 2.0
    return length, shapely.area(parts) / np.where(length > 0.0, length, 1.0)


def open_shares(parts: NDArray[np.object_], thickness: float) -> Array:
    """Tell which shares of areas are thicker than this, (n,)."""
    parts = shapely.simplify(parts, COARSE * thickness)  # an outline in a photo has thousands of vertices
    inner = shapely.buffer(parts, -thickness / 2.0, join_style="mitre")
    opened = shapely.buffer(inner, thickness / 2.0, join_style="mitre")
    return np.asarray(shapely.area(opened) / shapely.area(parts))


def painted_thickness(solid: shapely.Geometry) -> float:
    """Tell how thick walls are painted, those that are thicker than most."""
    length, thick = measured_walls(solid)
    return PAINTED * float(np.average(thick, weights=length))


def greatest_thickness(lines: shapely.Geometry, door_width: float | None, diagonal: float) -> float | None:
    """Tell how far apart the faces of the thickest wall are; None if walls seem to be single lines."""
    if door_width is not None:
        return DOOR_SHARE * door_width
    return paired_distance(straight(shapely.union_all(lines)), diagonal)


def paired_distance(ends: Array, diagonal: float) -> float | None:
    """Find the distance at which most of what is straight has a parallel partner; None if it is not most."""
    steps = ends[:, 1] - ends[:, 0]
    lengths = np.hypot(*steps.T)
    long = lengths > PAIR[1] * diagonal
    ends, steps, lengths = ends[long], steps[long], lengths[long]
    if len(ends) < 2:
        return None
    along = steps / lengths[:, None]
    lines = shapely.linestrings(ends)
    first, second = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=PAIR[1] * diagonal)
    turned = np.abs(along[first, 0] * along[second, 1] - along[first, 1] * along[second, 0])
    offset = ends[second].mean(axis=1) - ends[first, 0]
    apart = np.abs(along[first, 0] * offset[:, 1] - along[first, 1] * offset[:, 0])
    reach = np.einsum("kij,kj->ki", ends[second] - ends[first, :1], along[first])
    common = np.clip(
        np.minimum(reach.max(axis=1), lengths[first]) - np.maximum(reach.min(axis=1), 0.0), 0.0, None
    )
    pairs = (first != second) & (turned < np.sin(PARALLEL)) & (apart >= PAIR[0] * diagonal) & (common > 0.0)
    pairs &= apart <= PAIR[1] * diagonal
    if not pairs.any():
        return None
    bins = np.geomspace(*PAIR, 18)
    shares = np.histogram(apart[pairs] / diagonal, bins, weights=common[pairs])[0] / lengths.sum()
    shares = shares + np.append(shares[1:], 0.0)  # a wall may fall between two bins
    if shares.max() < PAIRED:
        return None
    many = shares >= SECOND * shares.max()
    many[bins[:-1] > OUTER * bins[np.argmax(shares)]] = False  # stairs and rooms are parallel, too
    thickest = int(np.flatnonzero(many)[-1])
    return float(1.15 * bins[min(thickest + 2, 17)] * diagonal)


def filled_between(lines: shapely.Geometry, solid: shapely.Geometry, thickness: float) -> shapely.Geometry:
    """Fill what lies between lines and solids no farther apart than a wall is thick, by closing.

    Short lines that this covers without them are hatching; their square ends would make teeth.
    """
    hair = HAIR * thickness
    pieces = shapely.linestrings(without_scribble(joined(straight(lines), FINE * hair), SCRIBBLE * thickness))
    bars = shapely.buffer(pieces, thickness / 2.0, cap_style="square")
    grown = shapely.buffer(solid, thickness / 2.0, join_style="mitre")
    long = shapely.length(pieces) >= thickness
    both = shapely.union_all([*bars[long], grown])
    closed = shapely.buffer(both, hair - thickness / 2.0, join_style="mitre")
    shapely.prepare(closed)
    short = ~long & ~shapely.covers(closed, pieces)
    if short.any():
        both = shapely.union_all([*bars[short], both])
        closed = shapely.buffer(both, hair - thickness / 2.0, join_style="mitre")
    opened = shapely.buffer(shapely.buffer(closed, -2.0 * hair, join_style="mitre"), hair, join_style="mitre")
    return shapely.simplify(shapely.union(opened, solid), hair)


def without_crumbs(solid: shapely.Geometry, thickness: float) -> shapely.Geometry:
    """Leave out small solids that stand alone."""
    parts = parts_of(solid)
    large = np.array([extent(part) >= CRUMB * thickness for part in parts], dtype=bool)
    return shapely.multipolygons(parts[large]) if large.any() else NOTHING


def extent(shape: shapely.Geometry) -> float:
    """Return the diagonal of a shape's bounds."""
    left, bottom, right, top = shapely.bounds(shape).tolist()
    return float(np.hypot(right - left, top - bottom))


def enclosed(solid: shapely.Geometry, lines: shapely.Geometry, gap: float) -> float:
    """Measure the area that solids and lines enclose once gaps are closed."""
    bars = shapely.linestrings(on_grid(straight(lines), COARSE * gap))  # of hatching many become one
    pieces = np.concatenate([parts_of(solid), bars])  # one by one: all at once takes 20 times as long
    grown = shapely.union_all(shapely.buffer(pieces, gap / 2.0, quad_segs=2))
    rings: NDArray[np.object_] = np.array(
        [
            shapely.Polygon(ring)
            for part in parts_of(grown)
            if part.geom_type == "Polygon"
            for ring in part.interiors
        ]
    )
    return (
        float(shapely.area(shapely.buffer(shapely.union_all(rings), gap / 2.0)).sum()) if len(rings) else 0.0
    )


def are_walls(solid: shapely.Geometry, lines: shapely.Geometry, gap: float, least: float = ENCLOSING) -> bool:
    """Tell whether solids are the walls of a plan: they enclose its rooms, `least` of what all lines do."""
    inside = enclosed(solid, NOTHING, gap)
    return inside > 0.0 and inside >= least * enclosed(solid, lines, gap)


def rings_of(solid: shapely.Geometry) -> list[shapely.LinearRing]:
    """List the outlines of solids, and holes the other way round."""
    parts = [part for part in parts_of(solid) if part.geom_type == "Polygon"] if solid is not NOTHING else []
    return [ring for part in shapely.orient_polygons(parts) for ring in (part.exterior, *part.interiors)]
