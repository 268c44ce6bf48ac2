"""Floors that are painted below the walls: where they end, the building ends."""

import pytest

from flats import BLACK, box, graph_of
from pilotage.interpretation import Text

FLOOR = (0.9, 0.9, 0.9)
ROOMS = [
    (0, 78, 100, 80),
    (0, 0, 2, 80),
    (98, 0, 100, 80),
    (49, 0, 51, 80),
    (0, 0, 23, 2),
    (28, 0, 72, 2),
    (77, 0, 100, 2),
]
WALLS = tuple(box(*corners, fill=BLACK) for corners in ROOMS)
NAMES = (Text("bath", (25.0, 40.0), 3.0), Text("hall", (75.0, 40.0), 3.0), Text("walk", (50.0, -8.0), 3.0))


def beside_walk(marks):
    """Name the rooms that are joined with the walk, through doorways or at once; none if there is no walk."""
    graph = graph_of(marks, NAMES)
    walks = [cell.cell_id for cell in graph.cells if cell.label == "walk"]
    near = {cell.cell_id for walk in walks for cell in graph.neighbors(walk)}
    behind = {cell.cell_id for name in near for cell in graph.neighbors(name)}
    return {graph.cell(name).label for name in near | behind} & {"bath", "hall"}


@pytest.mark.parametrize("color", [FLOOR, (0.96, 0.96, 0.96)])
def test_a_walk_on_the_floor_of_the_building_joins_its_rooms(color):
    floor = box(0, -16, 100, 80, fill=color)

    assert beside_walk((floor, *WALLS)) == {"bath", "hall"}


def test_where_no_floor_is_painted_there_is_no_walk():
    assert beside_walk(WALLS) == set()


def test_a_lawn_around_the_building_is_no_floor():
    lawn = box(-200, -200, 300, 300, fill=FLOOR)

    assert beside_walk((lawn, *WALLS)) == set()


def test_a_floor_that_carries_few_walls_ends_nowhere():
    terrace = box(0, -16, 100, 0, fill=FLOOR)

    assert beside_walk((terrace, *WALLS)) == set()


def test_a_symbol_beside_the_building_needs_no_floor():
    floor, symbol = box(0, -16, 100, 80, fill=FLOOR), box(115, 20, 118, 60, fill=BLACK)

    assert beside_walk((floor, *WALLS, symbol)) == {"bath", "hall"}
