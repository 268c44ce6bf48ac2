"""Dimension lines part no room, and walls are none."""

import math
from dataclasses import replace

import numpy as np
import pytest

from flats import BLACK, LABELS, RED, WITH_GAP, box, graph_of, stroke
from pilotage.geometry import Polyline
from pilotage.interpretation import Mark, Role, Sheet, Text, interpret

OUTER = [(0, 0, 100, 4), (0, 76, 100, 80), (0, 0, 4, 80), (96, 0, 100, 80), (48, 4, 52, 30), (48, 42, 52, 76)]
PAINTED = tuple(box(*bounds, fill=BLACK) for bounds in OUTER)
NUMBERS = (
    Text("4.40", (25, 22), height=2.0),
    Text("2'-3\"", (12.5, 50), height=2.0, angle=math.radians(90)),
)


def ticks(*places):
    return [stroke((x - 1, y - 1), (x + 1, y + 1)) for x, y in places]


def arrowheads(*tips):
    return [
        stroke((x + 2 * dx - dy, y + 2 * dy + dx), (x, y), (x + 2 * dx + dy, y + 2 * dy - dx))
        for x, y, dx, dy in tips
    ]


def roles(marks, texts):
    return [meaning.role for meaning in interpret(Sheet(tuple(marks), texts)).meanings]


@pytest.mark.parametrize("pen", [{}, {"color": RED}, {"dashed": True}, {"width": 0.2}])
@pytest.mark.parametrize(("flat", "face"), [(WITH_GAP, 0), (PAINTED, 4)])
@pytest.mark.parametrize("are_arrows", [False, True])
def test_lines_with_a_number_and_signs_at_their_ends_part_no_room(flat, face, are_arrows, pen):
    left, right, low, high = face, 50 - face / 2, face, 80 - face
    lines = [stroke((left, 20), (right, 20), **pen), stroke((15, low), (15, high), **pen)]
    if are_arrows:
        lines += arrowheads((left, 20, 1, 0), (right, 20, -1, 0), (15, low, 0, 1), (15, high, 0, -1))
    else:
        lines += ticks((left, 20), (right, 20), (15, low), (15, high))

    graph = graph_of((*flat, *lines), (*LABELS, *NUMBERS))

    assert len(graph_of(flat).cells) == len(graph.cells)
    assert {Role.IGNORE} == set(roles((*flat, *lines), NUMBERS)[len(flat) :])


@pytest.mark.parametrize(
    ("lines", "number"),
    [
        (ticks((0, 20), (50, 20)), Text("4.40", (25, 45), height=2.0)),  # far away
        (ticks((0, 20), (50, 20)), Text("hall", (25, 22), height=2.0)),
        (ticks((0, 20), (50, 20)), Text("4.40", (25, 22), height=2.0, angle=1.0)),
        (ticks((0, 20)), Text("4.40", (25, 22), height=2.0)),
        ([stroke((x, 20), (x, 22)) for x in (0, 50)], Text("101", (25, 22), height=2.0)),  # jambs
        ([box(x - 1, 19, x + 1, 21, fill=BLACK) for x in (0, 50)], Text("101", (25, 22), height=2.0)),
    ],
)
def test_walls_with_a_number_beside_them_are_walls(lines, number):
    marks = (*WITH_GAP, stroke((0, 20), (50, 20)), *lines)

    assert Role.WALL is roles(marks, (number,))[len(WITH_GAP)]


def test_a_mark_may_hold_all_signs_of_a_dimension_line_or_the_line_with_them():
    line, signs = stroke((0, 20), (50, 20), width=0.2), ticks((0, 20), (50, 20))
    both = replace(signs[0], outlines=tuple(sign.outlines[0] for sign in signs))
    whole = replace(line, outlines=(*line.outlines, *both.outlines))
    number = Text("≈4.40*", (25, 22), height=2.0)

    assert [Role.IGNORE] * 2 == roles((*WITH_GAP, line, both), (number,))[len(WITH_GAP) :]
    assert [Role.IGNORE] == roles((*WITH_GAP, whole), (number,))[len(WITH_GAP) :]


@pytest.mark.parametrize(
    ("width", "number", "is_dimension"),
    [
        (0.2, Text("4.40 m", (25, 22), height=2.0), True),
        (0.2, Text("4.40 m", (15, 22), height=2.0), False),  # not before the middle
        (0.2, Text("4.40", (25, 22), height=2.0), False),  # a number of anything
        (1.0, Text("4.40 m", (25, 22), height=2.0), False),  # a wall that was measured
    ],
)
def test_a_thin_line_with_a_length_before_its_middle_needs_no_signs(width, number, is_dimension):
    marks = (*WITH_GAP, stroke((0, 20), (50, 20), width=width))

    assert is_dimension is (Role.IGNORE in roles(marks, (number,))[len(WITH_GAP) :])


@pytest.mark.parametrize("signs", [ticks((0, 20), (50, 20)), ticks((0, 20))])
def test_a_number_may_be_written_in_outlines(signs):
    angles = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    digits = [Mark((Polyline(np.add(ring, (x, 22.0)), closed=True),), fill=BLACK) for x in (23.0, 25.5, 28.0)]
    line = stroke((0, 20), (50, 20))

    assert (len(signs) == 2) is (Role.IGNORE is roles((*WITH_GAP, line, *signs, *digits), ())[len(WITH_GAP)])


@pytest.mark.parametrize(("x", "role"), [(110, Role.IGNORE), (75, Role.WALL)], ids=["outside", "within"])
def test_a_line_with_a_tick_across_both_ends_measures_a_building_if_it_lies_beside_it(x, role):
    span = [stroke((x, 0), (x, 80)), *(stroke((x - 1, y), (x + 1, y)) for y in (0, 80))]

    assert role is roles((*WITH_GAP, *span), ())[3]


def test_the_length_of_a_dimension_line_names_no_room():
    line, length = stroke((10, 20), (40, 20), width=0.2), Text("3200", (25, 22), height=2.0)

    measured = graph_of((*WITH_GAP, line, *ticks((10, 20), (40, 20))), (*LABELS, length))
    numbered = graph_of(WITH_GAP, (*LABELS, length))

    assert {"bath", "hall"} <= {cell.label for cell in measured.cells}
    assert {"bath, 3200", "hall"} <= {cell.label for cell in numbered.cells}
