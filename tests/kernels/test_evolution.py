import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import oracles
import strategies
from pilotage.kernels import evolution, evolution_compiled

grid_points = st.tuples(st.integers(0, 6), st.integers(0, 6))
runs_on_a_grid = st.lists(st.lists(grid_points, min_size=2, max_size=10), min_size=1, max_size=3)
thresholds = st.sampled_from([0.3, 0.7, 1.3, 3.0, 50.0])


def flatten(runs):
    return np.vstack(runs).astype(float), np.cumsum([0, *(len(run) for run in runs)])


def survivors(kernel, runs, closed, min_relevance):
    xy, starts = flatten(runs)
    keep = kernel.evolve_runs(xy, starts, np.array(closed), min_relevance)
    return [
        [tuple(point) for point in xy[first:last][keep[first:last]].tolist()]
        for first, last in itertools.pairwise(starts)
    ]


@given(st.lists(strategies.polylines(min_size=3, max_size=9), min_size=1, max_size=3), thresholds)
def test_the_heap_and_the_grid_change_nothing_against_looking_at_all(polylines, min_relevance):
    runs = [polyline.vertices for polyline in polylines]
    closed = [polyline.closed for polyline in polylines]

    assert oracles.evolve_runs(runs, closed, min_relevance) == survivors(
        evolution, runs, closed, min_relevance
    )


@given(runs_on_a_grid, st.booleans(), thresholds)
def test_touching_straight_and_repeated_vertices_are_decided_alike_by_both(runs, closed, min_relevance):
    closed = [closed] * len(runs)

    expected = survivors(evolution, runs, closed, min_relevance)

    assert expected == survivors(evolution_compiled, runs, closed, min_relevance)


def test_the_compiled_and_the_plain_kernel_agree_on_a_long_outline():
    rng = np.random.default_rng(7)
    directions = np.linspace(0.0, 2.0 * np.pi, 500, endpoint=False)
    radii = 3.0 + np.cos(5.0 * directions) + rng.normal(0.0, 0.02, 500)
    outline = radii[:, None] * np.column_stack([np.cos(directions), np.sin(directions)])
    starts, closed = np.array([0, 500]), np.array([True])

    expected = evolution.evolve_runs(outline, starts, closed, 0.1)

    np.testing.assert_array_equal(evolution_compiled.evolve_runs(outline, starts, closed, 0.1), expected)


@pytest.mark.parametrize("kernel", [evolution, evolution_compiled])
def test_nothing_evolves_to_nothing(kernel):
    keep = kernel.evolve_runs(np.zeros((0, 2)), np.array([0]), np.zeros(0, dtype=bool), 1.0)

    assert keep.shape == (0,)


@pytest.mark.parametrize("kernel", [evolution, evolution_compiled])
def test_empty_and_single_runs_between_others_are_left_alone(kernel):
    xy = np.array([[0.0, 0.0], [1.0, 0.001], [2.0, 0.0], [5.0, 5.0]])

    keep = kernel.evolve_runs(xy, np.array([0, 3, 3, 4]), np.zeros(3, dtype=bool), 0.1)

    assert keep.tolist() == [True, False, True, True]
