import numpy as np
import pytest
from hypothesis import given

import strategies
from pilotage.contours import ArcSequence
from pilotage.kernels.any_start import any_start_dissimilarity
from pilotage.kernels.tangent import arc_dissimilarity


def start_by_start(c, d):
    """Eq. (2) for all pairs of starts, one after the other."""
    n, m = len(c.directions) // 2, len(d.directions) // 2
    return min(arc_dissimilarity(c, p, p + n, d, q, q + m) for p in range(n) for q in range(m))


@given(strategies.star_shaped_outlines(max_size=8), strategies.star_shaped_outlines(max_size=8))
def test_meetings_of_steps_find_what_trying_all_starts_finds(a, b):
    c, d = (ArcSequence.of(outline).steps(outline.length).steps for outline in (a, b))

    assert any_start_dissimilarity(c, d) == pytest.approx(start_by_start(c, d), rel=1e-6, abs=1e-9)


@given(strategies.star_shaped_outlines(max_size=8), strategies.star_shaped_outlines(max_size=8))
def test_no_start_between_vertices_is_better(a, b):
    """Starts are sampled by cutting a segment of one contour, which changes nothing but adds a start."""
    c, d = (ArcSequence.of(outline).steps(outline.length).steps for outline in (a, b))
    middles = (a.ring[:-1] + a.ring[1:]) / 2
    refined = type(a)(np.stack([a.vertices, middles], axis=1).reshape(-1, 2), closed=True)
    r = ArcSequence.of(refined).steps(refined.length).steps

    assert start_by_start(r, d) == pytest.approx(any_start_dissimilarity(c, d), rel=1e-6, abs=1e-9)
