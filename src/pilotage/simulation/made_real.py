"""A building made up from a drawing: other proportions, furniture, doors that close, and people.

So anyone can drive with nothing but a drawing. The robot gets the drawing; the building is as little like it
as the severity asks for, from 0, which is the drawing itself, to 1.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from shapely.affinity import translate

from pilotage.geometry import Array, Polyline, Pose2
from pilotage.maps import Atlas, Cell, CellGraph
from pilotage.maps.routing.forgotten_doors import ForgottenDoor
from pilotage.maps.routing.places import connected_cells
from pilotage.simulation.people import Person
from pilotage.simulation.proportions import Proportions
from pilotage.simulation.scene import Door
from pilotage.simulation.simulator import StartError
from pilotage.simulation.world import World

Point = tuple[float, float]

NARROWEST = 0.9
"""Width [m] to which the narrowest drawn passage is widened, with all the building."""
MOST_WIDENING = 2.0
"""Largest factor of that widening."""
DOOR = 1.0
"""Width [m] of a usual door: narrow passages tell how large a building is meant to be."""
TRUST_IN_DOORS = math.log(1.6)
"""Largest logarithm of the ratio of the scale by doors to that by size and clearance, the robot's guess."""
WIDEST_DOOR = 2.5
"""A gateway wider than this [m] has no leaf."""
ROBOT = 0.35
"""Free space [m] left beside what is put into a room: the radius of a robot and a little more."""
BEFORE_DOOR = 1.0
"""Distance [m] of furniture from gateways."""
AREA_A_PIECE = 5.0
"""Area of a room [m²] that gets one piece of furniture at severity 1."""
MOST_PIECES = 500
"""Pieces of furniture in a building at severity 1, at most: in larger ones they stand farther apart."""
DEPTH, LENGTH = (0.35, 0.8), (0.5, 1.8)
"""Least and greatest depth and length [m] of a piece of furniture."""
AT_WALL, OFF_WALL = 0.7, (1.0, 3.0)
"""Share of furniture with its back to a wall, and how far [m] the rest stands off: room to walk behind it."""
ROUNDING = 0.02
"""Distance [m] by which furniture may reach over the outline of its room: it touches the wall."""
LEAST_LEFT = 0.55
"""Furniture leaves free at least this share of the space in which a robot can be."""
AREA_A_PERSON = 90.0
"""Area [m²] with one person at severity 1."""
MOST_PEOPLE, LEAST_WALK, WALKING_SPEEDS = 6, 2.0, (0.5, 1.1)
"""People in a building, at most; the shortest path of one [m]; the least and greatest speed [m/s]."""
CLOSES = 0.25
"""Probability that a door closes for a while, at severity 1."""
CLOSES_AFTER, CLOSED_FOR = (20.0, 200.0), (20.0, 60.0)
"""Least and greatest time [s] until such a door closes, and for which it is then closed."""
START_ROOM = 0.1
"""Free space [m] beside the robot where it starts."""
START_TRIES = 100
"""Places tried for its start."""
TRIES = 12
"""Places tried for each piece of furniture and person."""


@dataclass(frozen=True, eq=False)
class MadeReal:
    """A building, and where a place of the drawing is in it."""

    world: World  # with a start
    proportions: Proportions


def make_real(
    atlas: Atlas,
    severity: float,
    rng: np.random.Generator,
    *,
    goal: Point | None = None,
    start: Point | None = None,
    heading: float | None = None,
    radius: float = 0.2,
) -> MadeReal:
    """Make a building of a drawing that has cells, for a robot of this radius [m].

    The robot truly begins at `start` [drawing units, y up], or somewhere from where one can go to the `goal`,
    and in another room if there is one. Raises StartError if it cannot stand there.
    """
    assert atlas.joined is not None
    assert atlas.cell_graph is not None
    graph = atlas.joined.graph
    proportions = proportions_of(atlas, graph, severity, rng)
    doorways, drawn_walls = cut_doors(atlas.sketch.segments, atlas.joined.doors, rng)
    walls = proportions.bent(drawn_walls)
    doorways += [gateway.segment for gateway in atlas.cell_graph.gateways]
    openings = [proportions.world_from_sketch(doorway) for doorway in doorways]
    kept_free = [proportions.world_from_sketch(np.array([place]))[0] for place in (goal, start) if place]
    rooms = [carried_cell(cell, proportions) for cell in atlas.cell_graph.cells]
    rng_things, rng_doors, rng_people, rng_start = rng.spawn(4)
    area_a_piece = max(AREA_A_PIECE, sum(room.area for room in rooms) / MOST_PIECES)
    rate = severity / area_a_piece
    things = [piece for room in rooms for piece in furnish(room, openings, kept_free, rate, rng_things)]
    world = World(
        np.vstack([walls, *(outline_of(thing) for thing in things)]),
        doors=tuple(hang_doors(openings, severity, rng_doors)),
        people=tuple(invite(rooms, things, severity, rng_people)),
    )
    places = [kept_free[-1]] if start else candidates(graph, rooms, goal, rng_start)
    return MadeReal(replace(world, start=stand(world, places, heading, radius, rng_start)), proportions)


