"""What stands beside the building on its sheet."""

import numpy as np
import pytest

from flats import BLACK, WITH_GAP, box
from pilotage.geometry import Polyline
from pilotage.interpretation import Mark, Pen, Role, Sheet, Text, interpret

NOTES = "All dimensions are to be checked on site before work begins."
THIN = Pen(BLACK, 0.3)


def drawn_as(*marks, texts=(), page=None):
    found = interpret(Sheet((*WITH_GAP, *marks), texts, page))
    return [meaning.role for meaning in found.meanings[len(WITH_GAP) :]], found.sketch.labels


def circle(x, y, radius):
    angles = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    ring = np.array((x, y)) + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    return Mark((Polyline(ring, closed=True),), THIN)


def test_a_box_along_the_edge_of_the_page_around_a_building_is_a_frame():
    frame = box(-29, -29, 149, 99, pen=THIN)

    assert ([Role.IGNORE], ()) == drawn_as(frame, page=(-30.0, -30.0, 150.0, 100.0))


@pytest.mark.parametrize(("words", "role"), [(NOTES, Role.IGNORE), ("Garden", Role.WALL)])
def test_a_thin_box_around_a_building_with_a_title_block_is_a_frame(words, role):
    sheet = box(-20, -40, 120, 100, pen=THIN), box(60, -40, 120, -20, pen=THIN)

    assert [role] * 2 == drawn_as(*sheet, texts=[Text(words, (90.0, -30.0), 2.0)])[0]


@pytest.mark.parametrize("page", [None, (-80.0, -80.0, 200.0, 150.0)])
def test_a_wall_around_the_plot_is_no_frame(page):
    assert ([Role.WALL], ()) == drawn_as(box(-29, -29, 149, 99, pen=THIN), page=page)


def test_a_box_beside_the_building_in_which_much_is_written_is_no_room():
    notes = box(120, 0, 160, 60, pen=THIN)

    assert ([Role.IGNORE], ()) == drawn_as(notes, texts=[Text(NOTES, (140.0, 30.0), 2.0)])


def test_a_box_beside_the_building_with_a_name_is_a_room():
    found, labels = drawn_as(box(120, 0, 160, 60, pen=THIN), texts=[Text("Garage", (140.0, 30.0), 2.0)])

    assert ([Role.WALL], ["Garage"]) == (found, [label.text for label in labels])


def test_bubbles_of_a_grid_name_no_rooms():
    bubbles = [circle(20 * place, -10, 2) for place in range(5)]
    texts = [Text(letter, (20.0 * place, -10.0), 2.0) for place, letter in enumerate("ABCDE")]

    assert ([Role.IGNORE] * 5, ()) == drawn_as(*bubbles, texts=texts)
