import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Polyline
from pilotage.maps import DecompositionSettings, FileAxes, Label, SchematicMap, decompose
from pilotage.maps.cells.identity import identify, place_name

BOX = [(0, 0), (10, 0), (10, 5), (0, 5), (0, 0)]
TWO_ROOMS = (BOX, [(5, 0), (5, 2)], [(5, 3), (5, 5)])
THIRD_ROOM = ([(10, 0), (16, 0), (16, 5), (10, 5)],)
TABLE = ([(1, 1), (2, 1), (2, 2), (1, 2), (1, 1)],)


def ids_of(*strokes, labels=(), y_down=False):
    sketch = SchematicMap(tuple(Polyline.through(stroke) for stroke in strokes), labels=labels, y_down=y_down)
    return {cell.cell_id for cell in decompose(sketch, DecompositionSettings()).cells}


def test_a_cell_is_called_by_its_label_and_another_by_its_middle():
    assert {"meeting-room", "x7.5y2.5"} == ids_of(*TWO_ROOMS, labels=(Label("Meeting room", (2, 2)),))


def test_middles_are_told_in_the_axes_of_the_file():
    assert {"x2.5y-2.5", "x7.5y-2.5"} == ids_of(*TWO_ROOMS, y_down=True)


@pytest.mark.parametrize("stroke", [*THIRD_ROOM, *TABLE])
def test_ids_stay_when_a_stroke_is_added_elsewhere(stroke):
    before = ids_of(*TWO_ROOMS)

    assert before <= ids_of(*TWO_ROOMS, stroke)


@given(st.lists(st.sampled_from(["WC", "Hall", "?", ""]), min_size=1, max_size=6))
def test_every_cell_has_an_id_of_its_own(labels):
    boxes = [shapely.box(0, 0, 10, 10)] * len(labels)
    ids = identify(boxes, [[label] for label in labels], 100.0, FileAxes())

    assert len(set(ids)) == len(labels)
    assert all(ids)


@given(st.floats(-6, 6), st.floats(-5e3, 5e3), st.floats(-5e3, 5e3))
def test_a_place_says_within_two_percent_where_a_cell_is(magnitude, x, y):
    size = 10.0**magnitude
    box = shapely.box(x * size, y * size, (x + 1) * size, (y + 1) * size)
    words = place_name(box, 50.0 * size, FileAxes())
    told = np.array([float(word) for word in words[1:].split("y")])

    assert math.dist(told, (box.centroid.x, box.centroid.y)) <= 0.02 * 50.0 * size


def test_a_ring_is_placed_where_it_is_and_not_in_its_hole():
    ring = shapely.Polygon(shapely.box(0, 0, 100, 100).exterior, [shapely.box(10, 10, 90, 90).exterior])

    assert place_name(ring, 140.0, FileAxes()) != place_name(shapely.box(10, 10, 90, 90), 140.0, FileAxes())
