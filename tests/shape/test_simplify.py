import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely.geometry import LinearRing, LineString

import strategies
from pilotage.geometry import Polyline, Similarity2
from pilotage.shape import Simplification, relevances, simplify, simplify_all

thresholds = st.floats(0.0, 3.0)


@given(strategies.polylines(), thresholds)
def test_what_is_left_is_a_part_in_order_and_ends_survive(polyline, min_relevance):
    simple = simplify(polyline, Simplification(min_relevance))

    rest = iter(polyline.vertices.tolist())
    assert all(vertex in rest for vertex in simple.vertices.tolist())
    assert polyline.closed == simple.closed
    if not polyline.closed:
        assert polyline.vertices[[0, -1]].tolist() == simple.vertices[[0, -1]].tolist()


@given(strategies.polylines(), thresholds)
def test_simplifying_twice_changes_nothing(polyline, min_relevance):
    until = Simplification(min_relevance)
    once = simplify(polyline, until)

    assert once == simplify(once, until)


@given(strategies.graphs_of_functions(), thresholds)
def test_all_that_is_left_of_a_function_s_graph_is_relevant(polyline, min_relevance):
    """A graph bars no deletion on itself: its triangles hold no vertex between their corners' columns."""
    simple = simplify(polyline, Simplification(min_relevance))

    assert relevances(simple).min() >= min_relevance


@given(strategies.star_shaped_outlines(), thresholds)
def test_an_outline_never_comes_to_cross_itself(outline, min_relevance):
    simple = simplify(outline, Simplification(min_relevance))

    assert len(simple) >= 3
    assert LinearRing(simple.vertices).is_simple


@given(strategies.graphs_of_functions(), strategies.graphs_of_functions(above=3.1), thresholds)
def test_two_lines_never_come_to_cross_each_other(lower, upper, min_relevance):
    simple = simplify_all([lower, upper], Simplification(min_relevance))

    assert not LineString(simple[0].vertices).intersects(LineString(simple[1].vertices))


@given(strategies.polylines(), strategies.poses, strategies.scales)
def test_relevance_turns_with_the_line_and_grows_with_it(polyline, pose, scale):
    expected = scale * relevances(polyline)

    np.testing.assert_allclose(relevances(polyline.moved(Similarity2(scale, pose))), expected, atol=1e-6)


def test_a_right_angle_between_decimetres_has_the_relevance_named_in_the_settings():
    corner = Polyline.through([(0.1, 0.0), (0.0, 0.0), (0.0, 0.1)])

    assert math.pi / 2 * 0.05 == pytest.approx(relevances(corner)[1])


def test_a_wall_drawn_through_another_may_still_be_straightened():
    cross = [
        Polyline.through([(-2, 0), (0.5, 0.01), (2, 0)]),
        Polyline.through([(0, -2), (0.01, 1), (0, 2)]),
    ]

    assert [len(line) for line in simplify_all(cross, Simplification(0.1))] == [2, 2]


def test_a_vertex_that_another_line_ends_on_stays():
    wall = Polyline.through([(0, 0), (1, 0.01), (2, 0)])
    partition = Polyline.through([(1, 0.01), (1, 2)])

    assert (wall, partition) == simplify_all([wall, partition], Simplification(0.1))


def test_a_deletion_once_refused_is_made_when_the_way_is_free():
    """The bump of the lower line goes first: only then may the upper line come down."""
    lower = Polyline.through([(0, 0), (2, 0.3), (4, 0)])
    upper = Polyline.through([(0, 0.1), (2, 0.35), (4, 0.1)])

    simple = simplify_all([upper, lower], Simplification(1.0))

    assert [len(line) for line in simple] == [2, 2]


@pytest.mark.parametrize("min_relevance", [-0.1, math.nan])
def test_a_threshold_that_cannot_be_meant_is_refused(min_relevance):
    with pytest.raises(ValueError, match="min_relevance must be >= 0"):
        Simplification(min_relevance)


def test_no_polylines_simplify_to_none():
    assert simplify_all([], Simplification()) == ()
