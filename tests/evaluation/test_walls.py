"""Laws of how far walls are from the true ones."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from buildings import flat
from pilotage.evaluation.walls import TrueWalls
from pilotage.evaluation.warp import Warp
from pilotage.geometry import Pose2

CORNERS = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 7.0], [0.0, 7.0], [5.0, 3.0]])
POSES = st.builds(Pose2, st.floats(-9, 9), st.floats(-9, 9), st.floats(-3, 3))


def truth(scale=10.0):
    """Return the truth about a drawing that is true but for its scale."""
    sketch = flat(scale)
    hits = np.vstack([wall.ring for wall in flat().strokes])
    return TrueWalls.of(sketch, Warp(CORNERS, scale * CORNERS), hits)


@given(POSES)
def test_a_true_drawing_errs_nowhere_and_where_it_lies_does_not_matter(pose):
    walls = truth()

    assert walls.error_of_drawing() == pytest.approx(0.0, abs=1e-9)
    assert walls.error_of(pose @ walls.in_world) == pytest.approx(0.0, abs=1e-9)
    assert walls.hits_beside(pose @ walls.in_world) == pytest.approx(pose @ walls.hits, abs=1e-6)


def test_a_corrected_drawing_must_have_the_true_scale():
    walls = truth()

    assert walls.error_of(1.1 * walls.in_world) > 0.1


def test_only_walls_near_a_hit_count():
    walls = truth()

    assert 0 < len(walls.in_world) < 200
    assert np.hypot(*(walls.in_world[:, None] - walls.hits[None]).T).min(axis=0).max() <= 0.5
