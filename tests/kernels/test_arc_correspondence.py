import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import oracles
from pilotage.kernels.arc_correspondence import cheapest_sequence, group_sizes

arc_counts = st.integers(1, 8)
largest_groups = st.sampled_from([1, 3, 5, 7])


def random_costs(k, m, largest, seed):
    """A cost for each group of k against m arcs, as if any bend could answer to any."""
    return np.random.default_rng(seed).uniform(0.0, 1.0, (largest, k, m))


def found(costs, sizes, i0, j0, bound=math.inf):
    _, k, m = costs.shape
    return cheapest_sequence(costs, sizes, i0, j0, bound, np.empty((k + 1, m + 1)))


def test_groups_are_of_one_against_an_odd_number():
    assert group_sizes(5).tolist() == [[1, 1], [1, 3], [3, 1], [1, 5], [5, 1]]


@given(arc_counts, arc_counts, largest_groups, st.integers(0, 10_000))
def test_the_dynamic_programme_finds_what_trying_all_sequences_finds(k, m, largest, seed):
    costs, sizes = random_costs(k, m, largest, seed), group_sizes(largest)

    for i0, j0 in ((0, 0), (k - 1, m // 2)):
        expected = oracles.cheapest_sequence(costs, sizes, i0, j0)
        assert found(costs, sizes, i0, j0) == pytest.approx(expected)


@given(arc_counts, arc_counts, largest_groups, st.integers(0, 10_000), st.floats(0.0, 3.0))
def test_a_bound_hides_no_sum_below_it(k, m, largest, seed, bound):
    costs, sizes = random_costs(k, m, largest, seed), group_sizes(largest)

    expected = found(costs, sizes, 0, 0)

    assert min(found(costs, sizes, 0, 0, bound), bound) == pytest.approx(min(expected, bound))


@given(arc_counts, arc_counts, largest_groups, st.integers(0, 10_000))
def test_no_start_of_a_closed_contour_is_better_than_those_tried(k, m, largest, seed):
    costs, sizes = random_costs(k, m, largest, seed), group_sizes(largest)

    expected = min(found(costs, sizes, i0, j0) for i0 in range(k) for j0 in range(m))

    tried = min(found(costs, sizes, i0, j0) for i0 in range(min(largest, k)) for j0 in range(m))
    assert tried == pytest.approx(expected)