def cut_doors(
    walls: Array, doors: Sequence[ForgottenDoor], rng: np.random.Generator
) -> tuple[list[Array], Array]:
    """Cut forgotten doors into walls (n, 4), each at random along its wall; all in drawing units.

    Returns the doors, each (2, 2), and the walls that are left.
    """
    if not doors:
        return [], walls
    shifts = [rng.uniform(-1.0, 1.0) * door.leeway for door in doors]
    pairs = list(zip(doors, shifts, strict=True))
    gone = shapely.union_all([translate(door.opening, *shift.tolist()) for door, shift in pairs])
    left = shapely.difference(shapely.linestrings(walls.reshape(-1, 2, 2)), gone)
    ends = [
        shapely.get_coordinates(piece)[[0, -1]] for piece in shapely.get_parts(left) if piece.length > 0.0
    ]
    return [door.segment + shift for door, shift in pairs], np.array(ends).reshape(-1, 4)


def proportions_of(atlas: Atlas, graph: CellGraph, severity: float, rng: np.random.Generator) -> Proportions:
    """Draw proportions in which a robot fits through all passages, if the drawing allows it."""
    drawn = Proportions.at_random(atlas.sketch.bounds, scale_of(atlas, graph), severity, rng)
    widths = [width_of(drawn.world_from_sketch(gateway.segment)) for gateway in graph.gateways]
    narrowest = max(min(widths, default=NARROWEST), 1e-6)
    return drawn.scaled(min(max(NARROWEST / narrowest, 1.0), MOST_WIDENING))


def scale_of(atlas: Atlas, graph: CellGraph) -> float:
    """Choose how large the building is [m per drawing unit]: as the drawing says, else as its doors say."""
    if atlas.sketch.metres_per_unit is not None:
        return atlas.sketch.metres_per_unit
    if not graph.gateways:
        return math.exp(-atlas.log_scale)
    by_doors = math.log(float(np.quantile([gateway.width for gateway in graph.gateways], 0.25)) / DOOR)
    off = min(max(by_doors - atlas.log_scale, -TRUST_IN_DOORS), TRUST_IN_DOORS)
    return math.exp(-(atlas.log_scale + off))


def width_of(opening: Array) -> float:
    """Measure an opening (2, 2) [m]."""
    return float(np.hypot(*(opening[1] - opening[0])))


def carried_cell(cell: Cell, proportions: Proportions) -> shapely.Polygon:
    """Carry a cell to the world; its outline runs counter-clockwise."""
    carried = shapely.transform(cell.polygon, proportions.world_from_sketch)
    return shapely.orient_polygons(shapely.make_valid(carried) if not carried.is_valid else carried)


def furnish(
    room: shapely.Polygon,
    openings: Sequence[Array],
    kept_free: Sequence[Array],
    rate: float,
    rng: np.random.Generator,
) -> list[shapely.Polygon]:
    """Put furniture along the walls of a room, and some into it, so that a robot still gets everywhere.

    The `rate` is how many pieces are tried for each square metre.
    """
    pieces: list[shapely.Polygon] = []
    space = room.buffer(-ROBOT)
    least = LEAST_LEFT * space.area
    doors = shapely.union_all([shapely.LineString(opening) for opening in openings])
    places = shapely.multipoints(np.array(kept_free).reshape(-1, 2))
    for _ in range(rng.poisson(rate * room.area)):
        for _ in range(TRIES):
            piece = place_piece(room, rng)
            left = space.difference(piece.buffer(ROBOT))
            is_clear = piece.distance(doors) > BEFORE_DOOR if openings else True
            is_clear = is_clear and (not kept_free or piece.distance(places) > BEFORE_DOOR)
            is_whole = left.geom_type == "Polygon" and left.area >= least
            if is_clear and is_whole and room.buffer(ROUNDING).covers(piece):
                pieces.append(piece)
                space = left
                break
    return pieces


