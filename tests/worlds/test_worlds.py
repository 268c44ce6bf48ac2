"""The packed buildings hold together: each can be driven, and its drawings can be read and divided."""

import functools
import json
import runpy
import sys
from pathlib import Path

import numpy as np
import pytest
import shapely

from pilotage import open_map, worlds
from pilotage.evaluation.rooms import read_drawn_rooms, read_world_rooms
from pilotage.evaluation.warp import read_warp
from pilotage.io.world import open_world
from pilotage.maps import DecompositionSettings, decompose, find_labeled
from pilotage.simulation.ways import Ways

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
HANDS = ("careful", "quick")
DRAWINGS = [(packed, hand) for packed in worlds.ALL for hand in HANDS]
BODY = 0.25  # [m] radius that must come everywhere
WALKER = 0.3  # [m] that a person must keep from walls and furniture

every_building = pytest.mark.parametrize("packed", worlds.ALL, ids=lambda packed: packed.name)
every_drawing = pytest.mark.parametrize(
    ("packed", "hand"), DRAWINGS, ids=[f"{packed.name}-{hand}" for packed, hand in DRAWINGS]
)


@functools.cache
def drawing(packed, hand):
    return open_map(packed.folder / f"{hand}.svg")


@functools.cache
def divided(packed, hand):
    return decompose(drawing(packed, hand), DecompositionSettings())


def places(packed, hand):
    """Where the middle of each labeled cell lies in the building [m]."""
    sketch, graph = drawing(packed, hand), divided(packed, hand)
    middles = np.array([find_labeled(graph, label.text) for label in sketch.labels])
    return read_warp(packed.folder / f"{hand}.json", sketch).world_from_sketch(middles)


@every_building
def test_a_building_is_lived_in(packed):
    world = open_world(packed.world)

    assert world.start is not None
    assert 1 <= len(world.glass)
    assert 1 <= len(world.doors) <= 2
    assert all(door.closed and not door.never_opens for door in world.doors)
    assert 2 <= len(world.people)


@every_building
def test_people_do_not_walk_through_things(packed):
    world = open_world(packed.world)
    for person in world.people:
        way = shapely.segmentize(shapely.LineString(person.path.ring), 0.1)

        assert world.is_free(shapely.get_coordinates(way), WALKER).all()


@every_building
def test_nobody_stands_where_the_drive_begins(packed):
    world = open_world(packed.world)
    start = shapely.Point(world.start.position)

    assert world.is_free([world.start.position], BODY).all()
    assert all(shapely.LineString(person.path.ring).distance(start) > 0.6 for person in world.people)


@every_drawing
def test_every_room_can_be_reached_from_the_start(packed, hand):
    world = open_world(packed.world)
    ways = Ways.among(world.solid_grid, BODY)
    goals = places(packed, hand)

    assert world.is_free(goals, BODY).all()
    assert all(np.isfinite(ways.shortest(world.start.position, goal).length) for goal in goals)


@every_drawing
def test_each_named_room_is_a_cell(packed, hand):
    graph = divided(packed, hand)
    words = [cell.label for cell in graph.cells if cell.label]
    rooms = read_world_rooms(packed.folder / "rooms.geojson").names

    assert len(rooms) - 1 <= len(words) == len(set(words))
    assert set(words) <= set(rooms)
    assert len(graph.cells) <= 1.4 * len(rooms)


@every_drawing
def test_the_middle_of_a_cell_lies_in_the_room_of_its_name(packed, hand):
    names = tuple(label.text for label in drawing(packed, hand).labels)

    assert names == read_world_rooms(packed.folder / "rooms.geojson").names_at(places(packed, hand))


@every_drawing
def test_rooms_carried_to_the_drawing_are_the_rooms_drawn(packed, hand):
    sketch = drawing(packed, hand)
    warp = read_warp(packed.folder / f"{hand}.json", sketch)
    rooms = read_world_rooms(packed.folder / "rooms.geojson")
    drawn = read_drawn_rooms(packed.folder / f"{hand}.json")
    for name, polygon in zip(rooms.names, rooms.polygons, strict=True):
        outline = shapely.get_coordinates(drawn.polygons[drawn.names.index(name)].exterior)
        expected = shapely.Polygon(sketch.sketch_from_file(outline))
        edge = shapely.get_coordinates(shapely.segmentize(polygon.exterior, 0.5))
        carried = shapely.Polygon(warp.sketch_from_world(edge))

        assert 0.85 < carried.intersection(expected).area / carried.union(expected).area


@every_building
def test_the_quick_drawing_is_farther_from_the_truth_than_the_careful_one(packed):
    stretch = {
        hand: np.median(
            np.linalg.cond(read_warp(packed.folder / f"{hand}.json", drawing(packed, hand)).there.maps[:, :2])
        )
        for hand in HANDS
    }

    assert stretch["careful"] < 1.1 < stretch["quick"] < 1.6


def test_the_script_makes_the_packed_files_again(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["make_worlds.py", str(tmp_path)])
    monkeypatch.syspath_prepend(str(EXAMPLES))
    runpy.run_path(str(EXAMPLES / "make_worlds.py"), run_name="__main__")
    made = sorted(path.relative_to(tmp_path) for path in tmp_path.rglob("*.*"))

    assert 3 * 6 == len(made)
    for path in made:
        packed = worlds.OFFICE.folder.parent / path
        if path.suffix == ".svg":
            assert packed.read_text() == (tmp_path / path).read_text()
        else:
            assert json.loads(packed.read_text()) == json.loads((tmp_path / path).read_text())
