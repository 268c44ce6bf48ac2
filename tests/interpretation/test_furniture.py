"""Furniture that is drawn as walls are, or nearly so."""

from dataclasses import replace

from flats import RED, WITH_GAP, graph_of, stroke
from pilotage.interpretation import Role, Sheet, interpret


def roles(marks):
    return [meaning.role for meaning in interpret(Sheet(tuple(marks))).meanings]


def test_where_all_is_drawn_in_one_color_lines_less_than_half_as_wide_as_walls_are_furniture():
    table = stroke((20, 20), (28, 20), (28, 26), (20, 26), (20, 20), width=0.3)
    marks = [replace(mark, pen=replace(mark.pen, color=RED)) for mark in (*WITH_GAP, table)]

    assert [*[Role.WALL] * 3, Role.FURNITURE] == roles(marks)
    assert len(graph_of(WITH_GAP).cells) == len(graph_of(marks).cells)


def test_a_long_thin_wall_is_one_though_shelves_stand_along_it():
    outer = stroke((5, 0), (100, 0), (100, 75)), stroke((95, 80), (0, 80), (0, 5))  # ways out at two corners
    wall = stroke((50, 0), (50, 36), width=0.3)
    shelves = [stroke((50, y), (44, y), (44, y + 8), (50, y + 8), (50, y), width=0.3) for y in (6, 18)]

    found = interpret(Sheet((*outer, wall, *shelves))).sketch.strokes

    assert 3 == len(found)
    assert any([50.0, 36.0] in line.vertices.tolist() for line in found)
