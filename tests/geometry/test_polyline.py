import numpy as np
import pytest
from hypothesis import given

from pilotage.geometry import Polyline, Span
from strategies import polylines, poses


@given(polylines(), poses)
def test_moving_keeps_lengths(polyline, pose):
    np.testing.assert_allclose(polyline.segment_lengths, polyline.moved(pose).segment_lengths, atol=1e-9)


@given(polylines())
def test_reversing_twice_changes_nothing(polyline):
    assert polyline == polyline.reversed().reversed()


def test_a_closed_polyline_counts_its_closing_segment():
    square = Polyline.through([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)

    assert 4.0 == square.length
    assert 4 == len(square)


def test_a_span_may_run_past_the_end_of_a_closed_polyline():
    square = Polyline.through([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)

    assert [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0]] == square.cut(Span(3, 5)).vertices.tolist()


def test_trims_cut_into_the_end_segments():
    line = Polyline.through([(0, 0), (4, 0), (4, 4)])

    assert [[1.0, 0.0], [4.0, 0.0], [4.0, 2.0]] == line.cut(Span(0, 2, 0.25, 0.5)).vertices.tolist()


def test_vertices_cannot_be_written():
    line = Polyline.through([(0, 0), (1, 0)])

    with pytest.raises(ValueError, match="read-only"):
        line.vertices[0, 0] = 1.0


@pytest.mark.parametrize(
    ("points", "rule"),
    [([(0, 0)], "at least 2"), ([(0, 0, 0), (1, 1, 1)], "shape"), ([(0, 0), (np.nan, 1)], "finite")],
)
def test_what_is_no_polyline_is_refused(points, rule):
    with pytest.raises(ValueError, match=rule):
        Polyline.through(points)


@pytest.mark.parametrize(
    ("span", "rule"),
    [((2, 2), "first < last"), ((0, 1, 1.0), "trim_first"), ((0, 1, 0.5, 0.5), "leave a part")],
)
def test_what_is_no_span_is_refused(span, rule):
    with pytest.raises(ValueError, match=rule):
        Span(*span)
