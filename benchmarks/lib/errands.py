"""Choose errands from room to room, spread over a building, the same for all its drawings."""

from collections import Counter
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from benchmarks.lib.sites import Site
from pilotage.geometry import Array, Pose2
from pilotage.simulation import BodySettings

RADIUS = BodySettings().radius
CLEARANCE = 0.3  # [m] about start and goal
SHORTEST = 10.0  # [m] a way that is worth driving
INSIDE = 0.75  # [m] that a goal lies inside its room: at the border centimetres would decide

Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Errand:
    """From a place in one room to a place in another, in the frame of the world [m]."""

    start: Pose2
    goal: tuple[float, float]
    start_room: str
    goal_room: str
    shortest: float  # [m] way that the robot can take


def choose_errands(site: Site, count: int, seed: int) -> list[Errand]:
    """Choose up to `count` pairs of rooms, using each room about equally often.

    Starts are places chosen at random, goals those deepest inside their rooms; both are drawn by every hand
    in the room where they truly are.
    """
    rng = np.random.default_rng(seed)
    members = members_by_room(site)
    pairs = [(a, b) for a in members for b in members if a != b]
    rng.shuffle(pairs)
    errands: list[Errand] = []
    starts, goals = Counter[str](), Counter[str]()
    while pairs and len(errands) < count:
        pair = min(pairs, key=lambda pair: starts[pair[0]] + goals[pair[1]])
        pairs.remove(pair)
        errand = errand_between(site, members, pair, rng)
        if errand is not None:
            errands.append(errand)
            starts[pair[0]] += 1
            goals[pair[1]] += 1
    return errands


def members_by_room(site: Site) -> dict[str, Indices]:
    """Find the poses of each room that can be stood at and are drawn where they are."""
    points = site.poses[:, :2]
    names = site.rooms.names_at(points)
    fit = (site.world.clearance(points) >= CLEARANCE) & (np.array(names) != "")
    for drawing in site.drawings:
        fit &= drawing.shows(points, names)
    return {
        name: found
        for name in site.rooms.names
        if len(found := np.flatnonzero(fit & (np.array(names) == name)))
    }


def errand_between(
    site: Site, members: dict[str, Indices], pair: tuple[str, str], rng: np.random.Generator
) -> Errand | None:
    """Choose places in two rooms; None if no way leads from one to the other, or too short a one.

    The choice depends as little as possible on the program under test, so that errands stay comparable.
    """
    starts, goals = (site.poses[members[room]] for room in pair)
    starts = in_cells(site, rng.permutation(starts))
    inside = depths(site, pair[1], goals[:, :2])
    goals = goals[np.argsort(-inside, kind="stable")][: np.count_nonzero(inside >= INSIDE)]
    goals = in_cells(site, goals)
    if len(starts) == 0 or len(goals) == 0:
        return None
    x, y = goals[0, :2].tolist()
    shortest = site.world.shortest_way(starts[0, :2], goals[0, :2], RADIUS).length
    if not SHORTEST <= shortest < np.inf:
        return None
    return Errand(Pose2(*starts[0].tolist()), (x, y), *pair, shortest)


def in_cells(site: Site, poses: Array) -> Array:
    """Keep the poses (n, 3) that lie in a cell of every drawing."""
    return poses[np.all([drawing.has_cell(poses[:, :2]) for drawing in site.drawings], axis=0)]


def depths(site: Site, room: str, points: Array) -> Array:
    """Measure how far inside a room points (n, 2) lie, (n,) [m]."""
    outline = site.rooms.polygons[site.rooms.names.index(room)].exterior
    return np.asarray(shapely.distance(outline, shapely.points(points)))
