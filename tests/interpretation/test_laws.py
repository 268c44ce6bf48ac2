"""What a drawing means does not hang on how the sheet lies, nor on what was drawn first."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flats import LABELS, OUTSIDE, WITH_GAP, arc, box, graph_of, stroke
from pilotage.geometry import Polyline
from pilotage.interpretation import BLACK, Pen, Sheet, interpret
from pilotage.interpretation.origin import origin_of
from strategies import angles, scales

few = settings(max_examples=15)


@st.composite
def flats(draw):
    """Two rooms of single lines or painted walls, parted by a gap or by a door with a leaf."""
    low, width = draw(st.floats(15.0, 45.0)), draw(st.floats(8.0, 14.0))
    high = low + width
    if draw(st.booleans()):
        outer = [(0, 0, 100, 4), (0, 76, 100, 80), (0, 0, 4, 80), (96, 0, 100, 80)]
        inner = [(48, 0, 52, low), (48, high, 52, 80)]
        return tuple(box(*sides, fill=BLACK) for sides in outer + inner)
    if draw(st.booleans()):
        return (OUTSIDE, stroke((50, 0), (50, low)), stroke((50, high), (50, 80)))
    leaf = stroke((50, low), (50 + width, low))
    return (OUTSIDE, stroke((50, 0), (50, 80)), leaf, arc((50, low), width, 0, 90))


def carried(mark, matrix, shift):
    """Carry a mark to another place on the sheet."""
    lines = tuple(Polyline(line.vertices @ matrix.T + shift, line.closed) for line in mark.outlines)
    size = float(np.sqrt(abs(np.linalg.det(matrix))))
    return replace(mark, outlines=lines, pen=mark.pen and Pen(mark.pen.color, size * mark.pen.width))


@few
@given(flats(), angles, scales, st.booleans(), st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3)))
def test_a_sheet_turned_mirrored_scaled_and_moved_has_the_same_cells(marks, angle, scale, flip, shift):
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    matrix = scale * turn @ np.diag([1.0, -1.0 if flip else 1.0])
    texts = tuple(replace(text, position=tuple((matrix @ text.position + shift).tolist())) for text in LABELS)

    before, after = graph_of(marks), graph_of([carried(mark, matrix, shift) for mark in marks], texts)

    assert len(before.cells) == len(after.cells)
    assert len(before.gateways) == len(after.gateways)
    assert sorted(str(cell.label) for cell in before.cells) == sorted(str(cell.label) for cell in after.cells)


@few
@given(flats().flatmap(lambda marks: st.tuples(st.just(marks), st.permutations(range(len(marks))))))
def test_what_is_drawn_first_does_not_matter_where_nothing_is_hidden(drawn):
    marks, order = drawn
    shuffled = [marks[number] for number in order]

    before, after = interpret(Sheet(marks)), interpret(Sheet(tuple(shuffled)))

    assert tuple(before.meanings[number] for number in order) == after.meanings
    assert len(graph_of(marks).cells) == len(graph_of(shuffled).cells)


@few
@given(flats())
def test_the_same_sheet_is_understood_the_same_way_twice(marks):
    first, second = interpret(Sheet(marks, LABELS)), interpret(Sheet(marks, LABELS))

    assert first.meanings == second.meanings
    assert first.sketch == second.sketch


@given(
    st.lists(st.lists(st.tuples(*[st.integers(0, 100)] * 2), min_size=2, max_size=3, unique=True), min_size=1)
)
def test_plain_strokes_are_returned_as_drawn(lines):
    marks = tuple(stroke(*line, width=0.001) for line in lines)  # thick paint closes slits

    understood = interpret(Sheet(marks))

    if not (understood.sketch.solids or understood.sketch.doors):
        assert understood.sketch.strokes == tuple(mark.outlines[0] for mark in marks)
        assert {"a stroke"} == {meaning.reason for meaning in understood.meanings}


def test_hatching_between_the_faces_of_a_wall_changes_nothing():
    faces = (
        OUTSIDE,
        box(3, 3, 48.5, 77, pen=Pen(BLACK, 1.0)),
        box(51.5, 3, 97, 77, pen=Pen(BLACK, 1.0)),
    )
    hatching = [stroke((x, 0), (x + 3, 3)) for x in range(0, 97, 3)]

    assert len(graph_of(faces).cells) == len(graph_of([*faces, *hatching]).cells)


@pytest.mark.parametrize("width", [0.0, 1.0])
def test_hairlines_are_understood_as_wide_lines_are(width):
    marks = [replace(mark, pen=Pen(BLACK, width)) for mark in WITH_GAP]

    assert len(graph_of(WITH_GAP).cells) == len(graph_of(marks).cells)


def test_a_drawing_in_coordinates_of_a_survey_is_read_as_if_it_lay_at_the_origin():
    shift = np.array((512345.0, 5312345.0))
    turn = np.array([[0.8, -0.6], [0.6, 0.8]]) / 16.0
    hinge = [stroke((52, 30), (62, 30)), arc((52, 30), 10, 0, 90)]
    walls = [
        box(0, 0, 100, 4),
        box(0, 76, 100, 80),
        box(0, 0, 4, 80),
        box(96, 0, 100, 80),
        box(48, 0, 52, 80),
    ]
    marks = [carried(mark, turn, 0.0) for mark in (*(replace(wall, fill=BLACK) for wall in walls), *hinge)]
    near = [carried(mark, np.eye(2), shift) for mark in marks]
    origin = origin_of(Sheet(tuple(near)))
    texts = [
        replace(text, position=tuple((turn @ text.position + shift).tolist()), height=0.2) for text in LABELS
    ]

    there = interpret(Sheet(tuple(near), tuple(texts))).sketch
    here = interpret(Sheet(tuple(carried(mark, np.eye(2), -origin) for mark in near))).sketch

    assert np.abs(origin - shift).max() < 10.0
    assert len(here.doors) == len(there.doors) == 1
    for first, second in zip(here.strokes, there.strokes, strict=True):
        assert (first.vertices + origin).tolist() == second.vertices.tolist()
    assert [text.position for text in texts] == [label.position for label in there.labels]
