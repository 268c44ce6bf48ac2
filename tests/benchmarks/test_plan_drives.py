"""Copies by hand, made by program, show the rooms and doors of their plan."""

import numpy as np
import pytest
import shapely
from benchmarks.lib.hand_copies import areas_of, copy_by_hand, save_photo, single_lines
from benchmarks.plan_drives import joined_cells, rooms_of

from buildings import CORRIDOR_AND_FOUR_ROOMS
from pilotage.geometry import Polyline
from pilotage.io import open_map
from pilotage.maps import DecompositionSettings, SchematicMap, decompose

THICK = 0.3
UNIT = 0.5  # [m per drawing unit]


@pytest.fixture(scope="module")
def graph():
    """Four rooms on a corridor between walls with a thickness."""
    lines = shapely.MultiLineString(list(CORRIDOR_AND_FOUR_ROOMS))
    walls = shapely.buffer(lines, THICK / 2.0, cap_style="flat", join_style="mitre")
    rings = [ring for wall in shapely.get_parts(walls) for ring in (wall.exterior, *wall.interiors)]
    strokes = tuple(Polyline(shapely.get_coordinates(ring)[:-1], closed=True) for ring in rings)
    return decompose(SchematicMap(strokes, solids=strokes), DecompositionSettings())


@pytest.fixture(scope="module")
def lines(graph):
    return single_lines(graph, joined_cells(graph), UNIT)


def test_each_wall_is_one_line_and_each_door_a_gap(graph, lines):
    middles = UNIT * np.array([gateway.middle for gateway in graph.gateways])
    wall = shapely.box(4.9, 0.5, 5.1, 2.0)  # of two rooms, 30 cm thick on the plan

    assert 4 == len(graph.gateways)
    assert (shapely.distance(shapely.points(middles), lines.strokes) > 0.4 * UNIT).all()
    assert 1.5 == pytest.approx(shapely.intersection(lines.strokes, wall).length, abs=0.1)


def test_rooms_grow_until_they_meet(graph, lines):
    total = sum(room.area for room in lines.rooms.polygons)

    assert shapely.union_all(lines.rooms.polygons).area == pytest.approx(total, rel=1e-3)
    assert total > UNIT**2 * sum(cell.polygon.area for cell in graph.cells)


def test_every_room_is_drawn_whatever_its_walls_are_cut_to(graph, lines):
    mixed = shapely.GeometryCollection([shapely.box(0, 0, 2, 1), shapely.LineString([(2, 0), (5, 0)])])

    assert areas_of(mixed).boundary.equals(shapely.box(0, 0, 2, 1).boundary)
    outlines = shapely.union_all([room.exterior for room in lines.rooms.polygons])
    doors = sum(UNIT * gateway.width for gateway in graph.gateways)
    assert shapely.length(lines.strokes) == pytest.approx(outlines.length - doors, rel=0.02)


def test_a_copy_by_hand_can_be_read_from_its_photo(graph, lines, tmp_path):
    goal = max(rooms_of(graph), key=lambda cell: cell.polygon.area)
    copy = copy_by_hand(lines, goal.cell_id, UNIT, severity=0.1, seed=0)
    save_photo(copy, tmp_path / "copy.jpg")
    sketch = open_map(tmp_path / "copy.jpg")
    read = decompose(sketch, DecompositionSettings())
    there = sketch.sketch_from_file(copy.photo_from_plan(np.array([cell.center for cell in graph.cells])))

    assert len({read.cell_at(tuple(point)) for point in there.tolist()}) == len(graph.cells)
    assert 4 == len(read.gateways)
