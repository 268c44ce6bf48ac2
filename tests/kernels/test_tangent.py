import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import oracles
from pilotage.geometry import frozen_array
from pilotage.kernels import tangent
from pilotage.kernels.segment_correspondence import segment_dissimilarity
from pilotage.kernels.steps import Steps

lengths = st.lists(st.floats(0.1, 2.0), min_size=1, max_size=5)


@st.composite
def stretches(draw):
    """Lengths and unwrapped directions of an arc."""
    along = draw(lengths)
    return along, draw(st.lists(st.floats(-4.0, 4.0), min_size=len(along), max_size=len(along)))


def steps(stretch):
    return Steps(np.concatenate([[0.0], np.cumsum(stretch[0])]), frozen_array(stretch[1]))


def both(kernel, c, d, *arguments):
    return kernel(steps(c), 0, len(c[0]), steps(d), 0, len(d[0]), *arguments)


@given(stretches(), stretches())
def test_the_merged_integrals_are_those_of_fine_samples(c, d):
    samples = oracles.differences_of_directions(c, d)

    mean, variance = both(tangent.mean_and_variance, c, d)

    assert mean == pytest.approx(samples.mean(), abs=1e-2)
    assert variance == pytest.approx(samples.var(), abs=1e-1)
    assert both(tangent.arc_dissimilarity, c, d) == pytest.approx(
        oracles.arc_dissimilarity(c, d), rel=1e-1, abs=1e-1
    )


@given(stretches(), stretches())
def test_half_of_all_differences_lie_on_either_side_of_their_median(c, d):
    samples = oracles.differences_of_directions(c, d)

    middle = both(tangent.median, c, d)

    assert (samples < middle - 1e-9).mean() <= 0.5 + 1e-3
    assert (samples > middle + 1e-9).mean() <= 0.5 + 1e-3


@given(stretches(), stretches())
def test_the_median_only_changes_sign_when_arcs_change_places(c, d):
    assert both(tangent.median, c, d) == pytest.approx(-both(tangent.median, d, c))


@given(stretches(), stretches(), st.floats(-3.0, 3.0), st.integers(1, 4))
def test_segments_correspond_as_cheaply_as_any_correspondence(c, d, rotation, largest_run):
    expected = oracles.segment_dissimilarity(c, d, rotation, largest_run)

    assert both(segment_dissimilarity, c, d, rotation, largest_run) == pytest.approx(expected)


def test_a_part_of_a_longer_contour_counts_as_if_it_stood_alone():
    c, d = ([1.0, 2.0, 0.5], [0.0, 0.7, -0.2]), ([0.4, 1.0], [0.1, 0.9])
    longer = steps(([3.0, *c[0], 2.0], [9.0, *c[1], -9.0]))

    expected = both(tangent.mean_and_variance, c, d)

    assert tangent.mean_and_variance(longer, 1, 4, steps(d), 0, 2) == pytest.approx(expected)
