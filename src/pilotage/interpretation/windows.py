"""Tell windows from furniture and from doors that are drawn shut, between painted walls."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.interpretation.bars import NEAR
from pilotage.interpretation.paint import NOTHING, Seen, parts_of, shapes_of
from pilotage.interpretation.pieces import joined, straight
from pilotage.interpretation.sheet import Color, Role
from pilotage.interpretation.solids import COARSE, HAIR, SLENDER, extent, lightness, measured_walls
from pilotage.interpretation.touching import find_touching

PANES = 3
"""A window is drawn with so many lines or more from jamb to jamb: faces of its wall, and panes between."""

LIGHT, BLUE = 0.6, 0.15
"""Glass is painted in a color at least so light, and with so much less red than blue, 0 to 1."""

RUNNING = 0.9
"""A wall runs on through a window if it does so over this share of the window's diagonal."""

DEEP = 1.2
"""They lie within so many thicknesses of a wall."""


def on_single_walls(
    seen: Sequence[Seen], named: Mapping[int, tuple[Role, str]], diagonal: float
) -> list[Seen]:
    """Take windows for one line where the walls beside them are single lines that are named walls.

    A window is left out where such a wall runs on through it: it is a sign, and closes nothing. Marks that
    touch each other draw one window.
    """
    walls, windows = (
        [mark for mark in seen if mark.number in named and named[mark.number][0] is role]
        for role in (Role.WALL, Role.WINDOW)
    )
    if not walls or not windows:
        return list(seen)
    touching = rustworkx.PyGraph()
    touching.add_nodes_from(range(len(windows)))
    touching.add_edges_from_no_data(list(map(tuple, find_touching(windows, diagonal).T.tolist())))
    groups = [sorted(group) for group in rustworkx.connected_components(touching)]
    outlines = shapes_of(windows)[0]
    hulls = shapely.convex_hull([shapely.union_all(outlines[group]) for group in groups])
    lines = shapely.STRtree(parts_of(shapes_of(walls)[0]))
    changed: dict[int, shapely.Geometry] = {}
    for group, hull, is_sign in zip(groups, hulls, run_through(hulls, lines), strict=True):
        middle = NOTHING if is_sign else between_ends(hull, lines, NEAR * diagonal)
        if middle is not None:
            changed.update(dict.fromkeys((windows[place].number for place in group), NOTHING))
            changed[windows[group[0]].number] = middle
    return [
        mark if mark.number not in changed else replace(mark, line=changed[mark.number], whole=False)
        for mark in seen
        if changed.get(mark.number) is not NOTHING
    ]


def run_through(hulls: NDArray[np.object_], walls: shapely.STRtree) -> NDArray[np.bool_]:
    """Tell through which windows, by their hulls (n,), a line of a wall runs on, (n,)."""
    found, along = walls.query(hulls, predicate="intersects")
    inside = shapely.length(shapely.intersection(hulls[found], walls.geometries[along]))
    through = np.bincount(found, inside, len(hulls))
    return np.asarray(through >= RUNNING * np.array([extent(hull) for hull in hulls]))


def between_ends(hull: shapely.Geometry, walls: shapely.STRtree, near: float) -> shapely.Geometry | None:
    """Return the middle line of a window if walls meet both its ends there and at no corner; None if not."""
    corners = shapely.get_coordinates(shapely.oriented_envelope(hull))[:4]
    if len(corners) < 4:
        return None
    if np.hypot(*(corners[1] - corners[0])) > np.hypot(*(corners[2] - corners[1])):
        corners = np.roll(corners, -1, axis=0)
    ends = np.array([corners[:2].mean(axis=0), corners[2:].mean(axis=0)])
    meets, _ = walls.query(shapely.points(np.vstack([ends, corners])), predicate="dwithin", distance=near)
    return shapely.linestrings(ends) if set(meets.tolist()) == {0, 1} else None


def without_slivers(solid: shapely.Geometry, width: float) -> shapely.Geometry:
    """Leave out what is thinner than a width: leaves of doors that are painted like walls."""
    inner = shapely.buffer(solid, -width / 2.0, join_style="mitre")
    left = parts_of(shapely.intersection(shapely.buffer(inner, 0.51 * width, join_style="mitre"), solid))
    return shapely.multipolygons(left[shapely.get_dimensions(left) == 2])  # where both touch there are lines