def place_piece(room: shapely.Polygon, rng: np.random.Generator) -> shapely.Polygon:
    """Propose a piece of furniture: mostly with its back to a wall."""
    ring = shapely.get_coordinates(room.exterior)
    sides = np.diff(ring, axis=0)
    lengths = np.hypot(sides[:, 0], sides[:, 1])
    k = int(rng.choice(len(sides), p=lengths / lengths.sum()))
    along = sides[k] / max(lengths[k], 1e-9)
    inward = np.array([-along[1], along[0]])  # outlines run counter-clockwise
    depth, length = rng.uniform(*DEPTH), rng.uniform(*LENGTH)
    off_wall = 0.0 if rng.random() < AT_WALL else rng.uniform(*OFF_WALL)
    foot = ring[k] + rng.random() * sides[k] + off_wall * inward
    half = 0.5 * length * along
    return shapely.Polygon(
        [foot - half, foot + half, foot + half + depth * inward, foot - half + depth * inward]
    )


def outline_of(piece: shapely.Polygon) -> Array:
    """List the sides of a piece of furniture, (n, 4)."""
    ring = shapely.get_coordinates(piece.exterior)
    return np.column_stack([ring[:-1], ring[1:]])


def hang_doors(openings: Sequence[Array], severity: float, rng: np.random.Generator) -> list[Door]:
    """Give narrow passages a door; some close for a while."""
    doors = []
    for opening in openings:
        closes = rng.random() < CLOSES * severity
        since, lasts = rng.uniform(*CLOSES_AFTER), rng.uniform(*CLOSED_FOR)
        if width_of(opening) <= WIDEST_DOOR:
            doors.append(Door(opening.ravel(), ((since, since + lasts),) if closes else ()))
    return doors


def invite(
    rooms: Sequence[shapely.Polygon],
    things: Sequence[shapely.Polygon],
    severity: float,
    rng: np.random.Generator,
) -> list[Person]:
    """Let people walk to and fro in rooms that are long enough, the larger the likelier."""
    areas = np.array([room.area for room in rooms])
    in_the_way = shapely.union_all(things)
    people = []
    for _ in range(min(rng.poisson(severity * areas.sum() / AREA_A_PERSON), MOST_PEOPLE)):
        for _ in range(TRIES):
            room = rooms[int(rng.choice(len(rooms), p=areas / areas.sum()))]
            path = shapely.LineString(random_points(room, 2, rng))
            is_clear = room.buffer(-ROBOT).covers(path) and path.distance(in_the_way) > ROBOT
            if path.length > LEAST_WALK and is_clear:
                people.append(Person(Polyline(shapely.get_coordinates(path)), rng.uniform(*WALKING_SPEEDS)))
                break
    return people


def candidates(
    graph: CellGraph, rooms: Sequence[shapely.Polygon], goal: Point | None, rng: np.random.Generator
) -> Array:
    """Draw places to begin at: in rooms that are joined to that of the goal, but not in it if it can be."""
    parts = connected_cells(graph)
    goal_id = graph.cell_at(goal) if goal else ""
    part = next((part for part in parts if goal_id in part), parts[0])
    ids = sorted(part - {goal_id}) or sorted(part)
    chosen = rng.choice(len(ids), size=START_TRIES)
    return np.vstack([random_points(rooms[graph.index_from_id[ids[k]]], 1, rng) for k in chosen])


def stand(
    world: World,
    places: Sequence[Array] | Array,
    heading: float | None,
    radius: float,
    rng: np.random.Generator,
) -> Pose2:
    """Stand at the first of these places that is free; StartError if none is."""
    for x, y in places:
        if world.is_free([(x, y)], radius + START_ROOM)[0]:
            return Pose2(float(x), float(y), rng.uniform(-math.pi, math.pi) if heading is None else heading)
    raise StartError("a robot must have room where it starts, found a wall or furniture")


def random_points(room: shapely.Polygon, count: int, rng: np.random.Generator) -> Array:
    """Draw points in a room, (count, 2)."""
    left, bottom, right, top = room.bounds
    drawn = rng.uniform((left, bottom), (right, top), size=(40 * count, 2))
    inside = drawn[shapely.contains_properly(room, shapely.points(drawn))]
    deepest = shapely.get_coordinates(room.representative_point())
    return np.vstack([inside[:count], np.repeat(deepest, max(count - len(inside), 0), axis=0)])
