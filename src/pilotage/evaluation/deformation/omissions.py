"""What people change and leave out: doors, passages, rooms, niches."""

from dataclasses import dataclass, replace

import numpy as np
import rustworkx as rx
import shapely
from numpy.typing import NDArray

from pilotage.evaluation.deformation.doors import (
    Opening,
    all_lines,
    find_openings,
    gap_at,
    neighbors,
    walls_between,
)
from pilotage.evaluation.deformation.plan import Plan
from pilotage.evaluation.rooms import Rooms
from pilotage.geometry import Array

# Probabilities at severity 1; at severity s they are s times as large, by the same draws.
FORGOTTEN_DOOR = 0.05
SHUT_PASSAGE = 0.05
MOVED_DOOR = 0.35
WRONG_SIDE = 0.08
MISSING_ROOM = 0.12
LINE_CORRIDOR = 0.1

DOOR_WIDTH = 1.0
"""Least width [m] of a door that is drawn elsewhere."""
NICHE = 0.35
"""Depth [m] below which niches are dropped at severity 1."""
SPECK = 0.05
"""Length [m] up to which remains of strokes are rubbed out."""
WALL = 0.4
"""Distance [m] from a room within which strokes are its walls."""
CORRIDOR_WIDTH, CORRIDOR_ASPECT = 3.5, 3.0
"""Greatest width [m] of a corridor, and least ratio of its length to its width."""


@dataclass(frozen=True, eq=False)
class Changed:
    """A plan after a person's omissions, not bent yet."""

    plan: Plan
    lines: tuple[int, ...]  # rooms of the plan whose corridor becomes a line


def change(plan: Plan, severity: float, rng: np.random.Generator) -> Changed:
    """Forget and move doors, shut passages, leave rooms out, drop niches [m]."""
    openings = find_openings(plan.rooms, plan.strokes)
    draws = rng.random((len(openings), 4))
    order, room_draws = rng.permutation(len(plan.rooms.names)), rng.random((len(plan.rooms.names), 2))
    strokes = plan.strokes
    for opening, draw in zip(openings, draws, strict=True):
        strokes = _redrawn_opening(plan.rooms, strokes, opening, draw, severity)
    missing = _missing_rooms(plan.rooms, openings, order, room_draws[:, 0] < severity * MISSING_ROOM)
    strokes = _without_rooms(plan.rooms, strokes, openings, missing)
    lines = tuple(
        k
        for k, room in enumerate(plan.rooms.polygons)
        if k not in missing and room_draws[k, 1] < severity * LINE_CORRIDOR and is_corridor(room)
    )
    strokes = shapely.simplify(strokes, severity * NICHE)
    strokes = shapely.MultiLineString([line for line in all_lines(strokes) if line.length > SPECK])
    kept = [k for k in range(len(plan.rooms.names)) if k not in missing]
    rooms = Rooms(tuple(plan.rooms.names[k] for k in kept), tuple(plan.rooms.polygons[k] for k in kept))
    return Changed(replace(plan, strokes=strokes, rooms=rooms), tuple(kept.index(k) for k in lines))


def _redrawn_opening(
    rooms: Rooms, strokes: shapely.MultiLineString, opening: Opening, draw: Array, severity: float
) -> shapely.MultiLineString:
    """Draw one opening as a person might."""
    shut = FORGOTTEN_DOOR if opening.is_door else SHUT_PASSAGE
    if draw[0] < severity * shut:
        return shapely.union(strokes, opening.barrier)
    if not opening.is_door:
        return strokes
    width = max(opening.line.length, DOOR_WIDTH)
    if draw[1] < severity * WRONG_SIDE:
        walls = _other_walls(rooms, strokes, opening)
    elif draw[2] < severity * MOVED_DOOR:
        walls = walls_between(rooms, strokes, *opening.rooms)
    else:
        return strokes
    if not walls:
        return strokes
    wall = walls[int(draw[3] * len(walls))]
    shut_up = shapely.union(strokes, opening.barrier)
    return shapely.difference(shut_up, gap_at(wall, draw[3] * len(walls) % 1.0, width))


def _other_walls(
    rooms: Rooms, strokes: shapely.MultiLineString, opening: Opening
) -> list[shapely.LineString]:
    """Find the walls of the smaller room of an opening towards rooms other than the one it leads to."""
    small, large = sorted(opening.rooms, key=lambda room: float(rooms.polygons[room].area))
    return [
        wall
        for pair in neighbors(rooms)
        if small in pair and large not in pair
        for wall in walls_between(rooms, strokes, *pair)
    ]


def _missing_rooms(
    rooms: Rooms, openings: list[Opening], order: NDArray[np.intp], forgotten: NDArray[np.bool_]
) -> frozenset[int]:
    """Choose the rooms that are left out, so that the others stay joined as they were."""
    graph = rx.PyGraph()
    graph.add_nodes_from(range(len(rooms.names)))
    graph.add_edges_from_no_data(sorted({opening.rooms for opening in openings}))
    missing: set[int] = set()
    for room in order.tolist():
        if forgotten[room] and room not in rx.articulation_points(graph):
            graph.remove_node(room)
            missing.add(room)
    return frozenset(missing)


def _without_rooms(
    rooms: Rooms, strokes: shapely.MultiLineString, openings: list[Opening], missing: frozenset[int]
) -> shapely.MultiLineString:
    """Rub rooms out, and shut what led to them."""
    if not missing:
        return strokes
    others = [room for k, room in enumerate(rooms.polygons) if k not in missing]
    gone = shapely.difference(
        shapely.buffer(shapely.union_all([rooms.polygons[k] for k in missing]), WALL),
        shapely.buffer(shapely.union_all(others), WALL),
    )
    shut = [one.barrier for one in openings if len(missing.intersection(one.rooms)) == 1]
    return shapely.union(shapely.difference(strokes, gone), shapely.MultiLineString(shut))


def is_corridor(room: shapely.Polygon) -> bool:
    """Tell whether a room is narrow and long."""
    width, length = sides_of(room)
    return width <= CORRIDOR_WIDTH and length >= CORRIDOR_ASPECT * width


def sides_of(room: shapely.Polygon) -> tuple[float, float]:
    """Return the sides of the smallest rectangle around a room, the shorter first."""
    corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(room))
    sides = np.hypot(*np.diff(corners, axis=0)[:2].T)
    return float(sides.min()), float(sides.max())
