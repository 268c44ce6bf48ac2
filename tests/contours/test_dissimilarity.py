import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import strategies
from pilotage.contours import ArcSequence, Comparison, Lengths, Measure, arc_dissimilarity, dissimilarity
from pilotage.contours.tangent import turns
from pilotage.geometry import Polyline, Similarity2

comparisons = st.builds(Comparison, st.sampled_from(Measure), st.sampled_from(Lengths))
TANGENT, COMBINED = Comparison(Measure.TANGENT), Comparison(Measure.COMBINED)


@st.composite
def contours(draw, closed=None):
    """Polylines that do not fold back on themselves, nor nearly, and are longer than nothing."""
    polyline = draw(strategies.polylines(min_size=3, max_size=7, closed=closed))
    assume(polyline.segment_lengths.min() > 1e-2)
    assume((np.abs(turns(polyline)) < math.pi - 1e-3).all())
    return polyline


@st.composite
def pairs(draw):
    closed = draw(st.booleans())
    return draw(contours(closed)), draw(contours(closed))


@given(contours(), strategies.poses, strategies.scales)
def test_congruent_contours_are_not_unlike_and_with_relative_lengths_similar_ones_neither(
    contour, pose, scale
):
    for measure in Measure:
        moved, similar = contour.moved(pose), contour.moved(Similarity2(scale, pose))

        assert dissimilarity(contour, moved, Comparison(measure, Lengths.ABSOLUTE)) == pytest.approx(
            0.0, abs=1e-6
        )
        assert dissimilarity(contour, similar, Comparison(measure)) == pytest.approx(0.0, abs=1e-6)


@given(pairs(), strategies.poses, comparisons)
def test_a_rigid_motion_of_either_changes_nothing(pair, pose, comparison):
    a, b = pair

    expected = dissimilarity(a, b, comparison)

    assert dissimilarity(a.moved(pose), b, comparison) == pytest.approx(expected, rel=1e-6, abs=1e-6)


@given(pairs(), comparisons)
def test_either_may_come_first(pair, comparison):
    a, b = pair

    expected = dissimilarity(a, b, comparison)

    assert dissimilarity(b, a, comparison) == pytest.approx(expected, rel=1e-6, abs=1e-6)


@given(pairs(), comparisons)
def test_running_both_the_other_way_changes_nothing(pair, comparison):
    a, b = pair

    expected = dissimilarity(a, b, comparison)

    assert dissimilarity(a.reversed(), b.reversed(), comparison) == pytest.approx(
        expected, rel=1e-6, abs=1e-6
    )


@given(contours(closed=True), contours(closed=True), st.integers(0, 6), comparisons)
def test_a_closed_contour_may_start_at_any_vertex(a, b, start, comparison):
    elsewhere = Polyline(np.roll(b.vertices, start, axis=0), closed=True)

    expected = dissimilarity(a, b, comparison)

    assert dissimilarity(a, elsewhere, comparison) == pytest.approx(expected, rel=1e-6, abs=1e-6)


@given(pairs())
def test_the_combination_is_never_more_than_equation_2(pair):
    assert dissimilarity(*pair, COMBINED) <= dissimilarity(*pair, TANGENT) + 1e-12


@given(contours(closed=False), contours(closed=False), st.floats(0.2, 5.0))
def test_with_absolute_lengths_dissimilarity_grows_with_scale(c, d, scale):
    zoom = Similarity2(scale, strategies.Pose2.identity())
    absolute = Comparison(Measure.TANGENT, Lengths.ABSOLUTE)

    expected = scale * arc_dissimilarity(c, d, absolute)

    assert arc_dissimilarity(c.moved(zoom), d.moved(zoom), absolute) == pytest.approx(expected, abs=1e-6)


def test_equation_2_on_a_corner_and_a_line_by_hand():
    """Directions differ by 0 and pi / 2 on either half: variance (pi / 4)^2; lengths 2, 1: factor 2 * 2."""
    corner = Polyline.through([(0, 0), (1, 0), (1, 1)])
    line = Polyline.through([(0, 0), (1, 0)])
    settings = Comparison(Measure.TANGENT, Lengths.ABSOLUTE)

    expected = (math.pi / 4) ** 2 * 2 * 2

    assert arc_dissimilarity(corner, line, settings) == pytest.approx(expected)


def test_a_gap_between_two_cupboards_troubles_the_combination_far_less_than_equation_2():
    """Figure 3 of the paper: a row of cupboards, seen without and with the gap between two of them."""
    left = [(0, 6), (0, 5), (2, 5), (2, 3), (0, 3), (0, 2), (1, 2), (1, 0)]
    gap = [(3, 0), (3, -0.2), (3.1, -0.2), (3.1, 0)]
    right = [(5, 0), (5, 3), (8, 3), (8, 1), (9, 1), (9, 6)]
    before, after = Polyline.through(left + right), Polyline.through(left + gap + right)

    assert arc_dissimilarity(before, after, COMBINED) < arc_dissimilarity(before, after, TANGENT) / 3


def test_two_arcs_with_equally_many_segments_are_not_alike_for_that():
    """What one rotation for all segments of an arc mends: each pair alone would fit at its own rotation."""
    slight = Polyline.through([(0, 0), (1, 0), (2, 0.3), (3, 0.9)])
    sharp = Polyline.through([(0, 0), (1, 0), (1, 1), (0, 1)])

    assert arc_dissimilarity(slight, sharp, COMBINED) > 0.1


def test_mirror_images_differ():
    hook = Polyline.through([(0, 0), (3, 0), (3, 1)])

    assert dissimilarity(hook, Polyline(hook.vertices * (1.0, -1.0)), COMBINED) > 0.1


def test_open_and_closed_contours_are_not_compared():
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]

    with pytest.raises(ValueError, match="both closed or both open"):
        dissimilarity(Polyline.through(square), Polyline.through(square, closed=True), Comparison())


@pytest.mark.parametrize("largest_group", [0, 2, -1])
def test_groups_must_be_odd(largest_group):
    with pytest.raises(ValueError, match="largest_group must be odd"):
        Comparison(largest_group=largest_group)


def test_a_sequence_marks_its_arcs_on_the_tangent_function():
    notch = Polyline.through([(0, 0), (4, 0), (4, 2), (6, 2), (6, 0), (8, 0)])

    sequence = ArcSequence.of(notch)

    assert sequence.arc_starts.tolist() == [0, 2, 5, 7]
    assert sequence.tangent.stops[sequence.arc_starts] * 12 == pytest.approx([0, 5, 9, 12])
