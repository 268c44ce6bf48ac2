import numpy as np
import pytest
import shapely

from pilotage.io.picture.skeleton import straightened, trace_runs


def inked(*polylines, size=100, width=3):
    rows, columns = np.mgrid[:size, :size]
    points = shapely.points(columns.ravel() + 0.5, rows.ravel() + 0.5)
    ink = shapely.union_all([shapely.LineString(line).buffer(width / 2) for line in polylines])
    return shapely.contains(ink, points).reshape(size, size)


def traced(ink):
    return straightened(*trace_runs(ink))


def test_a_stroke_becomes_one_line_from_end_to_end():
    (line,) = traced(inked([(10, 10), (80, 10), (80, 70)]))

    assert len(line) <= 4
    assert pytest.approx(130.0, abs=5.0) == shapely.LineString(line).length


def test_a_ring_becomes_one_closed_line():
    (line,) = traced(inked([(20, 20), (80, 20), (80, 80), (20, 80), (20, 20)]))

    assert line[0].tolist() == line[-1].tolist()
    assert pytest.approx(240.0, abs=8.0) == shapely.LineString(line).length


def test_strokes_part_where_they_fork():
    lines = traced(inked([(10, 50), (90, 50)], [(50, 50), (50, 90)]))

    assert 3 == len(lines)


def test_a_ragged_edge_makes_no_strokes():
    ink = inked([(10, 50), (90, 50)], width=7)
    ink[46, 30] = ink[45, 30] = ink[53, 60] = True

    assert 1 == len(traced(ink))


def test_no_ink_is_no_stroke():
    assert [] == traced(np.zeros((10, 10), dtype=bool))
