"""Discs in a color of their own, and compasses."""

import numpy as np
import pytest

from flats import BLACK, WHITE, WITH_GAP, box, graph_of
from pilotage.geometry import Polyline
from pilotage.interpretation import Mark, Pen, Role, Sheet, Text, interpret

YELLOW = (0.96, 0.62, 0.04)


def disc(x, y, radius, pen=None, fill=None):
    angles = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    ring = np.array((x, y)) + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    return Mark((Polyline(ring, closed=True),), pen, fill)


def roles(*marks, texts=()):
    found = interpret(Sheet((*WITH_GAP, *marks), texts))
    return [meaning.role for meaning in found.meanings[len(WITH_GAP) :]], found.sketch.labels


def test_a_small_disc_in_a_color_of_its_own_is_a_sign():
    assert ([Role.IGNORE], ()) == roles(disc(20, 20, 3, fill=YELLOW))


@pytest.mark.parametrize(
    ("words", "names"), [(("Kitchen", "Bath"), {"Kitchen", "Bath"}), (("Bath",), {"1", "Bath"})]
)
def test_numbers_in_discs_name_no_rooms_where_many_more_words_do(words, names):
    texts = [Text("1", (20.0, 20.0), 2.0)]
    texts += [Text(word, (70.0, 20.0 + 20.0 * place), 2.0) for place, word in enumerate(words)]

    found, labels = roles(disc(20, 20, 3, fill=YELLOW), texts=texts)

    assert ([Role.IGNORE], names) == (found, {label.text for label in labels})


def test_a_column_in_the_color_of_walls_and_a_round_hall_are_built():
    found, _ = roles(disc(20, 20, 3, fill=BLACK), disc(30, 55, 12, Pen(BLACK, 1.0), YELLOW))

    assert [Role.WALL, Role.WALL] == found


@pytest.mark.parametrize("points", ["N", "NS", "СЮ", "北"])
def test_a_circle_around_a_letter_of_the_north_is_a_compass_with_its_needle_and_no_name(points):
    needle = Mark((Polyline.through([(90, 68), (90, 72)]),), Pen(BLACK, 1.0))
    letters = tuple(Text(point, (90.0, 72.0 - 4.0 * place), 2.0) for place, point in enumerate(points))

    assert ([Role.IGNORE] * 2, ()) == roles(disc(90, 70, 5, Pen(BLACK, 1.0)), needle, texts=letters)


@pytest.mark.parametrize(("y", "role"), [(77.0, Role.IGNORE), (45.0, Role.WALL)], ids=["beside", "far"])
def test_the_letter_of_the_north_may_stand_beside_the_circle_of_its_compass(y, role):
    found, labels = roles(disc(90, 70, 5, Pen(BLACK, 1.0)), texts=(Text("N", (90.0, y), 2.0),))

    assert [role] == found
    assert (role is Role.WALL) is bool(labels)


def test_a_circle_without_an_n_and_an_n_without_a_circle_stay():
    found, labels = roles(disc(90, 70, 5, Pen(BLACK, 1.0)), texts=(Text("N", (20.0, 20.0), 2.0),))

    assert [Role.WALL] == found
    assert ["N"] == [label.text for label in labels]


def test_a_box_around_the_words_of_a_room_is_a_plate_and_two_are_booths():
    rooms = [box(x, 0, x + 50, 80, pen=Pen(BLACK, 1.0)) for x in (0, 50)]
    plates = [box(x, y, x + 20, y + 8, pen=Pen(BLACK, 1.0), fill=WHITE) for x, y in ((65, 30), (15, 50))]
    booth = box(15, 10, 35, 18, pen=Pen(BLACK, 1.0), fill=WHITE)
    names = [Text(name, at, 3.0) for name, at in (("hall", (75, 34)), ("bath", (25, 54)), ("A1", (25, 14)))]

    named = graph_of((*rooms, *plates), tuple(names[:2]))
    fair = interpret(Sheet((*rooms, *plates, booth), tuple(names)))

    assert ["bath", "hall"] == sorted(cell.label for cell in named.cells)
    assert [Role.IGNORE, Role.WALL, Role.WALL] == [meaning.role for meaning in fair.meanings[2:]]
