"""Thin walls that part rooms, and tables that do not."""

import pytest
import shapely

from pilotage.interpretation.partitions import find_partitions

OUTER = shapely.Polygon([(-1, -1), (21, -1), (21, 21), (-1, 21)], [[(0, 0), (20, 0), (20, 20), (0, 20)]])
DOOR = 1.0  # its width


@pytest.mark.parametrize(
    ("corners", "parts"),
    [((8, 8, 12, 11), False), ((8, 0, 12, 3), True), ((6, 6, 11, 11), True), ((8, 8, 9, 9), False)],
    ids=["a table", "a room at a wall", "a kiosk", "a chair"],
)
def test_what_stands_free_is_a_room_only_if_it_is_larger_than_a_table(corners, parts):
    found = find_partitions(shapely.box(*corners).exterior, OUTER, (), DOOR)

    assert parts is not found.is_empty


def test_rooms_that_hang_together_stand_if_one_of_them_does():
    row = [shapely.box(8, y, 11, y + 3).exterior for y in (0, 3, 6)]

    found = find_partitions(shapely.union_all(row), OUTER, (), DOOR)

    assert 9.0 == found.bounds[3]


@pytest.mark.parametrize("aside", [0.0, 0.007, 0.014, 0.02])
def test_a_door_closes_a_wall_that_it_misses_by_little(aside):
    wall = shapely.multilinestrings([[(10, 0), (10, 9.06)], [(10, 9.94), (10, 20)]])
    door = shapely.LineString([(10 + aside, 9), (10 + aside, 10)])

    assert not find_partitions(wall, OUTER, [door], DOOR).is_empty
