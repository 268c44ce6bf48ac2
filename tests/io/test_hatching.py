import numpy as np
import pytest

from pilotage.geometry import Polyline
from pilotage.interpretation import Mark, Pen
from pilotage.io.hatching import filled_hatching

PEN = Pen(width=0.72)


def stroke(start, end, pen=PEN):
    return Mark((Polyline.through([start, end]),), pen)


def hatching(width, height, step):
    """Hatch a rectangle at 45 degrees."""
    shifts = np.arange(step, width + height, step)
    return [
        stroke((max(0.0, c - height), min(height, c)), (min(width, c), max(0.0, c - width))) for c in shifts
    ]


def test_lines_that_touch_are_the_area_they_cover():
    lines = hatching(100.0, 8.0, 0.24)
    before, after = stroke((0, 20), (100, 20)), stroke((0, 30), (100, 30))
    first, area, last = filled_hatching([before, *lines, after])
    assert (first, last) == (before, after)
    assert area.pen is None
    assert area.fill == PEN.color
    points = area.outlines[0].vertices
    assert points.min(axis=0) == pytest.approx([0, 0], abs=0.5)
    assert points.max(axis=0) == pytest.approx([100, 8], abs=0.5)
    assert len(area.outlines[0]) < 20


def test_hatching_with_gaps_and_lines_of_other_things_stay():
    sparse = hatching(100.0, 8.0, 2.0)
    assert filled_hatching(sparse) == sparse
    hairlines = [stroke((x, 0), (x, 8), Pen()) for x in np.arange(0, 60, 0.1)]
    assert filled_hatching(hairlines) == hairlines
