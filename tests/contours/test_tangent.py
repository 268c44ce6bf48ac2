import math

import numpy as np
import pytest
from hypothesis import given

import strategies
from pilotage.contours import TangentFunction
from pilotage.contours.tangent import turns
from pilotage.geometry import Polyline


@given(strategies.polylines())
def test_the_polyline_can_be_drawn_again_from_its_tangent_function(polyline):
    tangent = TangentFunction.of(polyline)

    lengths = np.diff(tangent.stops) * tangent.length
    steps = lengths[:, None] * np.column_stack([np.cos(tangent.directions), np.sin(tangent.directions)])
    drawn = polyline.vertices[0] + np.vstack([[0.0, 0.0], np.cumsum(steps, axis=0)])
    np.testing.assert_allclose(drawn, polyline.ring, atol=1e-8)


def test_directions_go_on_growing_around_a_spiral():
    spiral = Polyline.through([(0, 0), (1, 0), (1, 1), (0, 1), (0, -1), (2, -1), (2, 2)])

    expected = [k * math.pi / 2 for k in range(6)]

    assert TangentFunction.of(spiral).directions == pytest.approx(expected)


def test_repeated_vertices_leave_no_trace_in_the_tangent_function():
    corner = Polyline.through([(0, 0), (0, 0), (1, 0), (1, 0), (1, 1), (1, 1)])

    tangent = TangentFunction.of(corner)

    assert tangent.stops.tolist() == [0.0, 0.5, 1.0]
    assert tangent.directions == pytest.approx([0.0, math.pi / 2])
    assert turns(corner) == pytest.approx([0.0, 0.0, 0.0, math.pi / 2, 0.0, 0.0])


def test_a_polyline_of_one_place_has_no_tangent_function():
    with pytest.raises(ValueError, match="polyline must have a length"):
        TangentFunction.of(Polyline.through([(1, 1), (1, 1)]))


def test_stops_that_do_not_increase_are_refused():
    with pytest.raises(ValueError, match="stops must increase"):
        TangentFunction(np.array([0.0, 0.5, 0.5, 1.0]), np.zeros(3), 1.0)
