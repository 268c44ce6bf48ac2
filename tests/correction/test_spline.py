"""Laws of the map by splines."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.correction.spline import SplineGrid

POINTS = st.lists(
    st.tuples(st.floats(-20.0, 30.0), st.floats(-5.0, 8.0)), min_size=2, max_size=20, unique=True
).map(np.array)
ENTRIES = st.floats(-2.0, 2.0)


@given(POINTS, st.floats(0.5, 5.0), st.tuples(*[ENTRIES] * 6))
def test_affine_maps_are_among_them_and_do_not_bend(points, spacing, entries):
    grid = SplineGrid.over(points, spacing, most=2_000)
    linear, shift = np.reshape(entries[:4], (2, 2)), np.array(entries[4:])
    coefficients = grid.nodes @ linear.T + shift

    assert grid.basis(points) @ coefficients == pytest.approx(points @ linear.T + shift, abs=1e-6)
    assert np.abs(grid.bending @ coefficients).max() < 1e-6


@given(POINTS, st.floats(0.01, 5.0))
def test_a_grid_never_has_many_more_nodes_than_it_may(points, spacing):
    grid = SplineGrid.over(points, spacing, most=500)

    assert len(grid.nodes) < 5_000
    assert grid.basis(points).sum(axis=1) == pytest.approx(1.0)
