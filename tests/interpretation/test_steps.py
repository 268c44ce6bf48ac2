"""Rows of lines that look like steps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from flats import flight
from pilotage.interpretation.steps import STEPS, rows_of_steps


@given(st.integers(STEPS, 20), st.floats(1.0, 5.0), st.floats(-4.0, 4.0), st.randoms())
def test_a_flight_is_one_row_however_it_is_turned_and_in_whatever_order(count, depth, turn, order):
    lines = flight(count, depth=depth, turn=turn)
    numbers = list(range(count))
    order.shuffle(numbers)
    (row,) = rows_of_steps(lines[numbers])

    assert set(range(count)) == set(row.tolist())


def test_steps_may_be_tilted_a_little_to_either_side():
    lines = flight(7, turn=np.pi / 2.0)
    lines[::2, 1, 1] += 0.05
    lines[1::2, 1, 1] -= 0.05
    (row,) = rows_of_steps(lines)

    assert set(range(7)) == set(row.tolist())


def test_spokes_all_around_are_followed_once():
    angles = np.linspace(0.0, 2.0 * np.pi, 240, endpoint=False)
    spokes = np.stack([np.cos(angles), np.sin(angles)], axis=1)[:, np.newaxis] * np.array([[20.0], [22.0]])
    (row,) = rows_of_steps(spokes)

    assert 240 == len(set(row.tolist())) == len(row)


@pytest.mark.parametrize(
    "lines",
    [
        flight(STEPS - 1),
        flight(9, depth=8.0),  # a row of posts
        flight(9, depth=0.2),  # a hatch
        flight(9) * np.linspace(0.3, 1.0, 9)[:, np.newaxis, np.newaxis],  # a fan
        np.zeros((9, 2, 2)),
        np.empty((0, 2, 2)),
    ],
)
def test_other_lines_are_no_stairs(lines):
    assert [] == rows_of_steps(lines)
