"""Doors that are marked on walls without a gap."""

from dataclasses import replace

import numpy as np
import pytest

from flats import BLACK, OUTSIDE, RED, WHITE, arc, box, graph_of, stroke
from pilotage.interpretation import Pen, Role, Sheet, Text, interpret

TURN = np.array([(0.8, 0.6), (-0.6, 0.8)])
WALLS = tuple(stroke((x, 0), (x, 80)) for x in (25, 50, 75))
BARS = {
    "heavy": [stroke((x, 30), (x, 42), width=3.0) for x in (25, 50, 75)],
    "squares": [box(x - 1, 30, x + 1, 32, fill=BLACK) for x in (25, 50, 75)],
    "boxes": [box(x - 3, 30.3, x + 3.3, 40, fill=RED) for x in (25, 50, 75)],
    "across": [stroke((x - 3, 30), (x + 3, 30), color=RED) for x in (25, 50, 75)],
    "upright": [stroke((x, 30), (x + 8, 30), color=RED) for x in (25, 50, 75)],
    "outlined": [box(x - 1, 30, x + 1, 42, pen=Pen(RED, 0.1)) for x in (25, 50, 75)],
}


def number_of_doors(marks):
    return len(graph_of(marks, ()).gateways)


@pytest.mark.parametrize("bars", BARS.values(), ids=BARS)
def test_marks_on_walls_between_closed_rooms_are_doors(bars):
    marks = (OUTSIDE, *WALLS, *bars)

    assert not number_of_doors((OUTSIDE, *WALLS))
    assert 3 == number_of_doors(marks)
    assert {Role.DOOR} == {meaning.role for meaning in interpret(Sheet(marks)).meanings[-3:]}


@pytest.mark.parametrize("bars", BARS.values(), ids=BARS)
def test_turned_walls_are_marked_as_well(bars):
    def turned(mark):
        return stroke(*(TURN @ mark.outlines[0].ring.T).T, width=mark.pen.width, color=mark.pen.color)

    marks = [mark for mark in (OUTSIDE, *WALLS, *bars) if mark.pen is not None]
    assert (3 if len(marks) == 7 else 0) == number_of_doors([turned(mark) for mark in marks])


def test_bars_are_doors_where_all_lines_are_dashed_and_what_is_written_upon_them_names_no_room():
    rooms = [box(x, 0, x + 25, 80, pen=Pen(BLACK, 1.0, dashed=True)) for x in (0, 25, 50, 75)]
    bars = [box(x - 1, 30, x + 1, 42, pen=Pen(BLACK, 1.0, dashed=True), fill=RED) for x in (25, 50, 75)]
    names = [Text(f"D{x}", (x + 0.5, 36.0), height=1.0) for x in (25, 50, 75)]

    graph = graph_of((*rooms, *bars), tuple(names))

    assert 3 == len(graph.gateways)
    assert {""} == {cell.label for cell in graph.cells}


def test_bars_on_outer_walls_are_windows():
    windows = [stroke((x, 0), (x + 8, 0), width=3.0) for x in (5, 35, 60, 85)]

    assert not number_of_doors((OUTSIDE, *WALLS, *windows))


def test_bars_are_windows_though_the_edge_of_a_roof_is_drawn_around_the_walls():
    windows = [stroke((x, 0), (x + 8, 0), width=3.0) for x in (5, 35, 60, 85)]
    corners = ((-10, -10), (110, -10), (110, 90), (-10, 90), (-10, -10))

    for dashed, doors in ((True, 0), (False, 4)):
        marks = (OUTSIDE, *WALLS, *windows, stroke(*corners, dashed=dashed))
        assert doors == len(interpret(Sheet(marks)).sketch.doors)


@pytest.mark.parametrize("half", [1.5, 6.0])
def test_a_box_that_is_named_a_door_may_be_as_wide_as_its_wall_or_lie_across_it(half):
    pen = Pen(BLACK, 0.0)
    outside = [box(x, x, 100 - x, 80 - x, pen=pen, names=("WALLS",)) for x in (0, 3)]
    walls = [
        box(x - 1.5, bottom, x + 1.5, top, pen=pen, names=("WALLS",))
        for x in (25, 50, 75)
        for bottom, top in ((3, 30), (39, 77))
    ]
    doors = [box(x - half, 30, x + half, 39, pen=pen, names=("DOORS",)) for x in (25, 50, 75)]

    assert 3 == number_of_doors((*outside, *walls, *doors))


def test_what_also_stands_in_rooms_is_furniture():
    shelves = [stroke((x, y), (x, y + 12), width=3.0) for x in (10, 37, 60, 90) for y in (20, 50)]

    assert not number_of_doors((OUTSIDE, *WALLS, *BARS["heavy"], *shelves))


def test_lines_from_wall_to_wall_are_no_doors():
    flight = stroke((58, 0), (58, 80))
    treads = [stroke((50, y), (58, y), color=RED) for y in (30, 34, 38)]

    assert not number_of_doors((OUTSIDE, *WALLS, flight, *treads))


def test_where_walls_have_gaps_no_bar_is_a_door():
    gaps = [stroke((x, y), (x, y + 34)) for x in (25, 50, 75) for y in (0, 46)]
    columns = [box(x - 1, 20, x + 1, 22, fill=BLACK) for x in (25, 50, 75)]

    assert 3 == number_of_doors((OUTSIDE, *gaps, *columns))


