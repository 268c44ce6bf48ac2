"""Discs in a color of their own, and compasses."""

import numpy as np
import pytest

from flats import BLACK, WITH_GAP
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