def windows(
    filled: shapely.Geometry,
    solid: shapely.Geometry,
    glass: shapely.Geometry,
    thickness: float,
    widest: float,
) -> tuple[shapely.Geometry, shapely.Geometry]:
    """Tell windows from doors that are drawn shut, in this order, among what lies between solids.

    Both lead from wall to wall and are as thin. A window has the outside on one side, or is named so: then it
    touches the `glass`. What has rooms on both sides is a door, if it is not wider than any, and what stands
    at a wall is furniture.
    """
    hair = HAIR * thickness
    reach, grown = (shapely.buffer(solid, share * hair, join_style="mitre") for share in (1.0, 2.0))
    bridges, named = [], []
    shapely.prepare(glass)
    for part in parts_of(shapely.difference(filled, reach)):
        if part.geom_type != "Polygon":
            continue
        if glass.intersects(part):
            named.append(shapely.buffer(part, 2.0 * hair, join_style="mitre"))
        elif part.area <= thickness * part.length / 2.0:
            contact = shapely.line_merge(shapely.intersection(shapely.boundary(part), grown))
            if shapely.get_num_geometries(contact) > 1:
                bridges.append(shapely.buffer(part, 2.0 * hair, join_style="mitre"))
    within = shapely.buffer(building(shapely.union_all([solid, *named, *bridges]), widest), -thickness)
    shapely.prepare(within)
    are_doors = [extent(part) <= widest and within.contains(part) for part in bridges]
    doors, glazed = (
        [part for part, is_door in zip(bridges, are_doors, strict=True) if is_door is kind]
        for kind in (True, False)
    )
    return shapely.union_all([*glazed, *named]), shapely.union_all(doors)


def is_glass(area: shapely.Geometry, color: Color) -> bool:
    """Tell whether a fill without a line is painted as a window: light blue, long and narrow."""
    length, thick = measured_walls(area)
    is_blue = color[2] - color[0] >= BLUE and lightness(color) >= LIGHT
    return is_blue and bool((length > SLENDER * thick).all())


def painted_glass(glass: shapely.Geometry, solid: shapely.Geometry, thickness: float) -> shapely.Geometry:
    """Return what of windows is painted over a wall, and narrow: it closes the wall again."""
    reach = shapely.buffer(solid, HAIR * thickness)
    shapely.prepare(reach)
    areas = [part for part in parts_of(glass) if part.geom_type == "Polygon" and reach.intersects(part)]
    return shapely.union_all([area for area in areas if area.area <= DEEP * thickness * area.length / 2.0])


def panes(
    lines: shapely.Geometry, solid: shapely.Geometry, thickness: float, widest: float
) -> shapely.Geometry:
    """Fill windows: three lines or more that lead from jamb to jamb, within the thickness of a wall."""
    hair = HAIR * thickness
    whole = shapely.linestrings(joined(straight(lines), hair))
    touching = whole[shapely.STRtree(whole).query(solid, predicate="intersects")]
    pieces = parts_of(shapely.difference(shapely.multilinestrings(touching), solid))
    reach = shapely.buffer(solid, hair)
    shapely.prepare(reach)
    from_jambs = shapely.intersects(reach, shapely.get_point(pieces, 0))
    from_jambs &= shapely.intersects(reach, shapely.get_point(pieces, -1))
    lengths = shapely.length(pieces)
    pieces = pieces[from_jambs & (lengths > thickness) & (lengths <= widest)]
    found = []
    for group in parts_of(shapely.union_all(shapely.buffer(pieces, thickness / 2.0, cap_style="flat"))):
        own = pieces[shapely.intersects(group, pieces)]
        window = shapely.convex_hull(shapely.multilinestrings(own))
        if len(own) >= PANES and window.area <= DEEP * thickness * shapely.length(own).max():
            found.append(shapely.buffer(window, 2.0 * hair, join_style="mitre"))
    return shapely.union_all(found)


def building(walls: shapely.Geometry, gap: float) -> shapely.Geometry:
    """Return all that lies within the outer walls, openings up to a gap wide closed."""
    coarse = shapely.simplify(parts_of(walls), COARSE * gap)
    grown = shapely.buffer(coarse, gap / 2.0, quad_segs=2)
    outlines = [shapely.Polygon(part.exterior) for part in parts_of(shapely.union_all(grown))]
    return shapely.buffer(shapely.union_all(outlines), -gap / 2.0, join_style="mitre")
