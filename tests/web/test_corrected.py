"""The corrected drawing lies on the page as the drawing does."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Polyline
from pilotage.maps import Label, SchematicMap
from pilotage.web.corrected import turned

BOX = Polyline(np.array([(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0)]), closed=True)
SKETCH = SchematicMap((BOX,), start=(1.0, 1.0), goal=(3.0, 1.0), labels=(Label("hall", (2.0, 1.0)),))


def test_a_quarter_turn_takes_all_marks_along() -> None:
    found = turned(SKETCH, math.pi / 2)

    assert np.allclose([(0, 0), (0, 4), (-2, 4), (-2, 0)], found.strokes[0].vertices)
    assert found.strokes[0].closed
    assert (-1.0, 1.0) == pytest.approx(found.start)
    assert (-1.0, 3.0) == pytest.approx(found.goal)
    assert (-1.0, 2.0) == pytest.approx(found.labels[0].position)


@given(st.floats(-10.0, 10.0))
def test_turning_back_and_forth_changes_nothing(angle: float) -> None:
    again = turned(turned(SKETCH, angle), -angle)

    assert np.allclose(BOX.vertices, again.strokes[0].vertices)
    assert SKETCH.goal == pytest.approx(again.goal)
