"""Furniture that is drawn as walls are, or nearly so."""

from dataclasses import replace

import pytest

from flats import BLACK, OUTSIDE, RED, WITH_GAP, are_joined, box, graph_of, stroke
from pilotage.interpretation import Pen, Role, Sheet, Text, interpret

THIN, CREAM = Pen(BLACK, 0.3), (0.95, 0.92, 0.85)


def roles(marks):
    return [meaning.role for meaning in interpret(Sheet(tuple(marks))).meanings]


def test_where_all_is_drawn_in_one_color_lines_less_than_half_as_wide_as_walls_are_furniture():
    table = stroke((20, 20), (28, 20), (28, 26), (20, 26), (20, 20), width=0.3)
    marks = [replace(mark, pen=replace(mark.pen, color=RED)) for mark in (*WITH_GAP, table)]

    assert [*[Role.WALL] * 3, Role.FURNITURE] == roles(marks)
    assert len(graph_of(WITH_GAP).cells) == len(graph_of(marks).cells)


def test_lines_just_half_as_wide_as_walls_are_furniture_if_filled_things_are_drawn_so():
    pen = Pen(BLACK, 0.5)
    table, shelf = box(20, 20, 28, 26, pen=pen), stroke((60, 70), (64, 70), width=0.5)
    filled = replace(table, fill=CREAM)

    assert [*[Role.WALL] * 3, Role.FURNITURE, Role.FURNITURE] == roles((*WITH_GAP, filled, shelf))
    assert [Role.WALL] * 4 == roles((*WITH_GAP, table))


def test_filled_things_in_a_narrower_pen_of_their_own_are_furniture():
    beds = [box(10 * x, 60, 10 * x + 7, 72, pen=Pen(BLACK, 0.7), fill=CREAM) for x in (1, 3, 6, 8)]
    name = Text("Bedroom", (13.5, 66.0), 2.0)  # over a bed
    marks = (*WITH_GAP, *beds)

    found = interpret(Sheet(marks, (name,)))

    assert [*[Role.WALL] * 3, *[Role.FURNITURE] * 4] == [meaning.role for meaning in found.meanings]
    assert [Role.WALL] * 5 == roles(marks[:5])  # two may be anything


def test_a_long_thin_wall_is_one_though_shelves_stand_along_it():
    outer = stroke((5, 0), (100, 0), (100, 75)), stroke((95, 80), (0, 80), (0, 5))  # ways out at two corners
    wall = stroke((50, 0), (50, 36), width=0.3)
    shelves = [stroke((50, y), (44, y), (44, y + 8), (50, y + 8), (50, y), width=0.3) for y in (6, 18)]

    found = interpret(Sheet((*outer, wall, *shelves))).sketch.strokes

    assert 3 == len(found)
    assert any([50.0, 36.0] in line.vertices.tolist() for line in found)


@pytest.mark.parametrize("sides", [(0.6, 60, 44, 79.4), (10, 10, 40, 30)], ids=["a counter", "an island"])
def test_what_is_filled_within_a_thin_line_is_furniture_however_large(sides):
    furniture = box(*sides, pen=THIN, fill=CREAM)

    assert Role.FURNITURE is roles((*WITH_GAP, furniture))[-1]
    assert are_joined((*WITH_GAP, furniture))


@pytest.mark.parametrize(
    ("words", "role"), [("cinema", Role.WALL), ("sofa", Role.FURNITURE), ("Шкаф", Role.FURNITURE)]
)
def test_what_is_filled_within_a_thin_line_is_a_room_if_it_has_the_name_of_one(words, role):
    sheet = Sheet((*WITH_GAP, box(0.6, 50, 40, 79.4, pen=THIN, fill=CREAM)), (Text(words, (20, 60)),))

    assert role is interpret(sheet).meanings[-1].role


def test_what_is_filled_within_thin_lines_are_rooms_where_they_cover_most_of_a_building():
    rooms = [box(left, 0, left + 50, 80, pen=THIN, fill=CREAM) for left in (0, 50)]

    assert 2 == len(graph_of((OUTSIDE, *rooms)).cells)


def test_what_is_filled_within_a_thin_line_is_furniture_in_narrow_rooms_too():
    walls = [stroke((0, y), (100, y)) for y in (9, 18, 27, 36)]
    shelves = [box(5, y + 1, 95, y + 8, pen=THIN, fill=CREAM) for y in (0, 9, 18, 27)]

    assert [*[Role.WALL] * 5, *[Role.FURNITURE] * 4] == roles((OUTSIDE, *walls, *shelves))


def test_a_thin_box_beside_a_building_is_a_legend_and_no_room():
    legend = box(40, -25, 90, -8, pen=THIN)

    assert Role.FURNITURE is roles((*WITH_GAP, legend))[-1]
    assert len(graph_of(WITH_GAP).cells) == len(graph_of((*WITH_GAP, legend)).cells)


@pytest.mark.parametrize(("width", "role"), [(0.3, Role.FURNITURE), (1.0, Role.WALL)])
def test_a_long_dashed_line_is_an_aisle_if_it_is_thin_too(width, role):
    assert role is roles((*WITH_GAP, stroke((54, 20), (98, 20), width=width, dashed=True)))[-1]


@pytest.mark.parametrize(
    ("words", "role"), [("Sofa", Role.FURNITURE), ("Store", Role.WALL), ("Wardrobe", Role.WALL)]
)
def test_a_box_in_the_pen_of_walls_is_furniture_if_such_a_word_fills_it(words, role):
    sheet = Sheet((*WITH_GAP, box(10, 10, 30, 20, pen=Pen(BLACK, 1.0))), (Text(words, (20, 15), height=3.0),))
    found = interpret(sheet)

    assert role is found.meanings[-1].role
    assert (role is Role.WALL) == (found.text_meanings[0].role is Role.LABEL)


@pytest.mark.parametrize("other", [(), (Text("Bath", (15, 25), height=3.0),)])
def test_a_box_that_a_word_does_not_fill_or_with_two_is_a_room(other):
    room = box(10, 10, 30 if other else 40, 30, pen=Pen(BLACK, 1.0))
    sheet = Sheet((*WITH_GAP, room), (Text("Sofa", (20, 15), height=3.0), *other))

    assert Role.WALL is interpret(sheet).meanings[-1].role


def test_words_for_furniture_in_what_is_called_so_name_no_room():
    bed = box(12, 25, 28, 45, pen=THIN, names=("A-FURN",))
    texts = [Text(words, (20.0, 35.0), height=1.0) for words in ("床", "Doppelbett", "bath")]

    names = [{cell.label for cell in graph_of((*WITH_GAP, bed), (text,)).cells} for text in texts]

    assert [{""}, {""}, {"", "bath"}] == names


def test_lines_alike_that_touch_nothing_are_steps_or_shelves():
    row = tuple(stroke((60, y), (90, y)) for y in (20, 26, 32, 38, 44))

    assert {Role.FURNITURE} == set(roles((*WITH_GAP, *row))[-5:])
    assert {Role.WALL} == set(roles((*WITH_GAP, *row[:4]))[-4:])
