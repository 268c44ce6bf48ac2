"""Windows that are drawn upon walls, and walls that are known by their names."""

from dataclasses import replace

import pytest

from flats import BLACK, OUTSIDE, arc, are_joined, box, graph_of, stroke
from pilotage.interpretation import Pen, Role, Sheet, interpret

PEN = Pen(BLACK, 0.0)
WALLS = [
    replace(mark, names=("WALLS",), pen=PEN)
    for mark in (OUTSIDE, stroke((50, 0), (50, 30)), stroke((50, 42), (50, 80)))
]
WINDOWS = [
    box(*bounds, pen=PEN, names=("WINDOWS",))
    for bounds in ((10, -2, 30, 2), (60, 78, 80, 82), (-2, 20, 2, 60), (98, 20, 102, 60))
]
DOOR = [
    replace(mark, names=("DOORS",), pen=PEN)
    for mark in (stroke((50, 30), (62, 30)), arc((50, 30), 12, 0, 90))
]


@pytest.mark.parametrize("door", [[], DOOR], ids=["gap", "swing"])
def test_windows_upon_a_wall_that_is_one_line_make_no_rooms_and_no_thick_wall(door):
    graph = graph_of((*WALLS, *WINDOWS, *door))

    assert are_joined((*WALLS, *WINDOWS, *door))
    assert pytest.approx(100 * 80) == sum(cell.polygon.area for cell in graph.cells)


def test_windows_of_several_lines_are_signs_as_a_whole():
    panes = [
        stroke(*ends, names=("WINDOWS",))
        for ends in (
            ((10, -2), (30, -2)),
            ((10, 0), (30, 0)),
            ((10, 2), (30, 2)),
            ((10, -2), (10, 2)),
            ((30, -2), (30, 2)),
        )
    ]

    assert 2 == len(graph_of((*WALLS, *panes)).cells)


def test_windows_in_gaps_of_a_wall_that_is_one_line_are_one_line():
    walls = [
        stroke(*ends, names=("WALLS",))
        for ends in (((0, 0), (10, 0)), ((30, 0), (100, 0)), ((0, 0), (0, 80), (100, 80), (100, 0)))
    ]
    sill = stroke((10, 0), (30, 0), names=("WINDOWS",))

    for marks in ((WINDOWS[0],), (WINDOWS[0], sill)):
        assert are_joined((*walls, *WALLS[1:], *marks))
        assert 2 == len(graph_of((*walls, *WALLS[1:], *marks)).cells)


def test_where_named_walls_enclose_all_what_stands_free_and_bears_another_name_is_none():
    areas = [box(60, 20, 70, 34, pen=PEN, names=("X1",)), box(10, 20, 20, 34, pen=PEN, names=("X2",))]
    roles = [meaning.role for meaning in interpret(Sheet((*WALLS, *areas))).meanings]

    assert [*[Role.WALL] * 3, *[Role.FURNITURE] * 2] == roles
    assert are_joined((*WALLS, *areas))


def test_lines_of_another_name_part_rooms_from_wall_to_wall():
    partition = [stroke((50, 60), (70, 60), names=("X1",)), stroke((80, 60), (100, 60), names=("X1",))]

    assert 3 == len(graph_of((*WALLS, *partition)).cells)
