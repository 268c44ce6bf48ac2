import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given

import strategies
from pilotage.contours import Bend, find_arcs
from pilotage.contours.tangent import turns
from pilotage.geometry import Polyline

OPPOSITE = {Bend.CONVEX: Bend.CONCAVE, Bend.CONCAVE: Bend.CONVEX, Bend.STRAIGHT: Bend.STRAIGHT}


def has_no_fold(polyline):
    return (np.abs(turns(polyline)) < math.pi - 1e-6).all()


@given(strategies.polylines())
def test_arcs_partition_the_polyline(polyline):
    arcs = find_arcs(polyline)

    total = sum(polyline.cut(arc.span).length for arc in arcs)
    assert total == pytest.approx(polyline.length)
    for before, after in pairwise(arcs):
        end = polyline.cut(before.span).vertices[-1]
        np.testing.assert_allclose(polyline.cut(after.span).vertices[0], end, atol=1e-9)


@given(strategies.polylines())
def test_neighboring_arcs_bend_opposite_ways(polyline):
    bends = [arc.bend for arc in find_arcs(polyline)]

    around = bends + bends[:1] if polyline.closed and len(bends) > 1 else bends
    assert all(after is OPPOSITE[before] for before, after in pairwise(around))


@given(strategies.polylines())
def test_within_an_arc_no_turn_goes_against_its_bend(polyline):
    for arc in find_arcs(polyline):
        inner = turns(polyline.cut(arc.span))[1:-1]
        back = np.abs(inner) > np.pi - 1e-6  # to turn back is to bend either way
        inner = np.where(back, arc.bend.value * np.pi, inner)

        assert (inner * arc.bend.value >= -1e-6).all()
        assert arc.turn == pytest.approx(inner.sum(), abs=1e-6)


@given(strategies.polylines(closed=False))
def test_reversing_swaps_convex_and_concave(polyline):
    assume(has_no_fold(polyline))

    arcs, reverse = find_arcs(polyline), find_arcs(polyline.reversed())[::-1]

    assert [OPPOSITE[arc.bend] for arc in arcs] == [arc.bend for arc in reverse]
    assert [-arc.turn for arc in arcs] == pytest.approx([arc.turn for arc in reverse])
    assert [polyline.cut(arc.span).length for arc in arcs] == pytest.approx(
        [polyline.reversed().cut(arc.span).length for arc in reverse]
    )


def test_the_stretch_between_opposite_turns_is_cut_at_its_middle_whatever_vertices_it_has():
    """Turns at (1, 0) and (7, 0), two straight vertices between."""
    line = Polyline.through([(0, 1), (1, 0), (2, 0), (3, 0), (7, 0), (8, -1)])

    first, second = find_arcs(line)

    assert (first.bend, second.bend) == (Bend.CONVEX, Bend.CONCAVE)
    assert line.cut(first.span).vertices[-1].tolist() == [4.0, 0.0]
    assert first.turn == pytest.approx(math.pi / 4)


def test_a_room_with_a_pillar_at_its_wall_is_convex_concave_in_turn():
    room = Polyline.through([(0, 0), (4, 0), (4, 1), (5, 1), (5, 0), (9, 0), (9, 6), (0, 6)], closed=True)

    arcs = find_arcs(room)

    assert [arc.bend for arc in arcs].count(Bend.CONCAVE) == 1
    assert sum(arc.turn for arc in arcs) == pytest.approx(math.tau)


def test_a_straight_line_is_one_straight_arc():
    (arc,) = find_arcs(Polyline.through([(0, 0), (1, 1), (2, 2)]))

    assert (arc.bend, arc.turn, arc.span.first, arc.span.last) == (Bend.STRAIGHT, 0.0, 0, 2)


def test_a_convex_outline_is_one_arc_all_around():
    (arc,) = find_arcs(Polyline.through([(0, 0), (2, 0), (2, 2), (0, 2)], closed=True))

    assert (arc.bend, arc.span.first, arc.span.last) == (Bend.CONVEX, 0, 4)