def test_boxes_beside_a_wall_are_no_doors():
    cabinets = [box(x, 30, x + 5, 40, fill=RED) for x in (25, 50, 75)]

    assert not number_of_doors((OUTSIDE, *WALLS, *cabinets))


def test_one_bar_is_a_door_if_it_is_called_so():
    wall, bar = stroke((50, 0), (50, 80)), ((50, 30), (50, 42))

    assert 1 == number_of_doors((OUTSIDE, wall, stroke(*bar, names=("door-bath",))))
    assert not number_of_doors((OUTSIDE, wall, stroke(*bar)))
    assert not number_of_doors((OUTSIDE, wall, stroke((0, 30), (0, 42), names=("door",))))


@pytest.mark.parametrize(("name", "doors"), [("fp-door", 1), ("route", 0)])
def test_a_swing_that_is_called_a_door_and_stands_on_a_wall_with_an_end_opens_it(name, doors):
    swing = replace(stroke((50, 40), (54, 41), (57, 44), (58, 48), color=RED), names=(name,))

    assert doors == number_of_doors((OUTSIDE, *WALLS, swing))


@pytest.mark.parametrize(
    ("line", "doors"), [(((50, 30), (50, 42)), 2), (((44, 36), (56, 36)), 2), (((50, 36), (62, 36)), 1)]
)
def test_a_bar_that_is_called_a_door_is_one_beside_a_door_with_an_arc_and_a_leaf_alone_is_none(line, doors):
    hung = (stroke((25, 30), (37, 30)), arc((25, 30), 12, 0, 90))

    assert doors == number_of_doors((OUTSIDE, *WALLS[:2], *hung, stroke(*line, names=("doors",))))


def test_what_a_person_calls_a_door_opens_its_wall():
    marks = (OUTSIDE, stroke((50, 0), (50, 80)), stroke((50, 30), (50, 42), names=("x7",)))

    assert not interpret(Sheet(marks)).sketch.doors
    assert 1 == len(interpret(Sheet(marks), {"x7": Role.DOOR}).sketch.doors)


def test_two_bars_between_rooms_and_one_at_the_front_are_doors():
    bars = [stroke((x, 30), (x, 42), width=3.0) for x in (25, 50)]

    assert not number_of_doors((OUTSIDE, *WALLS[:2], *bars))
    assert 2 == number_of_doors((OUTSIDE, *WALLS[:2], *bars, stroke((60, 0), (72, 0), width=3.0)))


ROOMS = {"a": (20.0, 18.0), "b": (75.0, 18.0), "c": (20.0, 62.0), "d": (75.0, 62.0)}


def test_a_gap_in_one_of_two_lines_between_rooms_opens_both():
    rooms = [box(x, y, x + 46, y + 36, pen=Pen(BLACK, 1.0)) for x in (0, 54) for y in (0, 44)]
    gaps = [stroke((46, y), (46, y + 14), color=WHITE, width=2.0) for y in (10, 55)]

    graph = graph_of((*rooms, *gaps), tuple(Text(name, at, height=3.0) for name, at in ROOMS.items()))
    ids = {cell.label: cell.cell_id for cell in graph.cells}
    beyond = {
        (name, graph.cell(room.cell_id).label)
        for name in ("a", "c")
        for doorway in graph.neighbors(ids[name])
        for room in graph.neighbors(doorway.cell_id)
    }

    assert {("a", "a"), ("a", "b"), ("c", "c"), ("c", "d")} == beyond
    assert "a gap in one of two lines" == interpret(Sheet((*rooms, *gaps))).meanings[-1].reason


@pytest.mark.parametrize("drawn", [True, False])
def test_a_room_that_opens_to_the_outside_by_a_wide_named_door_alone_is_a_room(drawn):
    walls = [stroke((0, 28), (0, 0), (100, 0), (100, 80), (0, 80), (0, 42))]
    walls += [
        stroke((0, 27), (14, 27), (14, 43), (0, 43)),
        stroke((60, 0), (60, 30)),
        stroke((60, 38), (60, 80)),
    ]
    door = box(-1, 28, 1, 42, pen=Pen(RED, 0.1), names=("doors",))
    words = [Text("bath", (7.0, 35.0), height=3.0)]

    found = [cell.label for cell in graph_of((*walls, door) if drawn else walls, words).cells]

    assert ("bath" in found) is drawn


@pytest.mark.parametrize("drawn", [True, False])
def test_a_gate_between_short_piers_closes_a_garage_beside_doors_with_arcs(drawn):
    walls = [stroke((65, 0), (60, 0), (60, 80), (0, 80), (0, 0), (60, 0)), stroke((25, 0), (25, 80))]
    walls += [stroke((95, 0), (100, 0), (100, 80), (60, 80))]
    hung = (stroke((25, 30), (37, 30)), arc((25, 30), 12, 0, 90))
    gate = (box(65, -1, 95, 1, pen=Pen(RED, 0.1), names=("doors",)),) if drawn else ()

    found = [cell.label for cell in graph_of((*walls, *hung, *gate), [Text("cars", (80.0, 40.0), 3.0)]).cells]

    assert ("cars" in found) is drawn
