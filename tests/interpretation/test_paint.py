"""What is seen of marks, against a painter that paints one square after the other."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from flats import BLACK, RED, WHITE
from pilotage.geometry import Polyline
from pilotage.interpretation import Mark, Pen
from pilotage.interpretation.paint import look_at
from pilotage.interpretation.sheet import Sheet

SIZE = 12
CENTERS = np.arange(SIZE) + 0.5
GRID = np.stack(np.meshgrid(CENTERS, CENTERS, indexing="ij"), axis=-1)  # (SIZE, SIZE, 2)
DIAGONAL = SIZE * np.sqrt(2.0)


@st.composite
def spans(draw):
    first, last = sorted(draw(st.lists(st.integers(0, SIZE), min_size=2, max_size=2, unique=True)))
    return first, last


@st.composite
def painted(draw):
    """One or two boxes filled in a color, those of two by the even-odd rule."""
    boxes = draw(st.lists(st.tuples(spans(), spans()), min_size=1, max_size=2, unique=True))
    corners = [[(a, c), (b, c), (b, d), (a, d)] for (a, b), (c, d) in boxes]
    outlines = tuple(Polyline.through(ring, closed=True) for ring in corners)
    return Mark(outlines, None, draw(st.sampled_from([BLACK, RED, WHITE])))


@st.composite
def drawn(draw):
    """A line along the middle of a row of squares, as wide as they are; in white it erases."""
    (first, last), row = draw(spans()), draw(st.integers(0, SIZE - 1)) + 0.5
    color = draw(st.sampled_from([BLACK, WHITE]))
    return Mark((Polyline.through([(first, row), (last, row)]),), Pen(color, 1.0))


def squares_of(mark):
    """Tell which squares a mark covers, (SIZE, SIZE)."""
    covered = np.zeros((SIZE, SIZE), dtype=bool)
    for outline in mark.outlines:
        low, high = outline.vertices.min(axis=0), outline.vertices.max(axis=0)
        if mark.pen is not None:
            low[1], high[1] = low[1] - 0.5, high[1] + 0.5
        covered ^= ((low < GRID) & (high > GRID)).all(axis=-1)
    return covered


def paint(marks):
    """Tell which squares of each mark are seen, (n, SIZE, SIZE): later paint hides, white is not seen."""
    seen = np.zeros((len(marks), SIZE, SIZE), dtype=bool)
    for place, mark in enumerate(marks):
        color = mark.fill if mark.pen is None else mark.pen.color
        if mark.pen is None or color == WHITE:  # a line in ink hides nothing: it is as thin as its middle
            seen[:place] &= ~squares_of(mark)
        seen[place] = squares_of(mark) & (color != WHITE)
    return seen


@given(st.lists(painted() | drawn(), min_size=1, max_size=7))
def test_what_is_seen_is_what_a_painter_leaves(marks):
    expected = paint(marks)

    seen = look_at(Sheet(tuple(marks)), range(len(marks)), WHITE, DIAGONAL)

    found = np.zeros_like(expected)
    for mark in seen:
        shape = shapely.union(mark.area, shapely.buffer(mark.line, 0.1))
        found[mark.number] = shapely.contains_xy(shape, GRID[..., 0], GRID[..., 1])
    assert np.array_equal(found, expected)


@given(st.lists(painted() | drawn(), min_size=1, max_size=7))
def test_a_line_is_whole_if_nothing_hides_it(marks):
    visible = {mark.number: mark for mark in look_at(Sheet(tuple(marks)), range(len(marks)), WHITE, DIAGONAL)}

    for number, squares in enumerate(paint(marks)):
        if marks[number].pen is not None and squares.any():
            assert visible[number].whole == np.array_equal(squares, squares_of(marks[number]))


def bar(first, last, color, width):
    """A line from left to right."""
    return Mark((Polyline.through([(first, 5.0), (last, 5.0)]),), Pen(color, width))


@pytest.mark.parametrize(
    ("color", "width", "left"),
    [
        (RED, 1.0, 7.0),  # runs along it
        (RED, 0.5, 12.0),  # its edges are seen to both sides
        (BLACK, 1.0, 12.0),  # goes on as the other does
        (WHITE, 1.0, 7.0),
        (WHITE, 0.5, 12.0),
    ],
)
def test_a_line_over_another_hides_it_if_it_is_unlike_and_as_wide(color, width, left):
    seen = look_at(
        Sheet((bar(0.0, 12.0, BLACK, 1.0), bar(4.0, 9.0, color, width))), range(2), WHITE, DIAGONAL
    )

    assert seen[0].line.length == pytest.approx(left)


def test_a_line_in_a_color_that_crosses_another_does_not_cut_it():
    crossing = Mark((Polyline.through([(6.0, 0.0), (6.0, 10.0)]),), Pen(RED, 1.0))

    seen = look_at(Sheet((bar(0.0, 12.0, BLACK, 1.0), crossing)), range(2), WHITE, DIAGONAL)

    assert seen[0].line.length == pytest.approx(12.0)


@pytest.mark.parametrize(("floor", "is_open"), [((0.93, 0.95, 0.96), True), ((0.85, 0.95, 0.85), False)])
def test_a_line_in_the_color_of_the_floor_below_erases_a_wall(floor, is_open):
    pale = (0.93, 0.95, 0.96)
    marks = (
        Mark((Polyline.through([(0, 0), (9, 0), (9, 9), (0, 9)], closed=True),), None, floor),
        Mark((Polyline.through([(0, 5), (9, 5)]),), Pen(BLACK, 0.5)),
        Mark((Polyline.through([(3, 5), (5, 5)]),), Pen(pale, 0.7)),
    )

    seen = look_at(Sheet(marks), [0, 1, 2], (1.0, 1.0, 0.8), 12.0)

    lengths = {mark.number: mark.line.length for mark in seen}
    assert (7.0 if is_open else 9.0) == pytest.approx(lengths[1])
    assert is_open == (2 not in lengths)
