"""Rooms that are painted and have no line around them."""

import numpy as np
import pytest

from flats import BLACK, OUTSIDE, WITH_GAP, box, stroke
from pilotage.geometry import Polyline
from pilotage.interpretation import Mark, NoWallsError, Pen, Role, Sheet, Text, interpret
from pilotage.maps import DecompositionSettings, decompose

BLUE, PINK, GREEN, GRAY = (0.8, 0.87, 1.0), (1.0, 0.85, 0.88), (0.85, 1.0, 0.85), (0.85, 0.85, 0.85)
ANGLES = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
RING = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
DOTS = tuple(box(x, 95, x + 2, 97, pen=Pen(BLACK, 1.0)) for x in (0, 20, 40))


def cards(gap=0.0, width=30.0, fills=(BLUE, PINK, GREEN), count=3):
    """Lay painted rooms in a row, with a name in each."""
    lefts = [k * (width + gap) for k in range(count)]
    marks = [
        box(left, 0, left + width, 40, fill=fill) for left, fill in zip(lefts, fills[:count], strict=True)
    ]
    texts = [Text(f"room {k}", (left + width / 2.0, 20.0), 2.0) for k, left in enumerate(lefts)]
    return tuple(marks), tuple(texts)


def names_of(marks, texts):
    graph = decompose(interpret(Sheet(tuple(marks), texts)).sketch, DecompositionSettings())
    return {cell.label for cell in graph.cells if cell.label}


@pytest.mark.parametrize("gap", [0.0, 2.0, 20.0])
@pytest.mark.parametrize("fills", [(BLUE, PINK, GREEN), (BLUE, BLUE, BLUE)])
@pytest.mark.parametrize("beside", [(), DOTS])
def test_painted_fills_with_words_are_rooms_where_no_walls_are_drawn(gap, fills, beside):
    marks, texts = cards(gap, fills=fills)

    assert {"room 0", "room 1", "room 2"} == names_of((*marks, *beside), texts)
    meanings = interpret(Sheet((*marks, *beside), texts)).meanings[:3]
    assert {(Role.WALL, "painted as a room; its edge is the wall")} == {
        (one.role, one.reason) for one in meanings
    }


def test_letters_in_outlines_are_words_as_well():
    marks, texts = cards()
    letters = [
        Mark((Polyline(np.array(text.position) + 0.5 * RING + (k, 0.0), closed=True),), fill=BLACK)
        for text in texts
        for k in range(4)
    ]
    graph = decompose(interpret(Sheet((*marks, *DOTS, *letters))).sketch, DecompositionSettings())

    assert {3} == {len({graph.cell_at((x, 20.0)) for x in (15.0, 45.0, 75.0)})}


def test_where_nothing_else_is_drawn_fills_are_rooms_without_words():
    marks, _ = cards(gap=2.0)

    graph = decompose(interpret(Sheet(marks)).sketch, DecompositionSettings())

    assert {3} == {len({graph.cell_at((x, 20.0)) for x in (15.0, 47.0, 79.0)})}
    with pytest.raises(NoWallsError):
        interpret(Sheet((box(0, 0, 30, 40, fill=(1.0, 1.0, 0.99)),)))


def test_a_painted_corridor_without_words_is_a_room_too():
    marks, texts = cards()

    found = interpret(Sheet((*marks, box(0, 40, 90, 50, fill=GRAY)), texts)).sketch

    assert 4 == len(decompose(found, DecompositionSettings()).cells)


def test_where_walls_are_drawn_paint_is_a_floor():
    floors = (box(0, 0, 50, 30, fill=BLUE), box(0, 30, 50, 80, fill=PINK), box(50, 0, 100, 80, fill=GREEN))
    texts = tuple(Text(name, at, 3.0) for name, at in (("a", (20, 15)), ("b", (20, 55)), ("c", (75, 40))))

    meanings = interpret(Sheet((*floors, *WITH_GAP, stroke((0, 30), (40, 30))), texts)).meanings

    assert [Role.FLOOR] * 3 == [meaning.role for meaning in meanings[:3]]


def test_a_legend_beside_a_plan_holds_few_of_its_words():
    marks = tuple(box(110, 20 * k, 140, 20 * k + 15, fill=fill) for k, fill in enumerate((BLUE, PINK, GREEN)))
    legend = tuple(Text("key", (125.0, 20.0 * k + 7.0), 2.0) for k in range(3))
    names = tuple(Text(name, (20.0 * k + 10.0, 40.0), 3.0) for k, name in enumerate("abcd"))

    meanings = interpret(Sheet((*WITH_GAP, *marks), (*legend, *names))).meanings

    assert [Role.FLOOR] * 3 == [meaning.role for meaning in meanings[len(WITH_GAP) :]]


def test_two_fills_are_signs_and_words_far_apart_are_on_furniture():
    marks, texts = cards(count=2)
    signs = interpret(Sheet((*marks, *WITH_GAP), texts)).meanings
    assert [Role.FLOOR] * 2 == [meaning.role for meaning in signs[:2]]
    desks = tuple(box(x, y, x + 8, y + 6, fill=BLUE) for x, y in ((10, 10), (80, 10), (10, 60), (80, 60)))
    words = tuple(Text("Ana", (x, y), 2.0) for x, y in ((14, 13), (84, 13), (14, 63), (84, 63)))

    meanings = interpret(Sheet((OUTSIDE, *desks), words)).meanings

    assert [Role.FLOOR] * 4 == [meaning.role for meaning in meanings[1:]]
