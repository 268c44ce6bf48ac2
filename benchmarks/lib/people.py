"""Thirteen people's sketches of one building, its true plan, and which regions of the two are the same.

`gt_NN_model_simple.dat` lists for each match the centres of regions on the sketch (`map1`) and on the plan
(`map2`), as row and column of the picture. The region of a place is that of the nearest centre in a straight
line, on the sketch and on the plan; a place is right if both are of the same match.
"""

import re
from functools import cache
from pathlib import Path

import numpy as np
import shapely

from benchmarks.lib.data import DATA
from pilotage.evaluation.rooms import Rooms
from pilotage.geometry import Array
from pilotage.io import open_map
from pilotage.maps import SchematicMap
from pilotage.perception import Reading
from pilotage.simulation import LaserSettings, RunSettings, World, simulate

FOLDER = DATA / "people-sketches"
SKETCHED = "sketched"
"""Name of the building."""
SKETCHES = tuple(f"{number:02d}" for number in range(13))
METRES_PER_PIXEL = 0.1
"""The plan tells no scale; so its great hall is 17 m long."""
RADIUS, BEAMS = 0.25, 360
LEGS = 40
"""Ways from place to place that the robot drives in its log."""
OUTER = 5000.0
"""Distance [pixels] that regions reach around the picture."""


@cache
def plan() -> SchematicMap:
    """Read the true plan, in pixels."""
    return open_map(FOLDER / "model_simple.png")


@cache
def world() -> World:
    """Return the building, in metres."""
    return World(plan().segments * METRES_PER_PIXEL, contours=True)


@cache
def run() -> tuple[tuple[Reading, ...], Array]:
    """Drive from place to place through the building: readings, and true positions (n, 2) [m]."""
    rng = np.random.default_rng(0)
    waypoints = [places(1, rng)]
    while len(waypoints) <= LEGS:
        there = places(1, rng)
        way = world().shortest_way(waypoints[-1][-1], there[0], RADIUS)
        if np.isfinite(way.length) and way.length > 1.0:
            waypoints.append(way.points[1:])
    laser = LaserSettings(beams=BEAMS, field_of_view=np.radians(359.0))
    driven = simulate(world(), np.vstack(waypoints), rng, RunSettings(laser=laser))
    return driven.readings, np.array([moment.world_from_base.position for moment in driven.truth])


def places(count: int, rng: np.random.Generator) -> Array:
    """Draw places where the robot can stand, (count, 2) [m]."""
    left, bottom, right, top = world().bounds
    found: list[Array] = []
    while len(found) < count:
        place = rng.uniform((left, bottom), (right, top))
        if world().is_free(place[np.newaxis], 2.0 * RADIUS)[0]:
            found.append(place)
    return np.array(found)


def regions_of(number: str) -> tuple[Rooms, Rooms]:
    """Return the matched regions on a sketch, in pixels of its file, and in the building [m]."""
    on_sketch, on_plan = read_matches(FOLDER / f"gt_{number}_model_simple.dat")
    in_world = {
        name: plan().sketch_from_file(centres) * METRES_PER_PIXEL for name, centres in on_plan.items()
    }
    return regions(on_sketch), regions(in_world)


def read_matches(path: Path) -> tuple[dict[str, Array], dict[str, Array]]:
    """Read the centres of each match, x and y in pixels, on the sketch and on the plan."""
    sides: tuple[dict[str, Array], dict[str, Array]] = ({}, {})
    for block in re.split(r"#\s*\d+match set", path.read_text())[1:]:
        _, first, second = re.split(r"#\s*map[12]", block)
        found = [np.array(text.split(), dtype=np.float64).reshape(-1, 2)[:, ::-1] for text in (first, second)]
        if all(len(centres) for centres in found):
            name = str(len(sides[0]))
            for side, centres in zip(sides, found, strict=True):
                side[name] = centres
    return sides


def regions(centres: dict[str, Array]) -> Rooms:
    """Divide the plane by the nearest centre; a match of several centres has several polygons."""
    names = [name for name, points in centres.items() for _ in points]
    points = shapely.points(np.vstack(list(centres.values())))
    extent = shapely.buffer(shapely.union_all(points), OUTER)
    parts = shapely.get_parts(shapely.voronoi_polygons(shapely.union_all(points), extend_to=extent))
    polygons = parts[shapely.STRtree(parts).nearest(points)]
    return Rooms(tuple(names), tuple(polygons))
